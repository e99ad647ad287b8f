"""Hearing all graphs of a ROS domain, whoever started them; they never wait for it."""

import threading
from collections import deque
from time import monotonic
from typing import NamedTuple

import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from rcl_interfaces.msg import ParameterEvent
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.subscription import Subscription
from std_msgs.msg import UInt8MultiArray

from fpt_ros.bags.changes import value_of
from fpt_ros.cycle.stages import STAGES
from fpt_ros.messages.frames import SECOND
from fpt_ros.messages.topics import Topic
from fpt_ros.nodes import middleware
from fpt_ros.nodes.loop_node import LoopGroup
from fpt_ros.nodes.recent import RECENT, recent_qos, unpack
from fpt_ros.nodes.stage_node import CHANGES
from fpt_ros.parameters import Value

PERIOD = 0.04
"""Seconds between two looks at what has come."""

DISCOVERY = 1.0
"""Seconds between two looks at which graphs there are."""

EVENTS = 2000
"""What has come and was not fetched; the oldest is dropped."""

_TRIGGER = "std_srvs/srv/Trigger"


class Piece(NamedTuple):
    """Serialised messages of one loop topic, one after the other."""

    namespace: str
    topic: Topic
    messages: list[bytes]


class Health(NamedTuple):
    """What a node says on /diagnostics; ``level``: 0 OK, 1 warning, 2 error, 3 stale."""

    namespace: str
    node: str
    level: int
    summary: str
    values: dict[str, str]


class Changed(NamedTuple):
    """Parameters that have taken effect, in the cycle of a stamp [ns]."""

    namespace: str
    node: str
    stamp: int
    values: dict[str, Value]


class Found(NamedTuple):
    """By namespace the nodes of its loop and, as ``NODE/SERVICE``, what can be triggered there."""

    nodes: dict[str, frozenset[str]]
    triggers: dict[str, frozenset[str]]


Event = Piece | Health | Changed | Found


class Listener:
    """One node that hears everything.

    Attributes:
        context: for others who want to talk to the graphs.
    """

    def __init__(self) -> None:
        middleware.configure()
        self.context = Context()
        rclpy.init(context=self.context, args=[])
        self._node = rclpy.create_node("fpt_watch", context=self.context)
        self._events: deque[Event] = deque(maxlen=EVENTS)
        self._group = LoopGroup()  # its messages are fetched, they wake nobody
        self._loops: dict[str, Subscription] = {}
        self._node.create_subscription(DiagnosticArray, "/diagnostics", self._on_health, 100)
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._listen, name="listener", daemon=True)
        self._thread.start()

    def events(self) -> list[Event]:
        """What has come since the last call."""
        found = []
        while self._events:
            found.append(self._events.popleft())
        return found

    def close(self) -> None:
        """Hear no more."""
        self._ended.set()
        self._thread.join()
        self._node.destroy_node()
        self.context.try_shutdown()

    def _listen(self) -> None:
        executor = SingleThreadedExecutor(context=self.context)
        executor.add_node(self._node)
        due = 0.0
        try:
            while not self._ended.wait(PERIOD / 4):
                if monotonic() >= due:
                    due = monotonic() + DISCOVERY
                    self._look_around()
                executor.spin_once(timeout_sec=PERIOD)
                for namespace, subscription in self._loops.items():
                    self._take(namespace, subscription)
        except (ExternalShutdownException, rclpy_implementation.RCLError):
            pass  # the context has gone
        finally:
            executor.shutdown(timeout_sec=0.0)

    def _look_around(self) -> None:
        nodes: dict[str, set[str]] = {}
        triggers: dict[str, set[str]] = {}
        for name, types in self._node.get_service_names_and_types():
            path, _, service = name.rpartition("/")
            namespace, _, node = path.rpartition("/")
            if node not in STAGES:
                continue
            if service == "set_parameters":
                nodes.setdefault(namespace or "/", set()).add(node)
            elif _TRIGGER in types:
                triggers.setdefault(namespace or "/", set()).add(f"{node}/{service}")
        for namespace in nodes:
            if namespace not in self._loops:
                self._join(namespace)
        self._events.append(
            Found(
                {name: frozenset(found) for name, found in nodes.items()},
                {name: frozenset(found) for name, found in triggers.items()},
            )
        )

    def _join(self, namespace: str) -> None:
        def on_change(event: ParameterEvent) -> None:
            values = {each.name: value_of(each.value) for each in event.changed_parameters}
            node, stamp = event.node.rpartition("/")[2], event.stamp
            at = stamp.sec * SECOND + stamp.nanosec
            self._events.append(Changed(namespace, node, at, values))

        where = namespace.rstrip("/")
        # reliable: they are rare, and none may be missed; a node does not wait for them
        self._node.create_subscription(ParameterEvent, f"{where}/{CHANGES}", on_change, 100)
        self._loops[namespace] = self._node.create_subscription(
            UInt8MultiArray,
            f"{where}/{RECENT}",
            lambda message: None,
            recent_qos(),
            callback_group=self._group,
        )

    def _take(self, namespace: str, subscription: Subscription) -> None:
        while True:
            with subscription.handle:
                taken = subscription.handle.take_message(UInt8MultiArray, False)
            if taken is None:
                return
            piece = unpack(taken[0])
            if piece is not None:
                self._events.append(Piece(namespace, *piece))

    def _on_health(self, array: DiagnosticArray) -> None:
        for status in array.status:
            namespace, _, node = f"/{status.name}".rpartition("/")
            values = {pair.key: pair.value for pair in status.values}
            level = int.from_bytes(status.level) if isinstance(status.level, bytes) else 0
            self._events.append(Health(namespace or "/", node, level, status.message, values))
