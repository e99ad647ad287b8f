"""Waiting: the loop's subscriptions on a wait set of their own, everything else now and then.

rclpy's executors rebuild the wait set of all entities, a dozen services a node, at every wait.
Here only the loop's subscriptions are waited for, and their bytes are taken directly; parameters,
services and timers are served by an ordinary executor every few dozen milliseconds. Where rclpy's
internals have changed, the executor serves the loop too: the same callbacks, slower.
"""

from collections.abc import Callable, Sequence
from itertools import cycle
from time import monotonic

from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor, TimeoutException

from fpt_ros.nodes.loop_node import LoopNode
from fpt_ros.nodes.qos import HEARD
from fpt_ros.nodes.take import taker

SERVICE_PERIOD = 0.04
"""Seconds between two looks at the parameters, services and timers of a node."""

GRACE = 0.008
"""Seconds by which such a look may come later, so that it does not delay a message of the loop."""

SOON = 0.002
"""The same where more is expected and there is no loop yet that it could delay."""

_CALLS = 2
"""Calls served at one look: a flood of them cannot stop the loop."""


class _LoopWaitSet:
    """The loop's subscriptions of all nodes of this process, on rclpy's own wait set."""

    def __init__(self, nodes: Sequence[LoopNode], context: Context) -> None:
        from rclpy.impl.implementation_singleton import rclpy_implementation

        self._entries = [
            (sub.handle.pointer, sub.handle, taker(sub), sub.callback)
            for node in reversed(nodes)
            for sub in node.loop_subscriptions
        ]
        self._polls = len(nodes) > 1
        self.patience = 0.0 if self._polls else GRACE
        self._filled = False
        self._set = rclpy_implementation.WaitSet(len(self._entries), 0, 0, 0, 0, 0, context.handle)
        self.wait_and_dispatch(0.0)

    def wait_and_dispatch(self, timeout: float) -> bool:
        """Wait at most ``timeout`` [s]; hand over what has come. True: nothing will come soon.

        Between nodes of one process a message is there as soon as it is published: they are asked
        one after the other, in the order of the cycle, and only where nothing has come is there a
        wait. A node by itself has done its part of the cycle when it has had its messages.
        """
        if self._polls and self._poll():
            return False
        wait_set = self._set
        if not self._filled:
            wait_set.clear_entities()
            for _, handle, _, _ in self._entries:
                wait_set.add_subscription(handle)
        wait_set.wait(max(0, int(timeout * 1e9)))
        ready = wait_set.get_ready_entities("subscription")
        self._filled = len(ready) == len(self._entries)  # the others are taken out by the wait
        for pointer, _, take, callback in self._entries:
            if pointer in ready:
                for _ in range(HEARD):
                    taken = take()
                    if taken is None:
                        break
                    callback(*taken)
        return bool(ready) != self._polls

    def _poll(self) -> bool:
        """Hand over what is there already."""
        came = False
        for _, _, take, callback in self._entries:
            for _ in range(HEARD):
                taken = take()
                if taken is None:
                    break
                callback(*taken)
                came = True
        return came


class _Services:
    """Parameters, services and timers, one node after the other: a look at all takes too long."""

    def __init__(self, served: Sequence[tuple[SingleThreadedExecutor, LoopNode]]) -> None:
        self._served = served
        self._next = 0
        self._due = monotonic()

    def timeout(self, now: float, patience: float) -> float:
        """How long to wait for messages of the loop [s]; ``patience``: where a look is due."""
        left = self._due - now
        return left if left > 0.0 else max(0.0, left + patience / len(self._served))

    def is_due(self, now: float, quiet: bool) -> bool:
        """Whether to look now; ``quiet``: it would not delay the loop."""
        return now >= self._due and (quiet or now >= self._due + GRACE / len(self._served))

    def serve(self) -> None:
        """Look at the next node."""
        executor, node = self._served[self._next]
        self._next = (self._next + 1) % len(self._served)
        called = False
        for _ in range(_CALLS):
            try:
                handler, _, _ = executor.wait_for_ready_callbacks(timeout_sec=0.0)
            except TimeoutException:
                break  # mostly nobody calls: one look is what it costs
            handler()
            called = True
            error = handler.exception()
            if isinstance(error, ValueError):  # rclpy's, of a parameter of a type that there is not
                node.ignore(f"a call that cannot be read: {error}")
            elif error is not None:
                raise error
        node.housekeeping()
        expecting = (called or node.awaits_answers) and not node.cycles_done
        self._due = monotonic() + (SOON if expecting else SERVICE_PERIOD) / len(self._served)


def spin(nodes: Sequence[LoopNode], stopped: Callable[[], bool], context: Context) -> None:
    """Run nodes until one of them has finished its work or ``stopped()``, asked now and then."""
    wait_set = _wait_set(nodes, context)
    count = 1 if wait_set is None else len(nodes)
    executors = [SingleThreadedExecutor(context=context) for _ in range(count)]
    served = list(zip(cycle(executors), nodes, strict=False))
    for executor, node in served:
        executor.add_node(node)
    hot = wait_set or _PlainExecutor(executors[0], nodes)
    services = _Services(served)
    for node in nodes:
        node.begin()
    quiet = True
    try:
        while True:
            now = monotonic()
            if services.is_due(now, quiet):
                if stopped():
                    return
                services.serve()
                now = monotonic()
            timeout = services.timeout(now, hot.patience)
            for node in nodes:
                if node.deadline is not None:
                    timeout = min(timeout, max(0.0, node.deadline - now))
            quiet = hot.wait_and_dispatch(timeout)
            for node in nodes:
                if quiet:
                    node.nap()
                if node.newest_counts:
                    node.act()
                if node.deadline is not None and monotonic() >= node.deadline:
                    node.on_deadline()
                if node.finished:
                    return
    finally:
        for executor in executors:
            executor.shutdown(timeout_sec=0.0)


class _PlainExecutor:
    """In the place of the wait set: rclpy's executor serves the loop as it does all else."""

    patience = 0.0

    def __init__(self, executor: SingleThreadedExecutor, nodes: Sequence[LoopNode]) -> None:
        self._executor = executor
        for node in nodes:
            node.loop_group.is_open = True

    def wait_and_dispatch(self, timeout: float) -> bool:
        """As of the wait set; what it does not know is when the loop is quiet."""
        self._executor.spin_once(timeout_sec=timeout)
        return True


def _wait_set(nodes: Sequence[LoopNode], context: Context) -> _LoopWaitSet | None:
    """``None``: there is nothing to wait for, or rclpy has no such thing."""
    if not any(node.loop_subscriptions for node in nodes):
        return None
    try:
        return _LoopWaitSet(nodes, context)
    except (AttributeError, TypeError, ImportError, OSError) as error:
        nodes[0].get_logger().warning(
            f"this rclpy has no wait set of the kind known here ({error}): "
            "the loop runs on the plain executor, several times slower"
        )
        return None
