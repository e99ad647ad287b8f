"""The topic on which nodes tell of the changes made in flight, each with its cycle's stamp."""

from typing import Any

import numpy as np

from fpt_ros.bags import schemas
from fpt_ros.errors import BadInput
from fpt_ros.messages.frames import SECOND
from fpt_ros.parameters import Value
from fpt_ros.runs.changes import Change

TOPIC, TYPE = "parameter_changes", "rcl_interfaces/msg/ParameterEvent"

_FIELDS = {
    1: "bool_value", 2: "integer_value", 3: "double_value", 4: "string_value",
    5: "byte_array_value",  # empty lists, as rclpy and nodes before this was known told them
    6: "bool_array_value", 7: "integer_array_value", 8: "double_array_value",
    9: "string_array_value",
}  # fmt: skip
"""Where a ParameterValue holds its value, by its type."""

_NUMBERS, _WORDS = 8, 9

_EMPTY: dict[str, Any] = {
    "bool_value": False,
    "integer_value": 0,
    "double_value": 0.0,
    "string_value": "",
    "byte_array_value": np.empty(0, np.uint8),
    "bool_array_value": np.empty(0, bool),
    "integer_array_value": np.empty(0, np.int64),
    "double_array_value": np.empty(0),
    "string_array_value": [],
}


def change(data: bytes) -> Change:
    """A message of :data:`TOPIC`.

    Raises:
        BadInput: it is something else.
    """
    try:
        event = schemas.decode(TYPE, data)
        values = {each.name: value_of(each.value) for each in event.changed_parameters}
        stamp = event.stamp.sec * SECOND + event.stamp.nanosec
    except Exception as error:  # whatever rosbags stumbles over
        raise BadInput(f"the message is not a {TYPE}") from error
    return Change(event.node.rpartition("/")[2], stamp, values)


def value_of(message: Any) -> Value:
    """The value of a rcl_interfaces/ParameterValue."""
    value = getattr(message, _FIELDS[message.type])
    return value.tolist() if hasattr(value, "tolist") else value  # type: ignore[no-any-return]


def encode(change: Change, node: str) -> bytes:
    """The message of :data:`TOPIC` for a change; ``node``: its fully qualified name."""
    types = schemas.types()
    parameter, parameter_value, event, time = (
        types[name]
        for name in (
            "rcl_interfaces/msg/Parameter",
            "rcl_interfaces/msg/ParameterValue",
            TYPE,
            "builtin_interfaces/msg/Time",
        )
    )
    parameters = []
    for name, value in change.values.items():
        kind = _kind(value)
        stored = np.array(value, dtype=float) if kind == _NUMBERS else value
        parameters.append(
            parameter(
                name=name,
                value=parameter_value(type=kind, **{**_EMPTY, _FIELDS[kind]: stored}),
            )
        )
    stamp = time(*divmod(change.stamp, SECOND))
    return schemas.encode(TYPE, event(stamp, node, [], parameters, []))


def _kind(value: Value) -> int:
    """The type of a ParameterValue that holds a value of ours; lists are of words or numbers."""
    if isinstance(value, bool | int | float | str):
        return {bool: 1, int: 2, float: 3, str: 4}[type(value)]
    return _WORDS if value and isinstance(value[0], str) else _NUMBERS
