"""What is recovered, all other readers open; what was acknowledged to the plant is in it."""

import subprocess
import sys
from pathlib import Path

import pytest
from damaged import positions, recording
from mcap.reader import make_reader
from mcap_ros2.reader import read_ros2_messages
from rosbags.highlevel import AnyReader
from ruamel.yaml import YAML

from fpt_ros.bags import reader
from fpt_ros.bags.recover import recover
from fpt_ros.bags.split import Split
from fpt_ros.errors import BadInput, RunFailed


def by_others(directory: Path) -> list[list[float]]:
    """Positions of q1 by rosbags, and by mcap-ros2-support."""
    with AnyReader([directory]) as bag:
        connections = [each for each in bag.connections if each.topic == "/joint_states"]
        first = [
            float(bag.deserialize(raw, connection.msgtype).position[0])
            for connection, _, raw in bag.messages(connections=connections)
        ]
    second = [
        float(item.ros_msg.position[0])
        for path in sorted(directory.glob("*.mcap"))
        for item in read_ros2_messages(str(path), topics=["/joint_states"])
    ]
    return [first, second]


def test_of_a_cut_file(tmp_path: Path) -> None:
    path = recording(tmp_path / "bag")
    path.write_bytes(path.read_bytes()[: path.stat().st_size * 2 // 3])
    found, _ = positions(path)
    done = recover(path)
    assert done.directory == tmp_path / "bag" / "bag_0-recovered"
    assert done.counts["/joint_states"] == len(found) < 400
    assert done.missing
    assert by_others(done.directory) == [found, found]
    about = reader.info(done.directory)
    assert (about["complete"], about["missing"]) == (False, [])
    assert str(about["reason"]).startswith("the recording was cut: bag_0.mcap was cut in the rec")
    assert reader.read_run(done.directory).parameters == reader.read_run(path).parameters
    with (done.directory / "bag_0-recovered_0.mcap").open("rb") as stream:
        assert len(list(make_reader(stream, validate_crcs=True).iter_messages())) == sum(
            done.counts.values()
        )


def test_of_a_whole_recording_is_the_same_recording(tmp_path: Path) -> None:
    recording(tmp_path / "bag", split=Split(size=65536), cycles=1200)
    assert len(list((tmp_path / "bag").glob("*.mcap"))) > 2
    done = recover(tmp_path / "bag", tmp_path / "again")
    assert done.missing == ()
    one, other = (reader.info(tmp_path / name) for name in ("bag", "again"))
    kept = ("complete", "reason", "messages", "topics", "parameters", "experiment", "start")
    assert {key: one[key] for key in kept} == {key: other[key] for key in kept}
    yaml = YAML(typ="safe").load(tmp_path / "again" / "metadata.yaml")
    about = yaml["rosbag2_bagfile_information"]
    assert about["message_count"] == 2400
    assert by_others(tmp_path / "bag") == by_others(tmp_path / "again")


def test_nothing_to_recover_leaves_nothing(tmp_path: Path) -> None:
    path = recording(tmp_path / "bag")
    path.write_bytes(path.read_bytes()[:900])
    with pytest.raises(BadInput, match=r"there is nothing to recover: bag_0\.mcap was cut"):
        recover(path, tmp_path / "out")
    assert [each.name for each in tmp_path.iterdir()] == ["bag"]
    with pytest.raises(BadInput, match="exists: --out takes the name of a new directory"):
        recover(recording(tmp_path / "other"), tmp_path / "bag")
    (tmp_path / "file").touch()
    with pytest.raises(BadInput, match="cannot be created"):
        recover(tmp_path / "other", tmp_path / "file" / "x")


ACKNOWLEDGE_UNTIL_KILLED = """
import sys
from pathlib import Path
from fpt_ros.bags.split import Split
from fpt_ros.bags.writer import BagWriter
from fpt_ros.messages.cdr import Codec
from fpt_ros.messages.frames import JointStates
from fpt_ros.messages.topics import JOINT_STATES

codec = Codec(JOINT_STATES)
bag = BagWriter(Path(sys.argv[1]), {"a": {"b": 1}}, {"experiment": "x"}, Split(size=100_000), True)
for cycle in range(10**9):
    frame = JointStates(cycle, ("q1",), (float(cycle),), (0.0,), (0.0,))
    bag.write("/joint_states", JOINT_STATES.type, cycle, codec.encode(frame))
    sys.stdout.write(f"{cycle}\\n")
    sys.stdout.flush()
"""


@pytest.mark.parametrize("after", [1, 700, 2500, 4100])
def test_what_was_acknowledged_survives_a_kill(tmp_path: Path, after: int) -> None:
    command = [sys.executable, "-c", ACKNOWLEDGE_UNTIL_KILLED, str(tmp_path / "bag")]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        for _ in range(after):
            last = process.stdout.readline()
        process.kill()
        rest = process.stdout.read().split("\n")[:-1]
        acknowledged = int(rest[-1]) if rest else int(last)
    found, bag = positions(tmp_path / "bag")
    assert found == [float(k) for k in range(len(found))]
    assert acknowledged < len(found) <= acknowledged + 2
    assert bag.missing
    done = recover(tmp_path / "bag", tmp_path / "out")
    assert by_others(done.directory) == [found, found]


def test_of_a_writer_killed_between_two_files(tmp_path: Path) -> None:
    path = recording(tmp_path / "bag", split=Split(size=65536), cycles=1200)
    later = sorted((tmp_path / "bag").glob("*.mcap"))[1:]
    for each in [*later, tmp_path / "bag" / "metadata.yaml"]:
        each.unlink()
    found, bag = positions(tmp_path / "bag")
    assert bag.missing == ["bag_1.mcap, in which bag_0.mcap goes on, is not there"]
    about = reader.info(tmp_path / "bag")
    assert (about["complete"], about["reason"]) == (False, "the recording was cut")
    done = recover(tmp_path / "bag", tmp_path / "out")
    assert done.missing == tuple(bag.missing)
    assert by_others(done.directory) == [found, found]
    assert reader.info(path)["reason"] == "it goes on in bag_1.mcap"


@pytest.mark.parametrize(
    ("lost", "missing"),
    [
        ((0,), ["bag_0.mcap is not there"]),
        ((1, 3), ["bag_1.mcap is not there", "bag_3.mcap is not there"]),
        ((0, 1, 2, 3), [f"bag_{k}.mcap is not there" for k in range(4)]),
        ((4,), ["bag_4.mcap, in which bag_3.mcap goes on, is not there"]),
    ],
)
def test_of_a_split_recording_that_lacks_files(tmp_path, monkeypatch, lost, missing):
    path = recording(tmp_path / "bag", split=Split(size=65536), cycles=1200)
    assert len(list(path.parent.glob("*.mcap"))) == 5
    (path.parent / "metadata.yaml").unlink()
    for number in lost:
        (path.parent / f"bag_{number}.mcap").unlink()
    _, bag = positions(path.parent)
    assert bag.missing == missing
    monkeypatch.chdir(path.parent)  # where its name is not in the path
    assert reader.info(Path("."))["missing"] == missing
    assert reader.info(Path("."))["complete"] is False


def test_a_directory_that_was_removed(tmp_path: Path) -> None:
    from damaged import INFO, PARAMETERS, fill

    from fpt_ros.bags.writer import BagWriter

    bag = BagWriter(tmp_path / "bag", PARAMETERS, INFO, aside=True)
    fill(bag, 10)
    for each in (tmp_path / "bag").iterdir():
        each.unlink()
    (tmp_path / "bag").rmdir()
    with pytest.raises(RunFailed, match=r"bag_0.mcap cannot be written: it has been removed"):
        bag.flush()
    bag.close()
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("text", ["1KB", "MB", "10", "-5s", "10 parsecs", "0s"])
def test_words_for_a_split_that_are_none(text: str) -> None:
    with pytest.raises(BadInput, match=r"--split .*: it takes a size"):
        Split.parse(text)


def test_split_by_duration(tmp_path: Path) -> None:
    recording(tmp_path / "bag", 400, 1, Split.parse("0.1s"))
    about = reader.info(tmp_path / "bag")
    assert about["files"] == [f"bag_{k}.mcap" for k in range(4)]
    assert (about["messages"], about["complete"]) == (800, True)
    middle = reader.info(tmp_path / "bag" / "bag_1.mcap")
    assert (middle["complete"], middle["reason"]) == (False, "it goes on in bag_2.mcap")
    assert reader.read_run(tmp_path / "bag" / "bag_1.mcap").topics["command"].stamps[0] > 0
