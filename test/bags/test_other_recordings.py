"""Recordings that are split, of other writers, or of something else."""

import shutil
from pathlib import Path

import pytest
from mcap.writer import Writer
from messages_made import CODEC, message
from recorded_run import Recorded

from fpt_ros.bags import reader
from fpt_ros.bags.schemas import schema
from fpt_ros.bags.writer import BagWriter
from fpt_ros.errors import BadInput
from fpt_ros.messages.frames import JointStates
from fpt_ros.messages.topics import JOINT_STATE


def test_split_recording_is_read_in_order(tmp_path: Path) -> None:
    folder = tmp_path / "bag"
    folder.mkdir()
    for number in range(11):
        with BagWriter(tmp_path / "part", {"node": {"a": 1}}, {"experiment": "x"}) as bag:
            bag.write("/joint_states", JOINT_STATE, number, message(number))
        (tmp_path / "part" / "part_0.mcap").rename(folder / f"bag_{number}.mcap")
        shutil.rmtree(tmp_path / "part")
    run = reader.read_run(folder)
    assert run.topics["joint_states"].stamps.tolist() == list(range(11))
    assert run.info["complete"] == "true"


@pytest.mark.parametrize("names", [["day_20261127", "day_20261128"], ["drive_7"], ["drive"]])
def test_numbers_that_do_not_count_files(tmp_path: Path, names: list[str]) -> None:
    for stamp, name in enumerate(names):
        with BagWriter(tmp_path / "part", {"node": {"a": 1}}, {"experiment": "x"}) as bag:
            bag.write("/joint_states", JOINT_STATE, stamp, message(stamp))
        (tmp_path / "part" / "part_0.mcap").rename(tmp_path / f"{name}.mcap")
        shutil.rmtree(tmp_path / "part")
    run = reader.read_run(tmp_path)
    assert (run.info["complete"], len(run.topics["joint_states"].stamps)) == ("true", len(names))


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
