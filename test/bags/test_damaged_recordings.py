"""Recordings as they come out of crashes, full disks and other tools: read as far as they go."""

import os
import random
import shutil
import struct
from pathlib import Path

import pytest
import zstandard
from damaged import PARAMETERS, STEP, positions, recording, states
from mcap.reader import make_reader
from mcap.writer import CompressionType, IndexType, Writer

from fpt_ros.bags import reader
from fpt_ros.bags.bag import Bag
from fpt_ros.bags.schemas import schema
from fpt_ros.errors import BadInput
from fpt_ros.messages.topics import JOINT_STATE

TRIALS = int(os.environ.get("FPT_ROS_TRIALS", "150"))
"""Bytes to cut at and bits to flip; a large number tries them all."""

CYCLES, CHUNK = 400, 100


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return recording(tmp_path_factory.mktemp("whole") / "bag", CYCLES)


def places(size: int) -> list[int]:
    """A sample of a file's bytes, the same in every run; all where TRIALS says so."""
    return (
        list(range(size))
        if size <= TRIALS
        else sorted(random.Random(14).sample(range(size), TRIALS))
    )


def chunk_ends(path: Path) -> list[int]:
    with path.open("rb") as stream:
        summary = make_reader(stream).get_summary()
    assert summary is not None
    return sorted(each.chunk_start_offset + each.chunk_length for each in summary.chunk_indexes)


def test_a_whole_recording_is_whole(whole: Path) -> None:
    found, bag = positions(whole)
    assert found == [float(k) for k in range(CYCLES)]
    assert bag.missing == []
    assert reader.info(whole.parent)["complete"] is True


def test_cut_anywhere(whole: Path, tmp_path: Path) -> None:
    data, ends = whole.read_bytes(), chunk_ends(whole)
    path = tmp_path / "cut.mcap"
    for size in places(len(data)):
        path.write_bytes(data[:size])
        if size < 8:
            with pytest.raises(BadInput, match="is not an MCAP file"):
                positions(path)
            continue
        found, bag = positions(path)
        assert bag.missing, size
        assert found == [float(k) for k in range(len(found))], size
        assert len(found) >= CHUNK * sum(end <= size for end in ends), size
        assert reader.info(path)["complete"] is False


def test_any_bit_flipped(whole: Path, tmp_path: Path) -> None:
    data, path = whole.read_bytes(), tmp_path / "flipped.mcap"
    bits = random.Random(15)
    for at in places(len(data)):
        flipped = bytearray(data)
        flipped[at] ^= 1 << bits.randrange(8)
        path.write_bytes(flipped)
        found, bag = positions(path)
        assert bag.missing, at
        assert set(found) <= {float(k) for k in range(CYCLES)}, at
        assert len(found) >= CYCLES - CHUNK, at
        assert reader.info(path)["complete"] is False, at
        try:
            run = reader.read_run(path)
        except BadInput:
            continue
        assert run.info["complete"] == "false", at


def test_several_bytes_lost_in_the_middle(whole: Path, tmp_path: Path) -> None:
    data, path = whole.read_bytes(), tmp_path / "hole.mcap"
    with whole.open("rb") as stream:
        summary = make_reader(stream).get_summary()
    assert summary is not None
    second = sorted(each.chunk_start_offset for each in summary.chunk_indexes)[1]
    path.write_bytes(data[: second + 500] + data[second + 800 :])
    found, bag = positions(path)
    assert found == [float(k) for k in range(CYCLES) if not CHUNK <= k < 2 * CHUNK]
    assert any("are damaged" in line for line in bag.missing)


def test_zeros_at_the_end(whole: Path, tmp_path: Path) -> None:
    path = tmp_path / "zeros.mcap"
    path.write_bytes(whole.read_bytes()[: chunk_ends(whole)[2]] + bytes(5000))
    found, bag = positions(path)
    assert len(found) == 3 * CHUNK
    assert "ends in zeros after byte" in bag.missing[0]


def test_the_end_in_front_of_a_cut_file(whole: Path, tmp_path: Path) -> None:
    """As tools leave it that write metadata first."""
    with whole.open("rb") as stream:
        end = next(each for each in make_reader(stream).iter_metadata() if "end" in each.name)
    path = tmp_path / "front.mcap"
    with path.open("wb") as stream:
        writer = Writer(stream)
        writer.start("ros2")
        writer.add_metadata(end.name, end.metadata)
        writer._Writer__stream.flush()
    data = whole.read_bytes()
    behind_header = 8 + 9 + struct.unpack_from("<Q", data, 9)[0]
    path.write_bytes(path.read_bytes() + data[behind_header : chunk_ends(whole)[1]])
    about = reader.info(path)
    assert about["complete"] is False
    assert f"200 of {CYCLES} messages on /command are missing" in about["missing"]  # type: ignore[operator]


def test_absurd_lengths(whole: Path, tmp_path: Path) -> None:
    data, path = whole.read_bytes(), tmp_path / "absurd.mcap"
    for opcode in range(1, 16):
        path.write_bytes(data[:60] + struct.pack("<BQ", opcode, 1 << 62) + bytes(200))
        assert positions(path)[0] == []
    start = chunk_ends(whole)[0]
    at = data.index(b"\x06", start)
    huge = bytearray(data)
    huge[at + 25 : at + 33] = struct.pack("<Q", 1 << 61)  # uncompressed size
    path.write_bytes(huge)
    assert len(positions(path)[0]) >= CYCLES - CHUNK


# --- files of other tools, and folders


def written(path: Path, count: int = 50, **options: object) -> Path:
    """A file of mcap's own writer, of a good topic."""
    with path.open("wb") as stream:
        writer = Writer(stream, **options)  # type: ignore[arg-type]
        writer.start("ros2")
        text = schema(JOINT_STATE).text.encode()
        channel = writer.register_channel(
            "/joint_states", "cdr", writer.register_schema(JOINT_STATE, "ros2msg", text)
        )
        strange = writer.register_channel(
            "/strange", "protobuf", writer.register_schema("x.Y", "protobuf", b"\x01\x02")
        )
        for k in range(count):
            writer.add_message(channel, k * STEP, states(k), k * STEP)
            writer.add_message(strange, k * STEP, b"\xff\x00", k * STEP)
        writer.finish()
    return path


@pytest.mark.parametrize(
    "options",
    [
        {"compression": CompressionType.NONE},
        {"compression": CompressionType.LZ4},
        {"use_chunking": False},
        {"index_types": IndexType.NONE, "use_statistics": False, "use_summary_offsets": False},
        {"index_types": IndexType.CHUNK},
        {"repeat_channels": False, "repeat_schemas": False, "chunk_size": 100},
        {"enable_crcs": False},
        {"enable_data_crcs": True},
    ],
)
def test_forms_of_mcap(tmp_path: Path, options: dict[str, object]) -> None:
    found, bag = positions(written(tmp_path / "a.mcap", **options))
    assert found == [float(k) for k in range(50)]
    assert bag.missing == []


def test_messages_outside_of_chunks_are_found_behind_damage(tmp_path: Path) -> None:
    path = written(tmp_path / "a.mcap", use_chunking=False)
    data = bytearray(path.read_bytes())
    middle = data.index(states(25))
    data[middle - 31 + 1] ^= 0x40  # the length of the message
    path.write_bytes(data)
    found, bag = positions(path)
    assert set(found) >= {float(k) for k in range(50)} - {24.0, 25.0, 26.0}
    assert bag.missing


def test_no_metadata_yaml(whole: Path, tmp_path: Path) -> None:
    shutil.copy(whole, tmp_path / "bag_0.mcap")
    about = reader.info(tmp_path)
    assert (about["complete"], about["notes"]) == (True, ["there is no metadata.yaml"])


@pytest.mark.parametrize("text", ["", "{", "a: [1", "rosbag2_bagfile_information: 3", "\x00"])
def test_bad_metadata_yaml(whole: Path, tmp_path: Path, text: str) -> None:
    shutil.copy(whole, tmp_path / "bag_0.mcap")
    (tmp_path / "metadata.yaml").write_text(text)
    found, bag = positions(tmp_path)
    assert len(found) == CYCLES
    assert bag.missing == ["metadata.yaml cannot be read: all files of the folder are taken"]


def test_empty_storage_identifier(whole: Path, tmp_path: Path) -> None:
    shutil.copytree(whole.parent, tmp_path / "bag")
    yaml = tmp_path / "bag" / "metadata.yaml"
    yaml.write_text(yaml.read_text().replace("storage_identifier: mcap", 'storage_identifier: ""'))
    assert len(positions(tmp_path / "bag")[0]) == CYCLES


def test_a_second_recording_in_the_folder(whole: Path, tmp_path: Path) -> None:
    folder = tmp_path / "bag"
    shutil.copytree(whole.parent, folder)
    shutil.copy(recording(tmp_path / "other", first=5000), folder / "other_0.mcap")
    found, bag = positions(folder)
    assert found == [float(k) for k in range(CYCLES)]
    assert bag.notes == ["other_0.mcap is not named in metadata.yaml and is left out"]
    (folder / "metadata.yaml").unlink()
    with pytest.raises(BadInput, match=r"holds several recordings \(bag_0.mcap, other_0.mcap\)"):
        Bag(folder)


def test_a_named_file_that_is_not_there(tmp_path: Path) -> None:
    from fpt_ros.bags.split import Split

    recording(tmp_path / "bag", 3000, split=Split(size=100_000))
    assert reader.info(tmp_path / "bag")["complete"] is True
    assert len(reader.info(tmp_path / "bag")["files"]) > 2  # type: ignore[arg-type]
    (tmp_path / "bag" / "bag_1.mcap").unlink()
    about = reader.info(tmp_path / "bag")
    assert about["complete"] is False
    assert "bag_1.mcap is named in metadata.yaml and is not there" in about["missing"]  # type: ignore[operator]


def test_fewer_messages_than_metadata_yaml_counts(whole: Path, tmp_path: Path) -> None:
    shutil.copytree(whole.parent, tmp_path / "bag")
    yaml = tmp_path / "bag" / "metadata.yaml"
    yaml.write_text(yaml.read_text().replace(f"message_count: {CYCLES}\n", "message_count: 999\n"))
    about = reader.info(tmp_path / "bag")
    assert about["complete"] is False
    assert "599 of 999 messages on /command are missing" in about["missing"]  # type: ignore[operator]


@pytest.mark.parametrize("cut", [0, 30])
def test_compressed_as_a_file(whole: Path, tmp_path: Path, cut: int) -> None:
    packed = zstandard.compress(whole.read_bytes())
    path = tmp_path / "bag_0.mcap.zstd"
    path.write_bytes(packed[: len(packed) - cut])
    if cut:  # too little is left of so small a file
        with pytest.raises(BadInput, match="is not an MCAP file"):
            Bag(path).messages().__next__()
        return
    for way in (tmp_path, path):
        found, bag = positions(way)
        assert (len(found), bag.missing) == (CYCLES, [])


def test_a_pipe_is_refused(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.mcap")
    with pytest.raises(BadInput, match="is a pipe or a device"):
        Bag(tmp_path / "pipe.mcap")


def test_parameters_with_another_checksum(whole: Path, tmp_path: Path) -> None:
    data = bytearray(whole.read_bytes())
    at = data.index(b"seed: 7")
    data[at + 6 : at + 7] = b"8"
    path = tmp_path / "seed.mcap"
    path.write_bytes(data)
    run = reader.read_run(path)
    assert run.info["complete"] == "false"
    assert "the attachment parameters.yaml is damaged" in run.info["missing"]
    assert PARAMETERS["plant_simulator"]["seed"] == 7
