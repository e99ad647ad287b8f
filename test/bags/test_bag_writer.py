"""Recordings as other libraries read them."""

from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from mcap.reader import make_reader
from mcap_ros2.reader import read_ros2_messages
from recorded_run import INFO, Recorded
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore
from ruamel.yaml import YAML

from fpt_ros.bags.schemas import offered_qos, schema, yaml_text
from fpt_ros.experiments import experiment
from fpt_ros.messages.topics import BY_NAME, JOINT_STATE, JOINT_TRAJECTORY, Topic


def fields(topic: Topic, message: object) -> dict[str, list[float]]:
    """The arrays of a deserialised message, of any library."""
    source = message.points[0] if topic.type == JOINT_TRAJECTORY else message  # type: ignore[attr-defined]
    return {name: list(getattr(source, name)) for name in topic.fields}


def names(topic: Topic, message: object) -> tuple[str, ...]:
    return tuple(message.joint_names if topic.type == JOINT_TRAJECTORY else message.name)  # type: ignore[attr-defined]


def check(recorded: Recorded, seen: Iterator[tuple[str, int, int, object]]) -> None:
    """(topic, log time, seconds and nanoseconds in the header, message) of all messages."""
    expected = {name: iter(recorded.of(topic)) for name, topic in BY_NAME.items()}
    counts = Counter[str]()
    for name, log_time, stamp, message in seen:
        topic = BY_NAME[name.removeprefix("/")]
        frame = next(expected[topic.name])
        counts[topic.name] += 1
        assert log_time == stamp == frame.stamp
        assert names(topic, message) == frame.names
        for got, vector in zip(fields(topic, message).values(), frame[2:], strict=True):
            assert np.array_equal(got, vector, equal_nan=True)
    assert counts == Counter(topic.name for topic, _ in recorded.frames)


def test_rosbags_reads_it(recorded: Recorded) -> None:
    store = get_typestore(Stores.ROS2_JAZZY)
    with AnyReader([recorded.directory], default_typestore=store) as bag:
        assert bag.message_count == len(recorded.frames)
        assert bag.duration == 999_000_001

        def seen() -> Iterator[tuple[str, int, int, object]]:
            for connection, time, data in bag.messages():
                message = bag.deserialize(data, connection.msgtype)
                stamp = message.header.stamp
                yield connection.topic, time, stamp.sec * 10**9 + stamp.nanosec, message

        check(recorded, seen())


def test_mcap_ros2_reads_it(recorded: Recorded) -> None:
    def seen() -> Iterator[tuple[str, int, int, object]]:
        for item in read_ros2_messages(str(recorded.file)):
            stamp = item.ros_msg.header.stamp
            nanoseconds = stamp.sec * 10**9 + stamp.nanosec
            yield item.channel.topic, item.log_time_ns, nanoseconds, item.ros_msg

    check(recorded, seen())


def test_file_is_in_order_by_mcap(recorded: Recorded) -> None:
    with recorded.file.open("rb") as stream:
        bag = make_reader(stream, validate_crcs=True)
        summary = bag.get_summary()
        assert summary is not None
        assert summary.statistics is not None
        assert bag.get_header().profile == "ros2"
        assert summary.statistics.message_count == len(recorded.frames)
        assert summary.statistics.message_end_time == 999_000_000
        sequences: dict[str, int] = {}
        for about, channel, message in bag.iter_messages():
            assert about is not None
            assert about.data.decode() == schema(about.name).text
            assert message.sequence == sequences.get(channel.topic, 0)
            assert message.publish_time == message.log_time
            sequences[channel.topic] = message.sequence + 1
        (attachment,) = bag.iter_attachments()
        first, last = bag.iter_metadata()
    # the parameters stand before the first chunk
    assert summary.attachment_indexes[0].offset < summary.chunk_indexes[0].chunk_start_offset
    assert (first.name, first.metadata) == ("fpt_ros", INFO)
    assert last.name == "fpt_ros.end"
    assert last.metadata["complete"] == "true"
    assert last.metadata["messages /command"] == str(sequences["/command"])
    assert attachment.media_type == "application/yaml"


def test_attached_parameters_run_again(recorded: Recorded, tmp_path: Path) -> None:
    with recorded.file.open("rb") as stream:
        (attachment,) = make_reader(stream).iter_attachments()
    path = tmp_path / "again.yaml"
    path.write_bytes(attachment.data)
    assert experiment.load(str(path)).nodes == {
        **recorded.experiment.nodes,
        "recorder": {**recorded.experiment.about, "experiment": "again"},
    }


def test_metadata_yaml(recorded: Recorded) -> None:
    content = YAML(typ="safe").load(recorded.directory / "metadata.yaml")
    about = content["rosbag2_bagfile_information"]
    assert about["version"] == 9
    assert about["ros_distro"] == "jazzy"
    assert about["relative_file_paths"] == ["tora_0.mcap"]
    assert about["duration"] == {"nanoseconds": 999_000_000}
    assert about["message_count"] == len(recorded.frames)
    assert about["custom_data"] == {**INFO, "complete": "true", "reason": ""}
    (file,) = about["files"]
    assert file["path"] == "tora_0.mcap"
    assert file["message_count"] == len(recorded.frames)
    for topic in about["topics_with_message_count"]:
        metadata = topic["topic_metadata"]
        assert metadata["offered_qos_profiles"] == offered_qos(metadata["name"])
        assert metadata["type_description_hash"] == schema(metadata["type"]).hash
    assert sorted(path.name for path in recorded.directory.iterdir()) == [
        "metadata.yaml",
        "tora_0.mcap",
    ]


def test_qos_is_the_same_in_both_places(recorded: Recorded) -> None:
    with recorded.file.open("rb") as stream:
        summary = make_reader(stream).get_summary()
    assert summary is not None
    for channel in summary.channels.values():
        assert channel.metadata["offered_qos_profiles"] == yaml_text(offered_qos(channel.topic))


def test_hashes_are_those_of_ros() -> None:
    # from `ros2 topic info --verbose`
    expected = "RIHS01_a13ee3a330e346c9d87b5aa18d24e11690752bd33a0350f11c5882bc9179260e"
    assert schema(JOINT_STATE).hash == expected


def test_other_topics_are_volatile() -> None:
    (loop,) = offered_qos("/robot1/joint_states")
    (diagnostics,) = offered_qos("/diagnostics")
    assert (loop["durability"], loop["depth"]) == ("transient_local", 64)
    assert (diagnostics["durability"], diagnostics["depth"]) == ("volatile", 10)
    assert offered_qos("/parameter_events", 1000)[0]["depth"] == 1000
