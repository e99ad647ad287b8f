"""Talking to the nodes of a running graph over their standard services."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from time import monotonic
from typing import Any

import rclpy
from rcl_interfaces.msg import ParameterEvent
from rcl_interfaces.srv import (
    DescribeParameters,
    GetParameters,
    GetParameterTypes,
    ListParameters,
    SetParametersAtomically,
)
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter as RosParameter
from std_srvs.srv import Trigger

from fpt_ros.bags.changes import value_of
from fpt_ros.cycle.plant_simulator import PlantSimulator
from fpt_ros.cycle.stages import STAGES
from fpt_ros.errors import BadInput, RunFailed
from fpt_ros.messages.topics import JOINT_STATES
from fpt_ros.nodes import doctor, middleware
from fpt_ros.nodes.namespace import check
from fpt_ros.nodes.snapshot import KNOWN, OF_ROS
from fpt_ros.nodes.stage_node import CHANGES
from fpt_ros.parameters import Value

WHERE = "ROS_DOMAIN_ID (--namespace?)"

FURTHER = 10.0
"""Seconds from the first node to the others; from all of these to one that is not of the loop."""

NAME_TO_COME = "_NODE_NAME_UNKNOWN_"
"""What DDS calls a node whose endpoints are found before its name is."""

PATIENCE = 30.0
"""Seconds that a node may take to be found, and to answer."""

PARAMETER_SERVICES = (
    (ListParameters, "list_parameters"),
    (DescribeParameters, "describe_parameters"),
    (GetParameterTypes, "get_parameter_types"),
    (GetParameters, "get_parameters"),
    (SetParametersAtomically, "set_parameters_atomically"),
)
"""Of every node."""


class Graph:
    """The nodes of one namespace, as somebody outside sees them."""

    def __init__(self, context: Context, namespace: str, patience: float = PATIENCE) -> None:
        self._patience = patience
        self._clients: dict[str, Any] = {}
        self._node = rclpy.create_node(
            "fpt", namespace=namespace or None, context=context, enable_rosout=False
        )
        self._executor = SingleThreadedExecutor(context=context)
        self._executor.add_node(self._node)

    def close(self) -> None:
        """Be gone."""
        self._executor.shutdown(timeout_sec=0.0)
        self._node.destroy_node()

    def call(self, kind: Any, name: str, request: Any) -> Any:
        """The answer of a service.

        Args:
            kind: of the service.
            name: ``NODE/SERVICE``, or the same with its namespace.
            request: of that kind.

        Raises:
            BadInput: the graph is whole, and no such node is part of it.
            RunFailed: nobody offers it, or nobody answers.
        """
        client, resolved = self._client(kind, name), self._node.resolve_service_name(name)
        deadline, whole = monotonic() + self._patience, 0.0
        while not client.service_is_ready():
            self._executor.spin_once(timeout_sec=0.02)
            here = self._here()
            if self._is_whole(here):
                whole = whole or monotonic()
                if monotonic() > whole + FURTHER:
                    node, _, service = resolved.rpartition("/")
                    raise BadInput(f"no node {node} offers {service}; there are {', '.join(here)}")
            if monotonic() > deadline:
                raise RunFailed(
                    f"nobody offers {resolved}: is the graph running, in this ROS_DOMAIN_ID and "
                    "--namespace?"
                )
        future = client.call_async(request)
        self._executor.spin_until_future_complete(future, timeout_sec=self._patience)
        if not future.done():
            client.remove_pending_request(future)
            raise RunFailed(f"{resolved} gives no answer")
        return future.result()

    def prepare(self, node: str) -> None:
        """Begin to look for the services of a node's parameters: then they are there when asked."""
        for kind, service in PARAMETER_SERVICES:
            self._client(kind, f"{node}/{service}")

    def _client(self, kind: Any, name: str) -> Any:
        if name not in self._clients:
            self._clients[name] = self._node.create_client(kind, name)
        return self._clients[name]

    def nodes(self) -> list[str]:
        """Those of the loop that are there.

        Raises:
            RunFailed: there is none.
        """
        deadline, found = monotonic() + self._patience, 0.0
        while monotonic() < deadline and not (found and monotonic() > found + FURTHER):
            here = self._here()
            if self._is_whole(here):
                return here
            found = found or (monotonic() if here else 0.0)
            self._executor.spin_once(timeout_sec=0.05)
        here = self._here()
        if not here:
            raise RunFailed(f"no graph is running in {self._node.get_namespace()} of this {WHERE}")
        return here

    def _here(self) -> list[str]:
        services = {name for name, _ in self._node.get_service_names_and_types()}
        resolve = self._node.resolve_service_name
        return [node for node in STAGES if resolve(f"{node}/set_parameters") in services]

    def _is_whole(self, here: Sequence[str]) -> bool:
        """Whether all are there: nodes are found one by one, on a busy machine seconds apart."""
        missing = set(STAGES) - set(here)
        plants = self._node.get_publishers_info_by_topic(JOINT_STATES.name)
        theirs = {each.node_name for each in plants} - {PlantSimulator.name, NAME_TO_COME}
        return not missing or (missing == {PlantSimulator.name} and bool(theirs))

    def others(self, seconds: float) -> list[str]:
        """Full names of all nodes that are found within a time."""
        deadline = monotonic() + seconds
        while monotonic() < deadline:
            self._executor.spin_once(timeout_sec=0.1)
        pairs = self._node.get_node_names_and_namespaces()
        own = self._node.get_fully_qualified_name()
        return sorted({f"{where.rstrip('/')}/{name}" for name, where in pairs} - {own})

    def names(self, node: str) -> list[str]:
        """Names of a node's parameters."""
        listed = self.call(ListParameters, f"{node}/list_parameters", ListParameters.Request())
        return sorted(name for name in listed.result.names if not name.startswith(OF_ROS))

    def describe(self, node: str, names: Sequence[str]) -> list[Any]:
        """The ``rcl_interfaces/ParameterDescriptor`` of each.

        Raises:
            BadInput: the node has no such parameter.
        """
        request = DescribeParameters.Request(names=list(names))
        found = list(
            self.call(DescribeParameters, f"{node}/describe_parameters", request).descriptors
        )
        known = {each.name for each in found if each.type}
        missing = [name for name in names if name not in known]
        if missing:
            raise BadInput(
                f"{node} has no parameter '{missing[0]}': it has {', '.join(self.names(node))}"
            )
        return found

    def values(self, node: str, names: Sequence[str] | None = None) -> dict[str, Value]:
        """Values by name, all by default."""
        if names is not None:
            self.describe(node, names)
        wanted = self.names(node) if names is None else list(names)
        request = GetParameterTypes.Request(names=wanted)
        types = self.call(GetParameterTypes, f"{node}/get_parameter_types", request).types
        given = [name for name, kind in zip(wanted, types, strict=True) if kind in KNOWN]
        found: dict[str, Value] = {name: [] for name in wanted}  # not set: an empty list
        values = self.call(
            GetParameters, f"{node}/get_parameters", GetParameters.Request(names=given)
        )
        found.update(zip(given, map(value_of, values.values), strict=True))
        return found

    def set(self, node: str, changes: Mapping[str, object]) -> str:
        """Change parameters, all of them or none; they take effect at one cycle boundary.

        Returns:
            What the node has to say of it; empty: nothing.

        Raises:
            BadInput: the node refuses them, with its reason.
        """
        kinds = {each.name: each.type for each in self.describe(node, list(changes))}
        parameters = [
            RosParameter(name, value=_of_type(value, kinds[name])).to_parameter_msg()
            for name, value in changes.items()
        ]
        request = SetParametersAtomically.Request(parameters=parameters)
        result = self.call(
            SetParametersAtomically, f"{node}/set_parameters_atomically", request
        ).result
        if not result.successful:
            raise BadInput(f"{node}: {result.reason}")
        return str(result.reason)

    def trigger(self, service: str) -> str:
        """Call a std_srvs/Trigger; what it answers.

        Raises:
            RunFailed: it did not succeed.
        """
        answer = self.call(Trigger, service, Trigger.Request())
        if not answer.success:
            raise RunFailed(f"{service}: {answer.message}")
        return str(answer.message)

    def watch(self, tell: Callable[[Any], bool]) -> None:
        """Hand over changes in flight, as they take effect, until ``tell`` says: enough."""
        done: list[bool] = []
        self._node.create_subscription(
            ParameterEvent, CHANGES, lambda event: done.append(tell(event)), 100
        )
        while not any(done):
            self._executor.spin_once(timeout_sec=0.1)


def _of_type(value: object, kind: int) -> Any:
    """A value of YAML in the type that a parameter has: whole numbers are taken as doubles."""
    if kind == RosParameter.Type.DOUBLE.value and type(value) is int:
        return float(value)
    if kind == RosParameter.Type.DOUBLE_ARRAY.value and isinstance(value, list):
        return [float(x) if type(x) is int else x for x in value]
    return value


@contextmanager
def graph(namespace: str = "") -> Iterator[Graph]:
    """The running graph of a namespace.

    Raises:
        BadInput: there is no such namespace, or this machine has no DDS to offer.
    """
    check(namespace)
    doctor.check_fit()
    middleware.configure()
    context = Context()
    rclpy.init(context=context, args=[])
    asking = Graph(context, namespace)
    try:
        yield asking
    finally:
        asking.close()
        context.try_shutdown()
