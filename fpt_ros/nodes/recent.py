"""What a node said last, some dozen times a second and in one piece, while somebody watches.

A reader of the loop's own topics costs the loop a third of its pace, wherever it is and whatever it
asks for: each message has to be written into its memory and wakes its threads. What is told here
costs a message every 40 ms, and nothing where nobody listens.
"""

import struct
from array import array
from collections import deque
from collections.abc import Iterator
from itertools import islice
from time import monotonic

from rclpy.node import Node
from rclpy.qos import QoSProfile
from std_msgs.msg import MultiArrayDimension, UInt8MultiArray

from fpt_ros.messages.topics import BY_NAME, Topic
from fpt_ros.nodes.qos import sensor_qos

RECENT = "recent_cycles"
"""Topic on which all nodes of a loop tell their last messages: for each its length, its bytes."""

KEPT = 512
"""Messages that a node remembers."""

AGAIN = 1.0
"""Seconds after which a loop that stands still tells them again, for who has come since."""

_LENGTH = struct.Struct("<I")


def recent_qos() -> QoSProfile:
    """Nobody waits for who watches."""
    return sensor_qos(64)


class Recent:
    """The last messages of a node's output."""

    def __init__(self, node: Node, topic: Topic) -> None:
        self._kept: deque[bytes] = deque(maxlen=KEPT)
        self.add = self._kept.append
        self._topic = topic
        self._publisher = node.create_publisher(UInt8MultiArray, RECENT, recent_qos())
        self._told, self._told_at = 0, 0.0

    def tell(self, count: int) -> None:
        """Say what is new if anybody listens; ``count``: of the messages so far."""
        if not self._kept or not self._publisher.get_subscription_count():
            return
        now, new = monotonic(), count - self._told
        if new or now - self._told_at > AGAIN:
            start = max(0, len(self._kept) - new) if new else 0
            self._publisher.publish(pack(self._topic, list(islice(self._kept, start, None))))
            self._told, self._told_at = count, now


def pack(topic: Topic, messages: list[bytes]) -> UInt8MultiArray:
    """Serialised messages of a topic as one."""
    data = b"".join([part for each in messages for part in (_LENGTH.pack(len(each)), each)])
    piece = UInt8MultiArray(data=array("B", data))
    piece.layout.dim = [MultiArrayDimension(label=topic.name, size=len(messages))]
    return piece


def unpack(piece: UInt8MultiArray) -> tuple[Topic, list[bytes]] | None:
    """What :func:`pack` was given; ``None``: it is something else."""
    topic = BY_NAME.get(piece.layout.dim[0].label) if piece.layout.dim else None
    messages = list(_split(bytes(piece.data)))
    return (topic, messages) if topic is not None and messages else None


def _split(data: bytes) -> Iterator[bytes]:
    at = 0
    while at + _LENGTH.size <= len(data):
        (length,) = _LENGTH.unpack_from(data, at)
        at += _LENGTH.size + length
        if at > len(data):
            return
        yield data[at - length : at]
