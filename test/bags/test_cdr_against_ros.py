"""Our bytes are ROS's: rclpy reads what Codec writes, and the other way round."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fpt_ros.messages.cdr import Codec
from fpt_ros.messages.frames import SECOND, Frame
from fpt_ros.messages.topics import JOINT_TRAJECTORY, LOOP_TOPICS, Topic

serialization = pytest.importorskip("rclpy.serialization")
sensor_msgs = pytest.importorskip("sensor_msgs.msg")
trajectory_msgs = pytest.importorskip("trajectory_msgs.msg")

NAMES = st.text(st.characters(codec="utf-8", exclude_characters="\0"), max_size=12)
NUMBERS = st.floats(width=64)


@st.composite
def frames(draw: st.DrawFn, topic: Topic) -> Frame:
    names = tuple(draw(st.lists(NAMES, max_size=5)))
    stamp = draw(st.integers(0, 2**31 * SECOND - 1))
    vector = st.lists(NUMBERS, min_size=len(names), max_size=len(names)).map(tuple)
    return topic.frame(stamp, names, *(draw(vector) for _ in topic.vectors))


def message_type(topic: Topic) -> Any:
    trajectory = topic.type == JOINT_TRAJECTORY
    return trajectory_msgs.JointTrajectory if trajectory else sensor_msgs.JointState


def to_message(topic: Topic, frame: Frame) -> Any:
    message = message_type(topic)()
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(frame.stamp, SECOND)
    target = message
    if topic.type == JOINT_TRAJECTORY:
        message.joint_names = list(frame.names)
        target = trajectory_msgs.JointTrajectoryPoint()
        message.points = [target]
    else:
        message.name = list(frame.names)
    for field, vector in zip(topic.fields, frame[2:], strict=True):
        setattr(target, field, list(vector))
    return message


def bits(vector: Any) -> bytes:
    return np.asarray(vector, dtype=np.float64).tobytes()


def assert_same(topic: Topic, message: Any, frame: Frame) -> None:
    stamp = message.header.stamp
    assert stamp.sec * SECOND + stamp.nanosec == frame.stamp
    source, names = message, getattr(message, "name", None)
    if topic.type == JOINT_TRAJECTORY:
        (source,), names = message.points, message.joint_names
    assert tuple(names) == frame.names
    for field, vector in zip(topic.fields, frame[2:], strict=True):
        assert bits(getattr(source, field)) == bits(vector)


TOPICS = pytest.mark.parametrize("topic", LOOP_TOPICS, ids=lambda topic: topic.name)


@TOPICS
@settings(deadline=None, max_examples=100)
@given(data=st.data())
def test_ros_reads_what_the_codec_writes(topic: Topic, data: st.DataObject) -> None:
    codec = Codec(topic)
    for frame in data.draw(st.lists(frames(topic), min_size=1, max_size=3)):
        message = serialization.deserialize_message(codec.encode(frame), message_type(topic))
        assert_same(topic, message, frame)


@TOPICS
@settings(deadline=None, max_examples=100)
@given(data=st.data())
def test_the_codec_reads_what_ros_writes(topic: Topic, data: st.DataObject) -> None:
    codec = Codec(topic)
    for frame in data.draw(st.lists(frames(topic), min_size=1, max_size=3)):
        decoded = codec.decode(serialization.serialize_message(to_message(topic, frame)))
        assert (decoded.stamp, decoded.names) == (frame.stamp, frame.names)
        assert [bits(v) for v in decoded[2:]] == [bits(v) for v in frame[2:]]


@TOPICS
def test_typical_cycle_with_nan(topic: Topic) -> None:
    vectors = ((float("nan"), -0.0, 5e-324) for _ in topic.vectors)
    frame = topic.frame(1_234_567_890_123_456_789, ("q1", "θ₂", ""), *vectors)
    encoded = Codec(topic).encode(frame)
    assert_same(topic, serialization.deserialize_message(encoded, message_type(topic)), frame)
