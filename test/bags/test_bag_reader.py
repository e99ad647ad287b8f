"""Reading back: what was recorded, what is left of it, and what is refused."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.reader import make_reader
from mcap.writer import Writer
from recorded_run import INFO, Recorded
from rosbags.typesys import Stores, get_typestore

from fpt_ros.bags import reader
from fpt_ros.bags.schemas import schema
from fpt_ros.bags.writer import BagWriter
from fpt_ros.errors import BadInput
from fpt_ros.messages.cdr import Codec
from fpt_ros.messages.frames import Command, Desired, JointStates
from fpt_ros.messages.topics import COMMAND, DESIRED, JOINT_STATE, JOINT_STATES
from fpt_ros.runs.latency import CYCLES, HISTOGRAM, LARGEST, MISSED
from fpt_ros.runs.run import Run, Series

CODEC = Codec(JOINT_STATES)
TIME_POINTS = [0, 1_000_000, 2_000_000]


def same(a: Series, b: Series, count: int | None = None) -> None:
    assert a.names == b.names
    assert a.stamps.tobytes() == b.stamps[:count].tobytes()
    for name, numbers in a.vectors.items():
        assert numbers.tobytes() == b.vectors[name][:count].tobytes()


def message(stamp: int, value: float = 1.0) -> bytes:
    return CODEC.encode(JointStates(stamp, ("q1",), (value,), (value,), (value,)))


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


@settings(deadline=None, max_examples=50)
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


def test_in_lockstep_there_are_no_latencies(recorded: Recorded) -> None:
    assert reader.read_run(recorded.directory).latency is None


@pytest.mark.parametrize(
    "data",
    [
        HISTOGRAM.encode(),
        told("plant_simulator", **timed("nothing")),
        told("plant_simulator", **{**timed("0.3:1"), CYCLES: "many"}),
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


def open_cut(recorded: Recorded, data: bytes, path: Path) -> Run | None:
    path.write_bytes(data)
    refused = ""
    try:
        return reader.read_run(path)
    except BadInput as error:
        refused = str(error)
    assert "\n" not in refused
    assert str(path) in refused
    return None


@settings(deadline=None, max_examples=300)
@given(data=st.data())
def test_cut_anywhere_gives_a_prefix(
    recorded: Recorded, tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    whole = recorded.file.read_bytes()
    with recorded.file.open("rb") as stream:
        summary = make_reader(stream).get_summary()
    assert summary is not None
    parameters = summary.attachment_indexes[0].offset + summary.attachment_indexes[0].length
    chunks = [
        index.chunk_start_offset + index.chunk_length
        for index in sorted(summary.chunk_indexes, key=lambda index: index.chunk_start_offset)
    ]
    marks = [parameters, *chunks, len(whole)]
    position = data.draw(
        st.one_of(
            st.integers(0, len(whole)),
            st.integers(0, 4096),
            st.sampled_from(marks).flatmap(lambda m: st.integers(m - 20, min(m + 20, len(whole)))),
        )
    )
    run = open_cut(recorded, whole[:position], tmp_path_factory.getbasetemp() / "cut.mcap")
    assert (run is not None) == (position >= parameters)
    if run is None:
        return
    expected = recorded.topics
    for name, series in run.topics.items():
        same(series, expected[name], len(series.stamps))
    count = sum(len(series.stamps) for series in run.topics.values())
    if position >= chunks[-1]:
        assert count == len(recorded.frames)
    else:
        assert (run.info["complete"], run.info["reason"]) == ("false", "the recording was cut")
        assert (count > 0) == (position >= chunks[0])
    assert run.parameters == recorded.parameters


@settings(deadline=None, max_examples=200)
@given(data=st.data())
def test_damage_anywhere_is_never_another_error(
    recorded: Recorded, tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    whole = bytearray(recorded.file.read_bytes())
    position = data.draw(st.one_of(st.integers(0, 5000), st.integers(0, len(whole) - 1)))
    patch = data.draw(st.binary(min_size=1, max_size=12))
    whole[position : position + len(patch)] = patch
    open_cut(recorded, bytes(whole), tmp_path_factory.getbasetemp() / "damaged.mcap")


def test_damaged_chunk(recorded: Recorded, tmp_path: Path) -> None:
    whole = bytearray(recorded.file.read_bytes())
    with recorded.file.open("rb") as stream:
        summary = make_reader(stream).get_summary()
    assert summary is not None
    broken = max(summary.chunk_indexes, key=lambda index: index.chunk_length).chunk_start_offset
    whole[broken + 2000] ^= 0xFF
    path = tmp_path / "damaged.mcap"
    path.write_bytes(whole)
    run = reader.read_run(path)
    assert (run.info["complete"], run.info["reason"]) == ("false", "the recording is damaged")
    assert f"the chunk at byte {broken}, messages from " in run.info["missing"]
    found, whole_series = run.topics["joint_states"], recorded.topics["joint_states"]
    assert 0 < len(found.stamps) < 1000
    assert found.stamps[-1] == whole_series.stamps[-1]  # those behind the chunk are read too
    there = np.isin(whole_series.stamps, found.stamps)
    for name, numbers in found.vectors.items():
        assert numbers.tobytes() == whole_series.vectors[name][there].tobytes()


def test_end_of_a_file_that_the_power_failed_on(recorded: Recorded, tmp_path: Path) -> None:
    path = tmp_path / "zeros.mcap"
    path.write_bytes(recorded.file.read_bytes()[:50_000] + bytes(10_000))
    assert reader.read_run(path).info["complete"] == "false"


def test_split_recording_is_read_in_order(tmp_path: Path) -> None:
    folder = tmp_path / "bag"
    folder.mkdir()
    for number in (0, 9, 10):
        with BagWriter(tmp_path / "part", {"node": {"a": 1}}, {"experiment": "x"}) as bag:
            bag.write("/joint_states", JOINT_STATE, number, message(number))
        (tmp_path / "part" / "part_0.mcap").rename(folder / f"bag_{number}.mcap")
        shutil.rmtree(tmp_path / "part")
    run = reader.read_run(folder)
    assert run.topics["joint_states"].stamps.tolist() == [0, 9, 10]
    assert run.info["complete"] == "true"


def foreign(path: Path, topic: str = "/joint_states", parameters: bytes | None = None) -> None:
    """A file of another writer: mcap's own."""
    with path.open("wb") as stream:
        writer = Writer(stream)
        writer.start("ros2")
        if parameters is not None:
            writer.add_attachment(0, 0, "parameters.yaml", "application/yaml", parameters)
        about = schema(JOINT_STATE)
        identity = writer.register_schema(JOINT_STATE, "ros2msg", about.text.encode())
        channel = writer.register_channel(topic, "cdr", identity)
        writer.add_message(channel, 7, message(7), 7)
        writer.finish()


PARAMETERS = b"/**/node:\n  ros__parameters:\n    a: 1\n"


def test_files_of_mcaps_own_writer(tmp_path: Path) -> None:
    path = tmp_path / "foreign.mcap"
    foreign(path, parameters=PARAMETERS)
    run = reader.read_run(path)
    assert run.topics["joint_states"].stamps.tolist() == [7]
    assert run.parameters == {"node": {"a": 1}}


def refuse(path: Path, text: str) -> None:
    for read in (reader.read_run, reader.info):
        with pytest.raises(BadInput, match=text) as error:
            read(path)
        assert "\n" not in str(error.value)
        assert str(path) in str(error.value)


def test_what_is_not_a_recording(tmp_path: Path) -> None:
    path = tmp_path / "there.mcap"
    refuse(path, "does not exist: it has to be")
    refuse(tmp_path, r"holds no \.mcap file: it has to be")
    for content in (b"", b"\x89MC", b"some text, not MCAP", b"#ROSBAG V1.2"):
        path.write_bytes(content)
        refuse(path, "is not an MCAP file: it has to be")
    refuse(tmp_path, "is not an MCAP file: it has to be")
    path.unlink()
    path.mkdir()
    refuse(tmp_path, "cannot be read: it is not a file")


def test_recordings_of_something_else(tmp_path: Path) -> None:
    path = tmp_path / "other.mcap"
    foreign(path)
    with pytest.raises(BadInput, match="holds no parameters: it has to be a recording of this"):
        reader.read_run(path)
    about = reader.info(path)
    assert (about["messages"], about["complete"], about["parameters"]) == (1, True, {})
    foreign(path, parameters=b"no: [yaml")
    refuse(path, "its parameters.yaml is not YAML")
    foreign(path, parameters=b"\xff\xfe")
    refuse(path, "its parameters.yaml cannot be read: not UTF-8")
    foreign(path, topic="/camera", parameters=PARAMETERS)
    with pytest.raises(BadInput, match="holds no messages on the loop's topics"):
        reader.read_run(path)


def test_cut_before_the_parameters(recorded: Recorded, tmp_path: Path) -> None:
    path = tmp_path / "cut.mcap"
    path.write_bytes(recorded.file.read_bytes()[:100])
    with pytest.raises(BadInput, match="ends before the parameters: nothing can be read"):
        reader.read_run(path)
    assert reader.info(path)["complete"] is False


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"\x00\x01\x00\x00",
        message(0)[:-1],
        CODEC.encode(JointStates(0, ("a", "b"), (1.0,), (), ())),
    ],
)
def test_bytes_that_are_no_message(tmp_path: Path, data: bytes) -> None:
    with BagWriter(tmp_path / "bag", {"node": {"a": 1}}, {}) as bag:
        bag.write("/joint_states", JOINT_STATE, 0, message(0))
        bag.write("/joint_states", JOINT_STATE, 1_500_000_000, data)
    run = reader.read_run(tmp_path / "bag")
    assert run.topics["joint_states"].stamps.tolist() == [0]
    assert run.info["complete"] == "false"
    assert "1 messages on /joint_states are not a sensor_msgs/msg/JointState" in run.info["missing"]
