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

SEPARATE = [
    ("tora", "adaptive", 16 if samples.whole else 3, ()),
    ("tora", "nonadaptive", 3, ("--namespace", "robot1")),
    ("vdp_rfpt", "adaptive", 6 if samples.whole else 2, ()),
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
    identical(read_run(tmp_path / "engine"), read_run(tmp_path / "graph"))


@pytest.mark.parametrize(("experiment", "variant", "duration", "options"), SEPARATE)
def test_separate_processes_equal_the_engine(tmp_path, experiment, variant, duration, options):
    set_, rest = (options, ()) if "--set" in options else ((), options)
    compare(tmp_path, (experiment, "--variant", variant, "--duration", duration, *set_), rest)


@pytest.mark.parametrize(("experiment", "variant"), EVERY if samples.whole else ONE_OF_EACH)
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


def test_every_cycle_of_every_topic_is_recorded(tmp_path):
    forked_fpt_json("run", "vdp_rfpt", "--duration", 2, "--record", tmp_path / "bag")
    run = read_run(tmp_path / "bag")
    assert run.info["complete"] == "true"
    assert set(run.topics) == {"joint_states", "state_estimate", "desired", "tuning", "command"}
    for name, series in run.topics.items():
        assert np.array_equal(series.stamps, np.arange(2000) * 1_000_000), name


def test_recording_of_a_graph_opens_elsewhere(tmp_path):
    from mcap_ros2.reader import read_ros2_messages
    from rosbags.highlevel import AnyReader
    from rosbags.typesys import Stores, get_typestore

    forked_fpt_json("run", "tora", "--duration", 1, "--record", tmp_path / "bag")
    with AnyReader([tmp_path / "bag"], default_typestore=get_typestore(Stores.ROS2_JAZZY)) as bag:
        counts = {connection.topic: connection.msgcount for connection in bag.connections}
        connections = [c for c in bag.connections if c.topic == "/command"]
        efforts = [
            bag.deserialize(raw, connection.msgtype).points[0].effort[0]
            for connection, _, raw in bag.messages(connections=connections)
        ]
    for topic in ("/joint_states", "/state_estimate", "/desired", "/command"):
        assert counts[topic] == 1000
    series = read_run(tmp_path / "bag").topics["command"]
    assert np.array_equal(efforts, series.column("effort", "q1"))
    messages = list(read_ros2_messages(tmp_path / "bag" / "bag_0.mcap", topics=["/command"]))
    assert [m.ros_msg.points[0].effort[0] for m in messages] == efforts


def test_nothing_is_recorded_unless_asked(tmp_path):
    done = forked_fpt("run", "tora", "--duration", 0.5, "--json", cwd=tmp_path)
    assert done.returncode == 0
    assert '"bag": null' in done.stdout
    assert list(tmp_path.iterdir()) == []
