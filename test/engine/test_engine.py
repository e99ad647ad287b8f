"""The compiled engine equals the stages, called one by one as plain Python, to the last bit."""

import importlib.util
from collections.abc import Callable

import numpy as np
import pytest
import samples
from consumed import Consumed
from frames_collected import Collector
from whole_loops import CYCLES, assert_engine_equals_stages, assert_identical, finished, load

from fpt_ros.engine import compiled
from fpt_ros.engine import engine as engine_module
from fpt_ros.engine.engine import MANY, Engine
from fpt_ros.experiments import experiment
from fpt_ros.runs.chunks import frames

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
    samples.sample(
        [
            ("tora", "adaptive"),
            ("vdp_rfpt", "adaptive"),
            ("cart_beam_hamper", "lugre"),
            ("spherical_pendulum", "adaptive"),
            ("swing", "adaptive"),
        ],
        2,  # each is compiled for some seconds
        keep=[("cart_beam_hamper", "lugre")],
    ),
)
def test_a_long_run_has_its_laws_built_in_and_gives_the_same_bits(monkeypatch, name, variant):
    loaded = load(name, variant)
    with monkeypatch.context() as never:
        never.setattr(compiled, "is_specialised", lambda *_: False)
        through_pointers = finished(loaded.loop())[0].topics()
    monkeypatch.setattr(compiled, "loop", None)
    with monkeypatch.context() as once:
        once.setattr(engine_module, "LONG", CYCLES)
        assert_identical(finished(loaded.loop())[0].topics(), through_pointers)
    # a short run, now that the code is there
    compiled.is_specialised.cache_clear()
    assert_identical(finished(loaded.loop())[0].topics(), through_pointers)


def test_switches_that_change_in_flight_change_the_code(monkeypatch):
    loaded, original, stopped = load("tora", "adaptive"), compiled.specialised_loop, []
    changes = {at: {"fpt_deformer": {"stopped": at == 150}} for at in (150, 200)}

    def specialised(function, laws, switches):
        stopped.append(dict(switches)["constants.deformer.limits.stopped"])
        return original(function, laws, switches)

    monkeypatch.setattr(compiled, "specialised_loop", specialised)
    monkeypatch.setattr(engine_module, "LONG", CYCLES)
    engine = Engine(loaded.loop(), changes=changes)
    engine.run()
    assert stopped == [0, 1, 0]
    in_python = Engine(loaded.loop(), compile_laws=False, changes=changes)
    in_python.run()
    assert_identical(engine.topics(), in_python.topics())


def test_many_short_runs_are_a_long_one(monkeypatch):
    built_in = []
    monkeypatch.setattr(compiled, "is_specialised", lambda *_: False)
    monkeypatch.setattr(compiled, "specialised_loop", lambda *_: built_in.append(True))
    loop = load("tora", "adaptive").loop()
    Engine(loop, runs=MANY // loop.plant.cycles - 1)
    assert not built_in
    Engine(load("tora", "adaptive").loop(), runs=MANY // loop.plant.cycles + 1)
    assert built_in


Law = Callable[[float], float]


def sum_of(law: Law, other: Law, x: float) -> float:
    return law(x) + other(x)


def law_of(path, text):
    path.write_text(f"def law(x):\n    return {text}\n")
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.law


def test_built_in_laws_are_kept_on_disk_and_are_those_of_the_files_as_they_are(
    tmp_path, monkeypatch
):
    other = law_of(tmp_path / "other.py", "x * x")
    first = law_of(tmp_path / "mine.py", "x + 1.0")
    fresh = compiled.specialised_loop.__wrapped__
    assert fresh(sum_of, (first, other), ())(3.0) == 4.0 + 9.0
    compiled.is_specialised.cache_clear()
    with monkeypatch.context() as loaded:
        loaded.setattr(compiled, "_loop", None)  # nothing to build it from
        assert fresh(sum_of, (first, other), ())(3.0) == 4.0 + 9.0
    assert fresh(sum_of, (other, first), ())(3.0) == 9.0 + 4.0
    # of another length: Python's own cache tells files of the same second by their size
    changed = law_of(tmp_path / "mine.py", "x + 2.00")
    assert fresh(sum_of, (changed, other), ())(3.0) == 5.0 + 9.0


@pytest.mark.parametrize("chunk", [1, 7, 399, 400, 401])
def test_the_length_of_a_chunk_does_not_matter(monkeypatch, chunk):
    loaded = load("coupled_masses", "adaptive")
    whole = finished(loaded.loop())[0].topics()
    monkeypatch.setattr(engine_module, "CHUNK", chunk)
    assert_identical(finished(loaded.loop())[0].topics(), whole)
    consumed = Consumed()
    Engine(loaded.loop(), consumers=[consumed]).run()
    assert_identical(consumed.topics(), whole)


def test_frames_are_the_topics():
    for name in ("vdp_rfpt", "swing", "tora"):
        loop = load(name, "adaptive").loop()
        engine, _ = finished(loop)
        collector = Collector()
        for topic, frame in frames(engine.topics()):
            collector(topic, frame)
        assert_identical(collector.topics(), engine.topics())
