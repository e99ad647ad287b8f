"""A run that begins again: all nodes of the loop forget, each asked by a service, then the plant.

The plant asks between two cycles, when all have acted on the last one, and goes on when all have
answered: so the cycle that it publishes next is the first one for everybody.
"""

from time import monotonic
from typing import Any

from rclpy.node import Node
from std_srvs.srv import Trigger

from fpt_ros.bags import begun_again
from fpt_ros.messages.frames import SECOND
from fpt_ros.messages.topics import TUNING
from fpt_ros.nodes.kept import Kept
from fpt_ros.nodes.loop_node import message_class
from fpt_ros.nodes.qos import loop_qos
from fpt_ros.nodes.recorded_until import encode_time

BEGIN_AGAIN = "begin_again"
"""Service of each node that answers the plant: the next cycle is its first."""

FIRSTS = "firsts"
"""Kept: the cycles with which the run has begun again."""

NODES = ("denoiser", "trajectory_generator", "fpt_deformer")
TUNER = "parameter_tuner"

AGAIN = 5.0
"""Seconds after which a node that has not answered is asked again: it may have been restarted."""


class Reset:
    """Of the plant's node.

    Attributes:
        is_wanted: from the request on until all have forgotten.
        between: the plant stands between two cycles, and asks.
        first: number of the cycle with which the run has begun.
    """

    def __init__(self, node: Node, kept: Kept) -> None:
        self.is_wanted = self.between = False
        self.first = 0
        self._kept = kept
        self._node = node
        self._clients = {
            name: node.create_client(Trigger, f"{name}/{BEGIN_AGAIN}") for name in (*NODES, TUNER)
        }
        kind = message_class(begun_again.TYPE)
        self._told = node.create_publisher(kind, begun_again.TOPIC, loop_qos())
        self._left: dict[str, Any] | None = None
        self._asked = 0.0

    def go_on(self, cycle: int) -> None:
        """In the place of a plant that was killed, in this cycle; perhaps while it asked."""
        firsts = [0, *self._kept.aside.get(FIRSTS, ())]
        self.first = max(first for first in firsts if first <= cycle)
        self.is_wanted = firsts[-1] > cycle

    def ask(self, cycle: int) -> None:
        """All are to forget before this cycle."""
        if not self.between:
            self.between = True
            self._kept.aside[FIRSTS] = [*self._kept.aside.get(FIRSTS, ()), cycle]
            self._kept.save()

    def is_done(self) -> bool:
        """Ask all, at the first call; whether all have answered. Called now and then."""
        if self._left is None:
            tuned = self._node.count_publishers(TUNING.name) > 0
            self._left = dict.fromkeys((*NODES, TUNER) if tuned else NODES)
            self._asked = monotonic()
        late = monotonic() - self._asked > AGAIN
        for name, future in list(self._left.items()):
            if future is not None and future.done():
                del self._left[name]
            elif self._clients[name].service_is_ready() and (future is None or late):
                self._left[name] = self._clients[name].call_async(Trigger.Request())
        if late:
            self._asked = monotonic()
            waited_for = ", ".join(self._left)
            self._node.get_logger().warning(f"reset: no answer of {waited_for} yet")
        if self._left:
            return False
        self._left, self.is_wanted = None, False
        return True

    def tell(self, cycle: int, stamp: int) -> None:
        """Say that the run begins with a cycle, of this stamp [ns]."""
        self.first, self.between = cycle, False
        self._told.publish(encode_time(stamp))
        self._node.get_logger().info(f"the run begins again at t = {stamp / SECOND:.9g} s")
