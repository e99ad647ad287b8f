"""The compiled engine equals the stages, called one by one as plain Python, to the last bit."""

import importlib.util
from collections.abc import Callable

import numpy as np
import pytest
from engine_runs import stage_by_stage
from frames_collected import Collector

from fpt_ros.engine import compiled
from fpt_ros.engine import engine as engine_module
from fpt_ros.engine.engine import Engine
from fpt_ros.errors import Diverged
from fpt_ros.experiments import experiment
from fpt_ros.runs.chunks import frames

CYCLES = 400

SHORTENED = {
    "coupled_masses": {
        "fpt_deformer": {"adaptive_from": 0.1},
        "parameter_tuner": {"tune_from": 0.15},
    },
    "swing": {"trajectory_generator": {"time_sharing": [0.01, 0.0055]}},
}
"""What makes a short run pass through all that a long one does."""

ARMS = ("iiwa", "panda", "ur5e")
"""One variant stands for all: test_arms.py has the others of panda."""

EVERY = [
    (name, variant)
    for name, found in experiment.available().items()
    for variant in (found[:1] if name in ARMS else found)
]

NOISE = ("plant_simulator.noise.position=1e-4", "plant_simulator.noise.velocity=1e-3")

SPECIAL = {
    "substeps": ("tora", "strong", ("plant_simulator.substeps=7",)),
    "noise": ("tora", "adaptive", NOISE),
    "weights": ("tora", "adaptive", ("fpt_deformer.weights=[0.5, 2.0]",)),
    "signed form": ("tora", "adaptive", ("fpt_deformer.form=signed",)),
    "disturbed third coordinate": (
        "tora",
        "adaptive",
        (
            "plant_simulator.disturbance.kind=bspline",
            "plant_simulator.disturbance.coordinate=q3",
            "plant_simulator.disturbance.amplitude=5",
        ),
    ),
    "hold in the place of the delay": (
        "spherical_pendulum",
        "adaptive",
        ("fpt_deformer.learning_delay=1", "fpt_deformer.learning_hold=10"),
    ),
    "delay without tuning": ("spherical_pendulum", "fixed_weights", NOISE),
    "adaptive later": (
        "swing",
        "adaptive",
        ("fpt_deformer.adaptive_from=0.03",),
    ),
    "tuned gain and guard": ("tora_auto", "adaptive", ("parameter_tuner.precursor_guard=true",)),
    "observer only": ("tora", "chatter", ("parameter_tuner.precursor=true",)),
    "more inner steps": (
        "coupled_masses",
        "cold",
        ("parameter_tuner.inner_steps=7",),
    ),
    "started with another response": (
        "mimo_affine",
        "adaptive",
        ("fpt_deformer.initial_response=[1.0, -1.0]",),
    ),
}


def load(name, variant, settings=(), cycles=CYCLES, seed=3):
    """An experiment of at most ``cycles`` cycles that passes through everything."""
    loaded = experiment.load(name, variant, settings, seed=seed)
    for node, values in SHORTENED.get(name, {}).items():
        known = {key: value for key, value in values.items() if key in loaded.nodes[node]}
        loaded = loaded.with_values(node, **known)
    plant = loaded.nodes["plant_simulator"]
    duration = min(plant["duration"], cycles * plant["dt"])
    return loaded.with_values("plant_simulator", duration=duration)


def finished(loop, compile_laws=True):
    """Topics of an engine's run, and what ended it."""
    engine = Engine(loop, compile_laws)
    error = None
    try:
        engine.run()
    except Diverged as caught:
        error = str(caught)
    return engine, error


def bits(matrix):
    return np.ascontiguousarray(matrix).view(np.uint64)


def assert_identical(found, expected):
    """NaN is NaN whatever its payload; of all other numbers every bit counts."""
    assert list(found) == list(expected)
    for topic, series in expected.items():
        ours = found[topic]
        assert ours.names == series.names, topic
        assert np.array_equal(ours.stamps, series.stamps), topic
        assert list(ours.vectors) == list(series.vectors), topic
        for vector, numbers in series.vectors.items():
            same = bits(ours.vectors[vector]) == bits(numbers)
            both_nan = np.isnan(ours.vectors[vector]) & np.isnan(numbers)
            wrong = np.argwhere(~(same | both_nan))
            assert wrong.size == 0, (topic, vector, wrong[0], len(wrong))


def assert_engine_equals_stages(loaded):
    engine, ended = finished(loaded.loop())
    collector, error = Collector(), None
    try:
        stage_by_stage(loaded.loop(), collector)
    except Diverged as caught:
        error = str(caught)
    assert ended == error
    assert_identical(engine.topics(), collector.topics())
    return engine


@pytest.mark.parametrize(("name", "variant"), EVERY)
def test_every_variant(name, variant):
    assert_engine_equals_stages(load(name, variant))


@pytest.mark.parametrize("case", SPECIAL)
def test_what_no_experiment_of_the_package_does(case):
    assert_engine_equals_stages(load(*SPECIAL[case]))


@pytest.mark.parametrize("variant", ["adaptive", "deform_only", "tune_only"])
def test_both_adaptations_begin_in_the_middle_of_a_run(variant):
    """At 0.5 s, as the files have it: not shortened."""
    loaded = experiment.load("coupled_masses", variant, duration=0.7)
    engine = assert_engine_equals_stages(loaded)
    topics = engine.topics()
    r = topics["command"].vectors["accelerations"]
    desired = topics["desired"].vectors["accelerations"]
    deformed = variant != "tune_only"
    assert np.array_equal(r[:500], desired[:500])
    assert np.array_equal(r[500:], desired[500:]) is not deformed
    if "tuning" in topics:
        masses = topics["tuning"].column("values", "m1")
        assert (masses[:501] == 1.5).all()
        assert masses[501] != 1.5


def test_turns_of_time_sharing_change_hands():
    loaded = load("swing", "adaptive")
    desired = assert_engine_equals_stages(loaded).topics()["desired"]
    turn = ~np.isnan(desired.vectors["accelerations"])
    assert (turn.sum(axis=1) == 1).all()
    # 100 cycles q1, 55 cycles q2
    expected = np.arange(CYCLES) % 155 < 100
    assert np.array_equal(turn[:, 0], expected)


def test_one_turn_alone():
    """Shorter than the first turn: the other coordinate has no column."""
    loaded = experiment.load("swing", duration=0.02)
    desired = assert_engine_equals_stages(loaded).topics()["desired"]
    assert desired.names == ("q1",)


@pytest.mark.parametrize(
    ("name", "variant"),
    [("tora", "adaptive"), ("cart_beam_hamper", "lugre"), ("spherical_pendulum", "adaptive")],
)
def test_the_engine_as_plain_python_gives_the_same_bits(name, variant):
    loaded = load(name, variant, cycles=150)
    plain, compiled = (finished(loaded.loop(), each)[0] for each in (False, True))
    assert_identical(plain.topics(), compiled.topics())


@pytest.mark.parametrize(
    ("name", "variant"),
    [
        ("tora", "adaptive"),
        ("vdp_rfpt", "adaptive"),
        ("cart_beam_hamper", "lugre"),
        ("spherical_pendulum", "adaptive"),
        ("swing", "adaptive"),
    ],
)
def test_a_long_run_has_its_laws_built_in_and_gives_the_same_bits(monkeypatch, name, variant):
    loaded = load(name, variant)
    through_pointers = finished(loaded.loop())[0].topics()
    monkeypatch.setattr(engine_module, "LONG", CYCLES)
    monkeypatch.setattr(compiled, "loop", None)
    assert_identical(finished(loaded.loop())[0].topics(), through_pointers)


Law = Callable[[float], float]


def sum_of(law: Law, other: Law, x: float) -> float:
    return law(x) + other(x)


def law_of(path, text):
    path.write_text(f"def law(x):\n    return {text}\n")
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.law


def test_built_in_laws_are_kept_on_disk_and_are_those_of_the_files_as_they_are(tmp_path):
    other = law_of(tmp_path / "other.py", "x * x")
    first = law_of(tmp_path / "mine.py", "x + 1.0")
    fresh = compiled.specialised_loop.__wrapped__
    for hits in (0, 1):
        found = fresh(sum_of, (first, other))
        assert found(3.0) == 4.0 + 9.0
        assert sum(found.stats.cache_hits.values()) == hits
    assert fresh(sum_of, (other, first))(3.0) == 9.0 + 4.0
    # of another length: Python's own cache tells files of the same second by their size
    changed = law_of(tmp_path / "mine.py", "x + 2.00")
    assert fresh(sum_of, (changed, other))(3.0) == 5.0 + 9.0


@pytest.mark.parametrize("chunk", [1, 7, 399, 400, 401])
def test_the_length_of_a_chunk_does_not_matter(monkeypatch, chunk):
    loaded = load("coupled_masses", "adaptive")
    whole = finished(loaded.loop())[0].topics()
    monkeypatch.setattr(engine_module, "CHUNK", chunk)
    assert_identical(finished(loaded.loop())[0].topics(), whole)


def test_frames_are_the_topics():
    for name in ("vdp_rfpt", "swing", "tora"):
        loop = load(name, "adaptive").loop()
        engine, _ = finished(loop)
        collector = Collector()
        for topic, frame in frames(engine.topics()):
            collector(topic, frame)
        assert_identical(collector.topics(), engine.topics())


def test_what_ends_a_run_leaves_the_cycles_before_it():
    class Stop(Exception):
        pass

    engine = Engine(load("vdp_rfpt", "adaptive", cycles=20_000).loop())

    def progress(cycle):
        if cycle:
            raise Stop

    with pytest.raises(Stop):
        engine.run(progress)
    done = engine.done
    assert 0 < done < engine.cycles
    assert len(engine.topics()["command"].stamps) == done
    whole, _ = finished(load("vdp_rfpt", "adaptive", cycles=20_000).loop())
    kept = engine.topics()["command"].vectors["effort"]
    assert np.array_equal(kept, whole.topics()["command"].vectors["effort"][:done])


def test_a_run_ended_by_progress_goes_on_where_it_was():
    loaded = load("tora_auto", "adaptive", cycles=20_000)
    engine = Engine(loaded.loop())
    told = []

    def progress(cycle):
        told.append(cycle)
        if len(told) == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        engine.run(progress)
    engine.run()
    assert_identical(engine.topics(), finished(loaded.loop())[0].topics())


@pytest.mark.parametrize(
    ("name", "settings", "cycle"),
    [
        ("tora", ("plant_simulator.limit.acceleration=1e-3",), 0),
        ("tora", ("fpt_deformer.guard=false", "fpt_deformer.A=-4"), 1),
        ("tora", ("fpt_deformer.A=0.1",), 411),
        ("vdp_modified", ("plant_simulator.initial_position=[100.0]",), None),
    ],
)
def test_a_cycle_that_fails_is_told_as_the_stages_tell_it(name, settings, cycle):
    """In the first cycle, in the second, and late; only the remedy in brackets may differ."""
    loaded = experiment.load(name, settings=settings)
    engine = Engine(loaded.loop())
    with pytest.raises(Diverged) as ours:
        engine.run()
    collector = Collector()
    with pytest.raises(Diverged) as theirs:
        stage_by_stage(loaded.loop(), collector)
    assert str(ours.value).split(" (")[0] == str(theirs.value).split(" (")[0]
    assert ours.value.cycle == theirs.value.cycle
    if cycle is not None:
        assert ours.value.cycle == cycle
    # a command that was given is in the arrays, also where the plant did not survive it
    expected = collector.topics().get("command")
    found = engine.topics()["command"]
    if expected is None:
        assert len(found.stamps) == 0
    else:
        assert_identical({"command": found}, {"command": expected})
