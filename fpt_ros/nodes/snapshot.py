"""The parameters that nodes really have, asked for over their services.

A node may have been started by hand with ``-p``, or have been changed before the recorder came:
parameter files do not say.
"""

from time import monotonic
from typing import Any

from rcl_interfaces.srv import GetParameters, GetParameterTypes, ListParameters
from rclpy.node import Node

from fpt_ros.bags.changes import value_of
from fpt_ros.parameters import Value

PATIENCE = 5.0
"""Seconds that a node has to answer; then what its parameter file says is taken."""

OF_ROS = ("use_sim_time", "start_type_description_service", "qos_overrides.")
"""Parameters, or beginnings of them, that every node has: not ours."""


class Snapshot:
    """Asks nodes for all their parameters, while their executors and ours go on.

    Attributes:
        parameters: by node, without its namespace; of those that have answered.
        problems: what to say of the others.
    """

    def __init__(self, node: Node, names: list[str]) -> None:
        """``names``: fully qualified, of the nodes to ask."""
        self.parameters: dict[str, dict[str, Value]] = {}
        self.problems: list[str] = []
        self._node = node
        self._deadline = monotonic() + PATIENCE
        self._asked = {name: _Asked(node, name) for name in names}

    def is_done(self) -> bool:
        """Go on asking; true when all have answered, or time is up."""
        for name, asked in list(self._asked.items()):
            values = asked.step()
            if values is not None:
                self.parameters[name.rpartition("/")[2]] = values
                asked.close()
                del self._asked[name]
        if self._asked and monotonic() > self._deadline:
            for name, asked in self._asked.items():
                self.problems.append(
                    f"{name} does not tell its parameters: those of its parameter file are recorded"
                )
                asked.close()
            self._asked = {}
        return not self._asked


class _Asked:
    """One node: for the names of its parameters, which of them are set, and their values."""

    def __init__(self, node: Node, name: str) -> None:
        self._node = node
        self._list = node.create_client(ListParameters, f"{name}/list_parameters")
        self._types = node.create_client(GetParameterTypes, f"{name}/get_parameter_types")
        self._get = node.create_client(GetParameters, f"{name}/get_parameters")
        self._future: Any = None
        self._names: list[str] = []

    def step(self) -> dict[str, Value] | None:
        """Go on; the values when they have come."""
        if self._future is None:
            if all(each.service_is_ready() for each in (self._list, self._types, self._get)):
                self._future = self._list.call_async(ListParameters.Request())
            return None
        if not self._future.done():
            return None
        answer = self._future.result()
        if isinstance(answer, ListParameters.Response):
            self._names = [n for n in answer.result.names if not n.startswith(OF_ROS)]
            self._future = self._types.call_async(GetParameterTypes.Request(names=self._names))
            return None
        if isinstance(answer, GetParameterTypes.Response):
            # a node does not tell any value where it is asked for one that is not set
            pairs = zip(self._names, answer.types, strict=False)
            self._names = [name for name, kind in pairs if kind in KNOWN]
            self._future = self._get.call_async(GetParameters.Request(names=self._names))
            return None
        return {
            name: value_of(value)
            for name, value in zip(self._names, answer.values, strict=False)
            if value.type in KNOWN
        }

    def close(self) -> None:
        """Ask no more."""
        for each in (self._list, self._types, self._get):
            self._node.destroy_client(each)


KNOWN = (1, 2, 3, 4, 6, 7, 8, 9)
"""Types of values that parameter files hold; 0 is one that is not set."""
