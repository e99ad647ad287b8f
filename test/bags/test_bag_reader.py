"""Reading back: what was recorded, to the bit."""

import json
from pathlib import Path

import numpy as np
import pytest
import samples
from hypothesis import given, settings
from hypothesis import strategies as st
from messages_made import message, same
from recorded_run import INFO, Recorded
from rosbags.typesys import Stores, get_typestore

from fpt_ros.bags import changes, reader, schemas
from fpt_ros.bags.writer import BagWriter
from fpt_ros.errors import BadInput
from fpt_ros.messages.cdr import Codec
from fpt_ros.messages.frames import Command, Desired
from fpt_ros.messages.topics import COMMAND, DESIRED, JOINT_STATE
from fpt_ros.runs.cost import MEMORY, PROCESS, PROCESSOR
from fpt_ros.runs.latency import CYCLES, HISTOGRAM, LARGEST, MISSED

TIME_POINTS = [0, 1_000_000, 2_000_000]


def test_run_is_read_back_to_the_bit(recorded: Recorded) -> None:
    expected = recorded.topics
    for path in (recorded.directory, recorded.file):
        run = reader.read_run(path)
        assert run.topics.keys() == expected.keys()
        for name, series in run.topics.items():
            same(series, expected[name])
        assert run.info == {**INFO, "complete": "true", "reason": ""}


def test_parameters_keep_their_types(recorded: Recorded) -> None:
    run = reader.read_run(recorded.directory)
    assert run.parameters == recorded.parameters
    for node, values in recorded.parameters.items():
        for name, value in values.items():
            assert type(run.parameters[node][name]) is type(value), f"{node}.{name}"


SCALARS = st.one_of(
    st.booleans(),
    st.integers(-(2**63), 2**63 - 1),
    st.floats(allow_nan=False, allow_infinity=False),
    st.text(st.characters(codec="utf-8", exclude_categories=["Cc", "Cs", "Zl", "Zp"])),
)


@settings(deadline=None, max_examples=50 if samples.whole else 15)
@given(value=st.one_of(SCALARS, st.lists(st.floats(-1e300, 1e300), min_size=1)))
def test_any_parameter_comes_back(tmp_path_factory: pytest.TempPathFactory, value: object) -> None:
    path = tmp_path_factory.mktemp("p") / "bag"
    with BagWriter(path, {"node": {"a.b": value}}, {}) as bag:  # type: ignore[dict-item]
        bag.write("/joint_states", JOINT_STATE, 0, message(0))
    found = reader.read_run(path).parameters["node"]["a.b"]
    assert found == value
    assert type(found) is type(value)


def test_namespace_and_time_sharing(tmp_path: Path) -> None:
    path = tmp_path / "bag"
    codec, other = Codec(DESIRED), Codec(COMMAND)
    with BagWriter(path, {"node": {"a": 1}}, {"experiment": "swing"}) as bag:
        bag.add_topic("/a/b/tuning", JOINT_STATE)
        bag.write("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray", 0, bytes(16))
        for stamp, names in zip(TIME_POINTS, [("x",), ("y",), ()], strict=True):
            vector = tuple(float(stamp) for _ in names)
            data = codec.encode(Desired(stamp, names, vector, vector, vector, vector))
            bag.write("/a/b/desired", DESIRED.type, stamp, data)
        data = other.encode(Command(0, ("x", "y"), (np.nan, 2.0), (3.0, -0.0)))
        bag.write("/a/b/command", COMMAND.type, 0, data)
    run = reader.read_run(path)
    assert set(run.topics) == {"desired", "command"}
    desired = run.topics["desired"]
    assert desired.names == ("x", "y")
    expected = [[0.0, np.nan], [np.nan, 1e6], [np.nan, np.nan]]
    assert np.array_equal(desired.vectors["positions"], expected, equal_nan=True)
    assert np.signbit(run.topics["command"].column("effort", "y"))
    about = reader.info(path)
    assert about["namespace"] == "/a/b"
    assert about["topics"]["/a/b/tuning"] == {"type": JOINT_STATE, "messages": 0}  # type: ignore[index]


DIAGNOSTICS = "diagnostic_msgs/msg/DiagnosticArray"


def told(node: str, **values: object) -> bytes:
    """A message on /diagnostics, written by rosbags."""
    store = get_typestore(Stores.ROS2_JAZZY)
    types = store.types
    stamp = types["builtin_interfaces/msg/Time"](sec=1, nanosec=0)
    pair = types["diagnostic_msgs/msg/KeyValue"]
    status = types["diagnostic_msgs/msg/DiagnosticStatus"](
        level=0,
        name=node,
        message="cycle",
        hardware_id="fpt_ros",
        values=[pair(key=key, value=str(value)) for key, value in values.items()],
    )
    header = types["std_msgs/msg/Header"](stamp=stamp, frame_id="")
    return bytes(
        store.serialize_cdr(types[DIAGNOSTICS](header=header, status=[status]), DIAGNOSTICS)
    )


def timed(histogram: str, missed: int = 0, cycles: int = 9) -> dict[str, object]:
    return {HISTOGRAM: histogram, LARGEST: "7.5", MISSED: missed, CYCLES: cycles}


@pytest.mark.parametrize("namespace", ["/", "/robot1"])
def test_the_last_word_of_the_plant_on_its_latencies(tmp_path: Path, namespace: str) -> None:
    path, inside = tmp_path / "bag", namespace.rstrip("/")
    plant = f"{inside}/plant_simulator".lstrip("/")
    with BagWriter(path, {"node": {"a": 1}}, {"namespace": namespace}) as bag:
        bag.write(f"{inside}/joint_states", JOINT_STATE, 0, message(0))
        for data in (
            told(plant, **timed("0.3162:3", 1, 5)),
            told(plant, **timed("0.3162:8 0.3981:2", 4, 14)),
            told("other/plant_simulator", **timed("0.01:1")),
            told("denoiser", cycles=3),
        ):
            bag.write("/diagnostics", DIAGNOSTICS, 0, data)
    found = reader.read_run(path).latency
    assert found is not None
    assert (found.total, found.missed, found.cycles, found.largest) == (10, 4, 14, 7.5e-3)
    assert found.quantile(0.5) == pytest.approx(10**-3.5, rel=0.06)
    assert found.quantile(0.99) == pytest.approx(10**-3.4, rel=0.06)


@pytest.mark.parametrize("namespace", ["/", "/robot1"])
def test_what_the_nodes_of_the_run_take_of_the_machine(tmp_path: Path, namespace: str) -> None:
    """Of the same domain another robot, a driver, and nodes of a version that did not tell it."""
    path, inside = tmp_path / "bag", namespace.strip("/")
    node = f"{inside}/denoiser".lstrip("/")
    with BagWriter(path, {"node": {"a": 1}}, {"namespace": namespace}) as bag:
        bag.write(f"{namespace.rstrip('/')}/joint_states", JOINT_STATE, 0, message(0))
        for data in (
            told(node, **{PROCESS: "1@a", PROCESSOR: "12.5", MEMORY: "80.5"}),
            told("robot2/denoiser", **{PROCESS: "2@a", PROCESSOR: "99.0", MEMORY: "1.0"}),
            told(node, **{PROCESS: "1@a", PROCESSOR: "7.5", MEMORY: "81.0"}),
            told(node, cycles=3),
            told(f"{node}: camera", **{PROCESSOR: "much"}),
        ):
            bag.write("/diagnostics", DIAGNOSTICS, 0, data)
    assert reader.info(path)["costs"] == [
        {
            "nodes": ["denoiser"],
            "reports": 2,
            "processor_mean_percent": 10.0,
            "processor_max_percent": 12.5,
            "memory_start_mb": 80.5,
            "memory_end_mb": 81.0,
            "memory_growth_mb": 0.5,
        }
    ]
    (cost,) = reader.read_run(path).costs
    assert cost.growth == 0.5


def test_a_list_that_was_emptied_in_flight_and_told_as_one_of_bytes(tmp_path: Path) -> None:
    """As nodes did before they knew of it: rclpy takes an empty list for one of bytes."""
    path, kind, types = tmp_path / "bag", changes.TYPE, schemas.types()
    empty = types["rcl_interfaces/msg/ParameterValue"](type=5, **changes._EMPTY)
    parameter = types["rcl_interfaces/msg/Parameter"](name="safe_effort", value=empty)
    stamp = types["builtin_interfaces/msg/Time"](sec=1, nanosec=0)
    event = types[kind](
        stamp=stamp,
        node="/fpt_deformer",
        new_parameters=[],
        changed_parameters=[parameter],
        deleted_parameters=[],
    )
    with BagWriter(path, {"node": {"a": 1}}, {}) as bag:
        bag.write("/joint_states", JOINT_STATE, 0, message(0))
        bag.write("/parameter_changes", kind, 0, schemas.encode(kind, event))
    (change,) = reader.read_run(path).changes
    assert change.values == {"safe_effort": []}


def test_in_lockstep_there_are_no_latencies(recorded: Recorded) -> None:
    assert reader.read_run(recorded.directory).latency is None


@pytest.mark.parametrize(
    "data",
    [
        HISTOGRAM.encode(),
        told("plant_simulator", **timed("nothing")),
        told("plant_simulator", **{**timed("0.3:1"), CYCLES: "many"}),
        told("denoiser", **{PROCESSOR: "much", MEMORY: "80.5"}),
    ],
)
def test_diagnostics_that_are_none(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "bag"
    with BagWriter(path, {"node": {"a": 1}}, {}) as bag:
        bag.write("/joint_states", JOINT_STATE, 0, message(0))
        bag.write("/diagnostics", DIAGNOSTICS, 0, data)
    with pytest.raises(BadInput, match="/diagnostics at 0 s: ") as caught:
        reader.read_run(path)
    assert "\n" not in str(caught.value)


def test_two_loops_in_a_bag(tmp_path: Path) -> None:
    def record(path: Path, info: dict[str, str]) -> None:
        with BagWriter(path, {"node": {"a": 1}}, info) as bag:
            for number, name in enumerate(("r1", "r2")):
                bag.write(f"/{name}/joint_states", JOINT_STATE, 0, message(0, float(number)))

    record(tmp_path / "both", {})
    with pytest.raises(BadInput, match="holds the loops of /r1, /r2: record one namespace a bag"):
        reader.read_run(tmp_path / "both")
    record(tmp_path / "one", {"namespace": "/r2"})
    series = reader.read_run(tmp_path / "one").topics["joint_states"]
    assert series.column("position", "q1").tolist() == [1.0]
    assert reader.info(tmp_path / "one")["namespace"] == "/r2"


def test_info(recorded: Recorded) -> None:
    about = reader.info(recorded.directory)
    assert json.loads(json.dumps(about)) == about
    assert about["experiment"] == "tora"
    assert about["complete"] is True
    assert about["duration"] == pytest.approx(0.999)
    assert about["start"] == 0.0
    assert about["messages"] == len(recorded.frames)
    assert about["costs"] == []
    assert about["topics"]["/command"]["messages"] == 1000  # type: ignore[index]
    assert about["size"] == sum(path.stat().st_size for path in recorded.directory.iterdir())
    assert about["files"] == ["tora_0.mcap"]
    assert about["parameters"]["plant_simulator"]["dt"] == 0.001  # type: ignore[index]


def test_recording_without_messages(tmp_path: Path) -> None:
    BagWriter(tmp_path / "bag", {"node": {"a": 1}}, INFO).close("nothing came")
    with pytest.raises(BadInput, match="holds no messages on the loop's topics: joint_states"):
        reader.read_run(tmp_path / "bag")
    about = reader.info(tmp_path / "bag")
    assert (about["messages"], about["start"], about["duration"]) == (0, None, 0.0)
