"""Quality of service of the topics."""

from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

from fpt_ros.messages.topics import DEPTH


def loop_qos(depth: int = DEPTH) -> QoSProfile:
    """Reliable and latched: who comes late, or comes back, gets the last messages."""
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=depth,
        reliability=ReliabilityPolicy.RELIABLE,
        durability=DurabilityPolicy.TRANSIENT_LOCAL,
    )


LATEST = 4
"""History of a stage's subscription: it acts on the newest message."""
