"""A writer that was killed, and one that goes on in its place: the recording of a single writer."""

import shutil

import pytest
import samples
from damaged import INFO, PARAMETERS, fill
from rosbags.highlevel import AnyReader

from fpt_ros.bags.bag import Bag
from fpt_ros.bags.files import SIDE
from fpt_ros.bags.reader import info
from fpt_ros.bags.split import Split
from fpt_ros.bags.writer import NEVER, BagWriter
from fpt_ros.messages.topics import COMMAND, JOINT_STATES

CYCLES = 60


def begun(directory, split=NEVER, again=False):
    writer = BagWriter(directory, PARAMETERS, INFO, split, aside=True, again=again)
    for topic in (JOINT_STATES, COMMAND):
        writer.add_topic(f"/{topic.name}", topic.type)
    return writer


def contents(directory):
    return [(item.source.topic, item.stamp, item.data) for item in Bag(directory).messages()]


def truth(tmp_path):
    directory = tmp_path / "truth"
    with begun(directory) as bag:
        fill(bag, CYCLES)
    return contents(directory)


def gone_on(directory, split=NEVER):
    """Another writer goes on from what is there, and ends; how many cycles there were."""
    with begun(directory, split, again=True) as bag:
        done = len(bag.stamps.get("/command", ()))
        states = len(bag.stamps.get("/joint_states", ()))
        assert states - done in (0, 1)
        assert bag.stamps.get("/command", []) == [k * 1_000_000 for k in range(done)]
        if states > done:  # the rest of a cycle
            whole = directory.with_name("whole")
            with begun(whole) as other:
                fill(other, CYCLES)
            for item in Bag(whole).messages():
                if (item.source.topic, item.stamp) == ("/command", done * 1_000_000):
                    bag.write("/command", COMMAND.type, item.stamp, item.data)
        fill(bag, CYCLES - states, states)
    return done


def is_whole(directory, tmp_path):
    assert contents(directory) == truth(tmp_path)
    about = info(directory)
    assert (about["complete"], about["missing"], about["notes"]) == (True, [], [])
    assert about["experiment"] == "tora"
    assert about["parameters"]["plant_simulator"] == PARAMETERS["plant_simulator"]
    assert not list(directory.glob(f"*{SIDE}*"))
    with AnyReader([directory]) as reader:
        assert reader.message_count == 2 * CYCLES
        assert sum(1 for _ in reader.messages()) == 2 * CYCLES


@pytest.mark.parametrize("chunks", [0, 1, 3])
def test_between_two_messages(tmp_path, chunks):
    writer = begun(tmp_path / "bag")
    for chunk in range(chunks):
        fill(writer, 10, 10 * chunk)
        writer.flush()
    fill(writer, 7, 10 * chunks)
    assert gone_on(tmp_path / "bag") == 10 * chunks + 7
    is_whole(tmp_path / "bag", tmp_path)


def test_one_after_the_other(tmp_path):
    for done in (0, 5, 10, 25):
        writer = begun(tmp_path / "bag", again=done > 0)
        assert len(writer.stamps.get("/command", ())) == done
        fill(writer, 25 - done if done == 10 else 5, done)
        if done == 10:
            writer.flush()
    assert gone_on(tmp_path / "bag") == 30
    is_whole(tmp_path / "bag", tmp_path)


def cuts_of(before, after):
    return range(before, after + 1)


def test_in_the_middle_of_writing_a_chunk(tmp_path):
    """The side file still has all that the chunk holds, whatever of it came to the disk."""
    writer = begun(tmp_path / "bag")
    fill(writer, 10)
    writer.flush()
    fill(writer, 10, 10)
    path = writer.path
    side = path.with_name(path.name + SIDE)
    before, aside = path.stat().st_size, side.read_bytes()
    writer.flush()
    whole = path.read_bytes()
    for cut in samples.sample(cuts_of(before, len(whole)), 12, keep=(before, len(whole))):
        shutil.rmtree(tmp_path / "bag")
        path.parent.mkdir()
        path.write_bytes(whole[:cut])
        side.write_bytes(aside)
        assert gone_on(tmp_path / "bag") == 20
        is_whole(tmp_path / "bag", tmp_path)
        shutil.rmtree(tmp_path / "truth")


def test_in_the_middle_of_a_message_or_of_the_beginning(tmp_path):
    writer = begun(tmp_path / "bag")
    fill(writer, 3)
    path = writer.path
    side = path.with_name(path.name + SIDE)
    whole, aside = path.read_bytes(), side.read_bytes()
    for size in samples.sample(cuts_of(0, len(whole) + len(aside)), 16):
        shutil.rmtree(tmp_path / "bag")
        path.parent.mkdir()
        path.write_bytes(whole[: max(size, 1)])
        if size > len(whole):
            side.write_bytes(aside[: size - len(whole)])
        gone_on(tmp_path / "bag")
        is_whole(tmp_path / "bag", tmp_path)
        shutil.rmtree(tmp_path / "truth")
        shutil.rmtree(tmp_path / "whole", ignore_errors=True)


@pytest.mark.parametrize("at", [15, 20, 21, 47])
def test_where_it_is_split(tmp_path, at):
    split = Split.parse("0.02s")
    writer = begun(tmp_path / "bag", split)
    fill(writer, at)
    assert gone_on(tmp_path / "bag", split) == at
    is_whole(tmp_path / "bag", tmp_path)
    assert [path.name for path in sorted((tmp_path / "bag").glob("*.mcap"))] == [
        "bag_0.mcap", "bag_1.mcap", "bag_2.mcap",
    ]  # fmt: skip


def test_after_the_end(tmp_path):
    with begun(tmp_path / "bag") as bag:
        fill(bag, 12)
    assert gone_on(tmp_path / "bag") == 12
    is_whole(tmp_path / "bag", tmp_path)
