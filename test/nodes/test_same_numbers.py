"""The graph over DDS and the in-process engine give the same numbers, to the last bit."""

import numpy as np
import pytest
import samples
from command import forked_fpt, forked_fpt_json

from fpt_ros.bags.reader import read_run
from fpt_ros.experiments.experiment import available, load


def identical(a, b):
    assert a.topics.keys() == b.topics.keys()
    for name, ours in a.topics.items():
        theirs = b.topics[name]
        assert ours.names == theirs.names
        assert ours.stamps.tobytes() == theirs.stamps.tobytes(), name
        for vector, numbers in ours.vectors.items():
            assert numbers.tobytes() == theirs.vectors[vector].tobytes(), (name, vector)


CYCLES = 600

SHORTENED = {
    "coupled_masses": ("fpt_deformer.adaptive_from=0.2", "parameter_tuner.tune_from=0.2"),
    "swing": ("trajectory_generator.time_sharing=[0.02, 0.005]",),
}
"""What makes a short run pass through all that a long one does."""

ALIKE = ("ur5e", "iiwa")
"""Arms whose variants are Panda's with other numbers."""

EVERY = [
    (name, variant)
    for name, variants in available().items()
    for variant in variants
    if name not in ALIKE or variant == "adaptive"
]

ONE_OF_EACH = [
    (name, variants[at % len(variants)]) for at, (name, variants) in enumerate(available().items())
]
"""A variant of each experiment; the engine's tests have all variants, stage by stage."""

OF_A_KIND_OF_THEIR_OWN = {
    "fitzhugh_nagumo",  # an observer
    "panda",  # from a file
    "siso_affine",  # of order 0
    "swing",  # coordinates take turns
    "tora_auto",  # a tuner of the gain
    "vdp_aidc",  # a tuner of the model
}
COMPOSED = samples.sample(
    ONE_OF_EACH, 8, keep=[each for each in ONE_OF_EACH if each[0] in OF_A_KIND_OF_THEIR_OWN]
)

SEPARATE = [
    ("tora", "adaptive", 16 if samples.whole else 1, ()),
    ("tora", "nonadaptive", 1, ("--namespace", "robot1")),
    ("noisy_tora", "fuzzy", 0.3, ()),
    ("vdp_rfpt", "adaptive", 6 if samples.whole else 1, ()),
    ("panda", "adaptive", 16 if samples.whole else 0.5, ()),
    ("swing", "adaptive", 0.1, ("--set", "trajectory_generator.time_sharing=[0.02, 0.005]")),
]


def compare(tmp_path, common, options):
    engine = forked_fpt_json("simulate", *common, "--record", tmp_path / "engine")
    graph = forked_fpt_json("run", *common, *options, "--record", tmp_path / "graph")
    assert graph["engine"] == "graph"
    assert graph["tracking"] == engine["tracking"]
    assert graph["chatter"] == engine["chatter"]
    assert graph["final_parameters"] == engine["final_parameters"]
    run = read_run(tmp_path / "graph")
    identical(read_run(tmp_path / "engine"), run)
    assert run.info["complete"] == "true"
    cycles = np.arange(graph["cycles"]) * round(graph["dt"] * 1e9)
    for name, series in run.topics.items():  # every cycle of every topic is recorded
        assert np.array_equal(series.stamps, cycles), name


@pytest.mark.parametrize(("experiment", "variant", "duration", "options"), SEPARATE)
def test_separate_processes_equal_the_engine(tmp_path, experiment, variant, duration, options):
    set_, rest = (options, ()) if "--set" in options else ((), options)
    compare(tmp_path, (experiment, "--variant", variant, "--duration", duration, *set_), rest)


@pytest.mark.parametrize(("experiment", "variant"), EVERY if samples.whole else COMPOSED)
def test_composed_graph_equals_the_engine(tmp_path, experiment, variant):
    nodes = load(experiment, variant).nodes
    dt = float(nodes["plant_simulator"]["dt"])
    settings = [
        word
        for text in SHORTENED.get(experiment, ())
        if text.partition("=")[0].partition(".")[2] in nodes[text.partition(".")[0]]
        for word in ("--set", text)
    ]
    common = (experiment, "--variant", variant, "--duration", CYCLES * dt, *settings)
    compare(tmp_path, common, ("--composed",))


def test_noise_and_settings_reach_the_nodes(tmp_path):
    common = ("tora", "--variant", "nonadaptive", "--duration", 1, "--seed", 7)
    settings = (
        "--set",
        "plant_simulator.noise.position=1e-5",
        "--set",
        "fpt_deformer.approximate.m=12",
    )
    forked_fpt_json("simulate", *common, *settings, "--record", tmp_path / "engine")
    forked_fpt_json("run", *common, *settings, "--record", tmp_path / "graph")
    run = read_run(tmp_path / "graph")
    identical(read_run(tmp_path / "engine"), run)
    assert run.parameters["fpt_deformer"]["approximate.m"] == 12.0
    assert run.parameters["plant_simulator"]["seed"] == 7


def test_nothing_is_recorded_unless_asked(tmp_path):
    done = forked_fpt("run", "tora", "--duration", 0.5, "--json", cwd=tmp_path)
    assert done.returncode == 0
    assert '"bag": null' in done.stdout
    assert list(tmp_path.iterdir()) == []
