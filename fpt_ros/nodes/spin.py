"""Waiting: the loop's subscriptions on a wait set of their own, everything else now and then.

rclpy's executors rebuild the wait set of all entities, a dozen services a node, at every wait.
Here only the loop's subscriptions are waited for, and their bytes are taken directly; parameters,
services and timers are served by an ordinary executor every few dozen milliseconds. Where rclpy's
internals have changed, the executor serves the loop too: the same callbacks, slower.
"""

from collections.abc import Callable, Sequence
from time import monotonic

from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor, TimeoutException

from fpt_ros.nodes.loop_node import LoopNode

SERVICE_PERIOD = 0.04
"""Seconds between two looks at parameters, services and timers."""

_CALLS = 2
"""Calls served at one look: a flood of them cannot stop the loop."""


class _LoopWaitSet:
    """The loop's subscriptions of all nodes of this process, on rclpy's own wait set."""

    def __init__(self, nodes: Sequence[LoopNode], context: Context) -> None:
        from rclpy.impl.implementation_singleton import rclpy_implementation

        self._entries = [
            (sub.handle.pointer, sub.handle, sub.msg_type, sub.callback)
            for node in reversed(nodes)
            for sub in node.loop_subscriptions
        ]
        self._polls = len(nodes) > 1
        self._filled = False
        self._set = rclpy_implementation.WaitSet(len(self._entries), 0, 0, 0, 0, 0, context.handle)
        self.wait_and_dispatch(0.0)

    def wait_and_dispatch(self, timeout: float) -> None:
        """Wait at most ``timeout`` [s]; hand over what has come.

        Between nodes of one process a message is there as soon as it is published: they are asked
        one after the other, in the order of the cycle, and only where nothing has come is there a
        wait.
        """
        if self._polls and self._poll():
            return
        wait_set = self._set
        if not self._filled:
            wait_set.clear_entities()
            for _, handle, _, _ in self._entries:
                wait_set.add_subscription(handle)
        wait_set.wait(max(0, int(timeout * 1e9)))
        ready = wait_set.get_ready_entities("subscription")
        self._filled = len(ready) == len(self._entries)  # the others are taken out by the wait
        for pointer, handle, kind, callback in self._entries:
            if pointer in ready:
                taken = handle.take_message(kind, True)
                if taken is not None:
                    callback(taken[0])

    def _poll(self) -> bool:
        """Hand over what is there already."""
        came = False
        for _, handle, kind, callback in self._entries:
            taken = handle.take_message(kind, True)
            if taken is not None:
                callback(taken[0])
                came = True
        return came


def spin(nodes: Sequence[LoopNode], stopped: Callable[[], bool], context: Context) -> None:
    """Run nodes until one of them has finished its work or ``stopped()``, asked now and then."""
    executor = SingleThreadedExecutor(context=context)
    for node in nodes:
        executor.add_node(node)
    hot = _hot_path(nodes, context)
    for node in nodes:
        node.begin()
    next_service = monotonic()
    try:
        while True:
            now = monotonic()
            if now >= next_service:
                if stopped():
                    return
                _serve(executor, nodes)
                now = monotonic()
                next_service = now + SERVICE_PERIOD
            timeout = next_service - now
            for node in nodes:
                if node.deadline is not None:
                    timeout = min(timeout, node.deadline - now)
            if hot is not None:
                hot.wait_and_dispatch(timeout)
            else:
                executor.spin_once(timeout_sec=max(timeout, 0.0))
            for node in nodes:
                if node.deadline is not None and monotonic() >= node.deadline:
                    node.on_deadline()
                if node.finished:
                    return
    finally:
        executor.shutdown(timeout_sec=0.0)


def _hot_path(nodes: Sequence[LoopNode], context: Context) -> _LoopWaitSet | None:
    if not any(node.loop_subscriptions for node in nodes):
        return None
    try:
        return _LoopWaitSet(nodes, context)
    except (AttributeError, TypeError, ImportError) as error:
        nodes[0].get_logger().warning(
            f"this rclpy has no wait set of the kind known here ({error}): "
            "the loop runs on the plain executor, several times slower"
        )
        return None


def _serve(executor: SingleThreadedExecutor, nodes: Sequence[LoopNode]) -> None:
    for _ in range(_CALLS):
        try:
            handler, _, _ = executor.wait_for_ready_callbacks(timeout_sec=0.0)
        except TimeoutException:
            break  # mostly nobody calls: one look is what it costs
        handler()
        error = handler.exception()
        if error is not None:
            raise error
    for node in nodes:
        node.housekeeping()
