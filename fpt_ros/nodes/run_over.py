"""The plant's node says that the run is over: nodes of other hosts end with it.

On one host ``fpt run`` sees processes end. It does not see those of another host, and a node that
has gone from the graph may be behind a cut cable: so the end is a message, which waits, latched,
until it has been heard.
"""

from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.publisher import Publisher
from std_msgs.msg import String

from fpt_ros.cycle.stage import ENDS_WITH_PLANT
from fpt_ros.errors import RunFailed
from fpt_ros.nodes.loop_node import LoopNode
from fpt_ros.nodes.qos import loop_qos
from fpt_ros.parameters import Values

RUN_OVER = "run_over"
"""Topic, std_msgs/String: why it ended, empty where it is complete."""

HEARD = Duration(seconds=1)
"""How long the end of the process waits for those who listen."""


def announcer(node: Node) -> Publisher:
    """What the plant's node says it with."""
    return node.create_publisher(String, RUN_OVER, loop_qos(1))


def announce(publisher: Publisher, reason: str) -> None:
    """Say it, and wait until it is heard."""
    publisher.publish(String(data=reason))
    publisher.wait_for_all_acked(HEARD)


def end_with_plant(node: LoopNode, values: Values) -> None:
    """Let a node end when the plant's node says so, if its parameters ask for it.

    It is a failure if that was one.
    """
    if values.get(ENDS_WITH_PLANT.name) is not True:
        return

    def on_over(message: String) -> None:
        if message.data:
            raise RunFailed(f"the plant's node has ended: {message.data}")
        node.finished = True

    node.create_subscription(String, RUN_OVER, on_over, loop_qos(1))
