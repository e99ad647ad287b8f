"""Somebody who publishes on the loop's topics and has no business there, and what he says."""

from contextlib import contextmanager

import rclpy
from rclpy.context import Context
from rclpy.duration import Duration

from fpt_ros.messages import wild
from fpt_ros.messages.topics import LOOP_TOPICS
from fpt_ros.nodes.loop_node import message_class
from fpt_ros.nodes.qos import loop_qos

PATIENCE = 60.0
JOINTS = ("q1", "q2", "q3")


def frame(topic, stamp):
    return wild.frame(topic, stamp, JOINTS)


def kinds(topic, stamp, seed=1):
    """Messages of all kinds for one topic, by name; ``stamp`` [ns] is one that might be due."""
    return wild.kinds(topic, stamp, JOINTS, seed)


class Stranger:
    """Publishers of all loop topics, as reliable and latched as the right ones."""

    def __init__(self, context, topics=LOOP_TOPICS):
        self.node = rclpy.create_node("stranger", context=context)
        self.publishers = {
            topic: self.node.create_publisher(message_class(topic.type), topic.name, loop_qos())
            for topic in topics
        }

    def match(self, listeners):
        """Wait until each topic has so many listeners."""
        clock = self.node.get_clock()
        deadline = clock.now().nanoseconds + PATIENCE * 1e9
        while any(self.publishers[t].get_subscription_count() < n for t, n in listeners.items()):
            clock.sleep_for(Duration(seconds=0.02), self.node.context)
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
        for publisher in somebody.publishers.values():
            publisher.wait_for_all_acked(Duration(seconds=PATIENCE))
    finally:
        somebody.node.destroy_node()
        context.try_shutdown()
