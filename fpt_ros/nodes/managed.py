"""A node with the states of ROS 2's managed nodes, for ``ros2 lifecycle`` and lifecycle managers.

It starts itself (``autostart``), so who does not care need not know. What a node has to be built of
is read once, when it starts: it is configured with nothing left to do, and does not go back.
"""

from collections.abc import Callable
from typing import Any

from lifecycle_msgs.srv import ChangeState
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.lifecycle import LifecycleNodeMixin, LifecycleState, TransitionCallbackReturn

from fpt_ros.nodes.loop_node import LoopNode


class ManagedNode(LifecycleNodeMixin, LoopNode):
    """unconfigured, inactive, active, finalized; the process ends with the last.

    Attributes:
        active: whether it takes part in the loop.
    """

    def __init__(self, name: str) -> None:
        LoopNode.__init__(self, name)
        LifecycleNodeMixin.__init__(self)
        for service in self.services:
            if service.srv_type is ChangeState:
                service.callback = self._refusing(service.callback)
        self.active = False
        self._failure: Exception | None = None

    def _refusing(self, change: Callable[..., Any]) -> Callable[..., Any]:
        """Rclpy raises where a state has no such transition: the run would end with the node."""

        def answer(request: ChangeState.Request, response: ChangeState.Response) -> Any:
            try:
                return change(request, response)
            except rclpy_implementation.RCLError:
                asked = request.transition.label or request.transition.id
                self.ignore(f"transition {asked}, which its state does not have")
                response.success = False
                return response

        return answer

    def start_itself(self) -> None:
        """Configure and activate, as somebody else does without ``autostart``."""
        self.trigger_configure()
        self.trigger_activate()
        self._raise_failure()

    def take_up(self) -> None:
        """Called when it becomes active."""

    def lay_down(self) -> None:
        """Called when it becomes inactive."""

    def retire(self) -> None:
        """Called when it is shut down."""
        self.finished = True

    def housekeeping(self) -> None:
        """As of any node."""
        self._raise_failure()
        super().housekeeping()

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Asked by rclpy."""
        self.active = True
        return self._done(self.take_up)

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Asked by rclpy."""
        self.active = False
        return self._done(self.lay_down)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Asked by rclpy: refused."""
        self.get_logger().warning(
            "what this node is built of is read when it starts: shut it down and start another"
        )
        return TransitionCallbackReturn.FAILURE

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Asked by rclpy."""
        self.active = False
        return self._done(self.retire)

    def _done(self, change: Callable[[], None]) -> TransitionCallbackReturn:
        """Make a change; what it raises ends the node, where rclpy would swallow it."""
        try:
            change()
        except Exception as error:
            self._failure = error
            return TransitionCallbackReturn.FAILURE
        return TransitionCallbackReturn.SUCCESS

    def _raise_failure(self) -> None:
        if self._failure is not None:
            raise self._failure
