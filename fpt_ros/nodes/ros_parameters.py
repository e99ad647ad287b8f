"""Our parameters as ROS parameters: declared with type, range, text and read-only flag."""

import math
from collections.abc import Callable, Mapping

from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
    SetParametersResult,
)
from rclpy.exceptions import (
    InvalidParameterTypeException,
    InvalidParameterValueException,
    ParameterUninitializedException,
)
from rclpy.node import Node
from rclpy.parameter import Parameter as RosParameter

from fpt_ros.errors import BadInput
from fpt_ros.parameters import Parameter, Value, Values

_TYPES = {
    "bool": RosParameter.Type.BOOL,
    "int": RosParameter.Type.INTEGER,
    "float": RosParameter.Type.DOUBLE,
    "str": RosParameter.Type.STRING,
    "floats": RosParameter.Type.DOUBLE_ARRAY,
    "strings": RosParameter.Type.STRING_ARRAY,
}

_HUGE = 1.7976931348623157e308


def declare(node: Node, parameters: Callable[[Values], tuple[Parameter, ...]]) -> dict[str, Value]:
    """Declare the parameters of a node and return what was given for them.

    Which ones there are depends on the values of others (the plant brings its own), so it goes on
    until nothing new turns up.

    Raises:
        BadInput: a value of the wrong type or out of range.
    """
    given: dict[str, Value] = {}
    seen: set[str] = set()
    while True:
        new = [p for p in parameters(given) if p.name not in seen]
        if not new:
            return given
        for parameter in new:
            seen.add(parameter.name)
            value = _declare_one(node, parameter)
            if value is not None:
                given[parameter.name] = value


def _declare_one(node: Node, parameter: Parameter) -> Value | None:
    default = parameter.default
    kind = _TYPES[parameter.kind]
    try:
        if default == []:
            _declare_empty(node, parameter, kind)
        else:
            start = kind if default is None else default
            node.declare_parameter(parameter.name, start, descriptor(parameter))
        value = node.get_parameter(parameter.name).value
    except ParameterUninitializedException:
        return default
    except InvalidParameterTypeException as error:
        raise BadInput(
            f"{node.get_name()}.{parameter.name}: a value of the wrong type is given, it takes "
            f"{parameter.describe_valid()}{_hint(parameter)}"
        ) from error
    except InvalidParameterValueException as error:
        raise BadInput(
            f"{node.get_name()}.{parameter.name}: the value given is not valid, it takes "
            f"{parameter.describe_valid()}"
        ) from error
    if value is None:
        return default
    return parameter.check(list(value) if kind.value >= 5 else value, node.get_name())


def _declare_empty(node: Node, parameter: Parameter, kind: RosParameter.Type) -> None:
    """Declare a list that is empty by default, which has no type in ROS.

    It is declared by its type alone and then set: of a node with a parameter that is not set ROS
    tells no values at all where all are asked for, as by ``ros2 param dump``.
    """
    described = descriptor(parameter)
    described.read_only = False
    node.declare_parameter(parameter.name, kind, described)
    try:
        node.get_parameter(parameter.name)
    except ParameterUninitializedException:
        node.set_parameters([RosParameter(parameter.name, kind, [])])
    node.set_descriptor(parameter.name, descriptor(parameter))


def _hint(parameter: Parameter) -> str:
    return " (ROS wants a decimal point: write 1.0, not 1)" if "float" in parameter.kind else ""


def descriptor(parameter: Parameter) -> ParameterDescriptor:
    """What ``ros2 param describe`` shows."""
    result = ParameterDescriptor(
        type=_TYPES[parameter.kind].value,
        description=parameter.text + (f" [{parameter.unit}]" if parameter.unit else ""),
        additional_constraints=parameter.describe_valid(),
        read_only=not parameter.live,
    )
    lower = max(parameter.minimum, parameter.above)
    bounded = math.isfinite(lower) or math.isfinite(parameter.maximum)
    if bounded and parameter.kind == "float":
        span = FloatingPointRange(
            from_value=lower if math.isfinite(lower) else -_HUGE,
            to_value=parameter.maximum if math.isfinite(parameter.maximum) else _HUGE,
        )
        result.floating_point_range = [span]
    if bounded and parameter.kind == "int":
        top = 2**62 if math.isinf(parameter.maximum) else int(parameter.maximum)
        result.integer_range = [IntegerRange(from_value=int(lower), to_value=top, step=0)]
    return result


def of_node(node: Node, name: str, value: Value) -> RosParameter:
    """A value of a node's parameter, of the declared type: an empty list does not tell its own."""
    return RosParameter(name, RosParameter.Type(node.describe_parameter(name).type), value)


def watch(node: Node, accept: Callable[[Mapping[str, Value]], None]) -> None:
    """Call ``accept`` with every change asked for in flight; its BadInput refuses the change."""

    def on_set(changed: list[RosParameter]) -> SetParametersResult:
        changes: dict[str, Value] = {}
        for parameter in changed:
            value = parameter.value
            is_list = parameter.type_.value >= RosParameter.Type.BYTE_ARRAY.value
            changes[parameter.name] = list(value) if is_list else value
        try:
            accept(changes)
        except BadInput as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    node.add_on_set_parameters_callback(on_set)
