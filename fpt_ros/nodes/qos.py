"""Quality of service of the topics."""

from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

from fpt_ros.messages.topics import DEPTH

HEARD = 4096
"""Messages that may wait for a node: who floods a topic must not push those of the loop out."""

LATEST = 16
"""The same in real time, where a node acts on the newest message."""


def loop_qos(depth: int = DEPTH) -> QoSProfile:
    """Reliable and latched: who comes late, or comes back, gets the last messages."""
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=depth,
        reliability=ReliabilityPolicy.RELIABLE,
        durability=DurabilityPolicy.TRANSIENT_LOCAL,
    )


def heard_qos(realtime: bool) -> QoSProfile:
    """What a node of the loop asks for of a loop topic."""
    return loop_qos(LATEST if realtime else HEARD)


def sensor_qos(depth: int) -> QoSProfile:
    """What is asked for of a robot: whatever it offers."""
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=depth,
        reliability=ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.VOLATILE,
    )
