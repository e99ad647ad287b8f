"""All graphs of the ROS domain: what they tell is heard, what they are asked they answer."""

import asyncio
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import Any, TypeVar

from fpt_ros.errors import FptError
from fpt_ros.nodes.asking import Graph
from fpt_ros.nodes.listening import Found, Listener
from fpt_ros.parameters import Value
from fpt_ros.watch.robot import DEFORMER, PLANT, Robot, State

PATIENCE = 10.0
"""Seconds that a node has to answer."""

Answer = TypeVar("Answer")


class _Line:
    """Talks to one graph, one question after the other, in a thread of its own."""

    def __init__(self, listener: Listener) -> None:
        self._thread = ThreadPoolExecutor(max_workers=1, thread_name_prefix="asking")
        self._listener = listener
        self._graph: Graph | None = None

    async def ask(self, question: Callable[[Graph], Answer]) -> Answer:
        """What a question gives."""
        return await asyncio.get_running_loop().run_in_executor(self._thread, self._ask, question)

    def _ask(self, question: Callable[[Graph], Answer]) -> Answer:
        if self._graph is None:
            self._graph = Graph(self._listener.context, "", PATIENCE)
        return question(self._graph)

    def close(self) -> None:
        """Ask no more."""
        self._thread.shutdown(wait=True, cancel_futures=True)
        if self._graph is not None:
            self._graph.close()


class Robots:
    """The graphs that were found.

    Attributes:
        known: by namespace, in the order in which they were met.
    """

    def __init__(self) -> None:
        self.known: dict[str, Robot] = {}
        self._listener = Listener()
        self._lines: dict[str, _Line] = {}
        self._asked: set[str] = set()
        self._tasks: set[asyncio.Task[None]] = set()

    def poll(self) -> None:
        """Take what has come."""
        for event in self._listener.events():
            if isinstance(event, Found):
                for namespace in event.nodes:
                    self.known.setdefault(namespace, Robot(namespace))
                for namespace, robot in self.known.items():
                    nodes = event.nodes.get(namespace, frozenset())
                    robot.nodes, robot.is_settled = nodes, nodes == robot.nodes
                    robot.described = robot.described if nodes else None
                    robot.triggers = event.triggers.get(namespace, frozenset())
            elif event.namespace in self.known:
                self.known[event.namespace].take(event)
        for robot in self.known.values():
            state = robot.nodes, robot.heard.runs
            known = robot.described == state or robot.namespace in self._asked
            if robot.nodes and robot.is_settled and not known:
                self._asked.add(robot.namespace)
                task = asyncio.ensure_future(self._describe(robot, state))
                self._tasks.add(task)
                task.add_done_callback(self._tasks.discard)

    async def set(self, robot: Robot, node: str, changes: Mapping[str, Value]) -> str:
        """Change parameters of a node; why they are refused, empty if they are not."""
        try:
            await self._line(robot.namespace).ask(
                lambda graph: graph.set(_full(robot, node), changes)
            )
        except FptError as error:
            return str(error)
        robot.know(node, changes)
        return ""

    async def trigger(self, robot: Robot, service: str) -> tuple[bool, str]:
        """Call ``NODE/SERVICE``; whether it was done, and what it answers."""
        urgent = service.startswith(f"{DEFORMER}/")
        line = self._line("urgent" if urgent else robot.namespace)
        try:
            return True, await line.ask(lambda graph: graph.trigger(_full(robot, service)))
        except FptError as error:
            return False, str(error)

    async def step(self, robot: Robot, cycles: int) -> tuple[bool, str]:
        """Go on for some cycles."""
        refused = await self.set(robot, PLANT, {"step_cycles": cycles})
        return (False, refused) if refused else await self.trigger(robot, f"{PLANT}/step")

    def close(self) -> None:
        """Hear and ask no more."""
        for task in self._tasks:
            task.cancel()
        for line in self._lines.values():
            line.close()
        self._listener.close()

    def _line(self, namespace: str) -> _Line:
        if namespace not in self._lines:
            self._lines[namespace] = _Line(self._listener)
        return self._lines[namespace]

    async def _describe(self, robot: Robot, state: State) -> None:
        nodes = [_full(robot, node) for node in sorted(state[0], key=_order)]

        def prepare(graph: Graph) -> None:
            for node in nodes:
                graph.prepare(node)

        def question(node: str) -> Callable[[Graph], tuple[list[Any], dict[str, Value]]]:
            return lambda graph: (graph.describe(node, graph.names(node)), graph.values(node))

        line, found = self._line(robot.namespace), {}
        robot.will_be_described()
        try:
            await line.ask(prepare)
            for node in nodes:
                found[node.rpartition("/")[2]] = await line.ask(question(node))
        except FptError:
            await asyncio.sleep(1.0)  # it has gone, or is busy: the next poll asks again
        else:
            robot.describe(state, found)
        finally:
            self._asked.discard(robot.namespace)


def _full(robot: Robot, name: str) -> str:
    return f"{robot.namespace.rstrip('/')}/{name}"


def _order(node: str) -> tuple[bool, str]:
    """The deformer, which has the gain, first."""
    return node != DEFORMER, node
