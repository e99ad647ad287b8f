"""Somebody who publishes on the loop's topics and has no business there, and what he says."""

import math
import random
from contextlib import contextmanager

import rclpy
from rclpy.context import Context

from fpt_ros.messages.cdr import Codec
from fpt_ros.messages.topics import LOOP_TOPICS
from fpt_ros.nodes.loop_node import message_class
from fpt_ros.nodes.qos import loop_qos

PATIENCE = 60.0
JOINTS = ("q1", "q2", "q3")
NUMBERS = {"nan": math.nan, "infinite": math.inf, "huge": 1e300, "plain": 0.25}


def frame(topic, stamp, names=JOINTS, value=0.25, length=None):
    count = len(names) if length is None else length
    return topic.frame(stamp, names, *[[value] * count for _ in topic.vectors])


def kinds(topic, stamp, seed=1):
    """Messages of all kinds for one topic, by name; ``stamp`` [ns] is one that might be due."""
    encode, chance = Codec(topic).encode, random.Random(seed)
    found = {name: encode(frame(topic, stamp, value=x)) for name, x in NUMBERS.items()}
    found["short"] = encode(frame(topic, stamp, length=1))
    found["long"] = encode(frame(topic, stamp, length=7))
    found["without numbers"] = encode(frame(topic, stamp, length=0))
    found["empty"] = encode(frame(topic, stamp, names=()))
    found["unknown joint"] = encode(frame(topic, stamp, names=("wheel", "gripper", "q9")))
    found["named twice"] = encode(frame(topic, stamp, names=("q1", "q1", "q3")))
    found["far future"] = encode(frame(topic, 2_100_000_000 * 10**9))
    found["far past"] = encode(frame(topic, 0))
    found["before all"] = encode(frame(topic, -5 * 10**9))
    for size in (4, 5, 12, 60, 2000):
        found[f"{size} bytes"] = bytes([0, 1, 0, 0]) + chance.randbytes(size - 4)
    whole = encode(frame(topic, stamp))
    found["cut"] = whole[: len(whole) // 2]
    found["other endianness"] = bytes([0, 0]) + whole[2:]
    return found


class Stranger:
    """Publishers of all loop topics, as reliable and latched as the right ones."""

    def __init__(self, context, topics=LOOP_TOPICS):
        self.node = rclpy.create_node("stranger", context=context)
        self.publishers = {
            topic: self.node.create_publisher(message_class(topic.type), topic.name, loop_qos())
            for topic in topics
        }

    def match(self, topics):
        """Wait until those topics are listened to."""
        clock = self.node.get_clock()
        deadline = clock.now().nanoseconds + PATIENCE * 1e9
        while not all(self.publishers[topic].get_subscription_count() for topic in topics):
            clock.sleep_for(rclpy.duration.Duration(seconds=0.02), self.node.context)
            assert clock.now().nanoseconds < deadline, "nobody listens"

    def say(self, topic, data):
        self.publishers[topic].publish(data)


@contextmanager
def stranger(topics=LOOP_TOPICS):
    context = Context()
    rclpy.init(context=context)
    somebody = Stranger(context, topics)
    try:
        yield somebody
    finally:
        somebody.node.destroy_node()
        context.try_shutdown()
