"""The topic on which nodes tell of the changes made in flight, each with its cycle's stamp."""

from typing import Any

from fpt_ros.bags.schemas import decode
from fpt_ros.errors import BadInput
from fpt_ros.messages.frames import SECOND
from fpt_ros.parameters import Value
from fpt_ros.runs.changes import Change

TOPIC, TYPE = "parameter_changes", "rcl_interfaces/msg/ParameterEvent"

_FIELDS = {
    1: "bool_value", 2: "integer_value", 3: "double_value", 4: "string_value",
    6: "bool_array_value", 7: "integer_array_value", 8: "double_array_value",
    9: "string_array_value",
}  # fmt: skip
"""Where a ParameterValue holds its value, by its type."""


def change(data: bytes) -> Change:
    """A message of :data:`TOPIC`.

    Raises:
        BadInput: it is something else.
    """
    try:
        event = decode(TYPE, data)
        values = {each.name: value_of(each.value) for each in event.changed_parameters}
        stamp = event.stamp.sec * SECOND + event.stamp.nanosec
    except Exception as error:  # whatever rosbags stumbles over
        raise BadInput(f"the message is not a {TYPE}") from error
    return Change(event.node.rpartition("/")[2], stamp, values)


def value_of(message: Any) -> Value:
    """The value of a rcl_interfaces/ParameterValue."""
    value = getattr(message, _FIELDS[message.type])
    return value.tolist() if hasattr(value, "tolist") else value  # type: ignore[no-any-return]
