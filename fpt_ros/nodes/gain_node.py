"""What a deformer's node says of a gain that is set in flight: to who sets it, and to all."""

from collections.abc import Callable

from rcl_interfaces.msg import ParameterEvent
from rclpy.node import Node

from fpt_ros.cycle.fpt_deformer import FptDeformer
from fpt_ros.errors import BadInput
from fpt_ros.gain.in_flight import GainInFlight
from fpt_ros.nodes.qos import loop_qos
from fpt_ros.parameters import flag


class GainNode:
    """Judges changes of the gain's parameters, and listens to changes of all that it rests on.

    Attributes:
        warning: what is to be said of the gain in force; empty: nothing.
        remark: the same of the change asked for last.
    """

    def __init__(self, node: Node, stage: FptDeformer, topic: str) -> None:
        """``topic``: of the changes that have taken effect."""
        self._gain = GainInFlight(stage)
        self._tell: Callable[[str], object] = node.get_logger().warning
        self.remark = ""
        self.warning = "" if self._gain.unknown else self._gain.judge(stage)
        # latched: a node that is started again hears what was changed before
        node.create_subscription(ParameterEvent, topic, self._on_changes, loop_qos(100))

    def consider(self, tried: FptDeformer, names: set[str]) -> None:
        """Before a change of these parameters is accepted; ``tried``: the stage that it makes.

        Raises:
            BadInput: ``strict_gain``, and it is not known that this gain contracts.
        """
        self.remark = ""
        self._gain.forget(FptDeformer.name, names)
        if not self._gain.concerns(names):
            return
        text = self._gain.judge(tried)
        if text and flag(tried.values, "strict_gain"):
            raise BadInput(f"strict_gain: {text}")
        self.warning = self.remark = text
        if text:
            self._tell(text)

    def _on_changes(self, event: ParameterEvent) -> None:
        node = event.node.rpartition("/")[2]
        self._gain.forget(node, {each.name for each in event.changed_parameters})
