"""What a recording says about a topic: definition and hash of its type, quality of service."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from io import StringIO
from typing import Any

from rosbags.typesys import Stores, get_typestore
from rosbags.typesys.store import Typestore
from ruamel.yaml import YAML

from fpt_ros.errors import BadInput
from fpt_ros.messages.topics import BY_NAME, DEPTH

_FOREVER = {"sec": 9223372036, "nsec": 854775807}
"""No limit: the largest int64 of nanoseconds, as rosbag2 writes it."""

_DEFAULT_DEPTH = 10


@dataclass(frozen=True)
class Schema:
    """A ROS message type.

    Attributes:
        type: as in ``sensor_msgs/msg/JointState``.
        text: its definition and those it depends on, in the form ``ros2msg``.
        hash: RIHS01 hash of the type, as ROS 2 computes it.
    """

    type: str
    text: str
    hash: str


@cache
def schema(type: str) -> Schema:
    """Definition and hash of a message type of ROS 2 Jazzy.

    Raises:
        BadInput: not one of Jazzy's common types.
    """
    store = _store()
    if type not in store.types:
        raise BadInput(f"cannot record '{type}': it has to be a type like sensor_msgs/msg/Imu")
    return Schema(type, store.generate_msgdef(type, ros_version=2)[0], store.hash_rihs01(type))


def decode(type: str, data: bytes) -> Any:
    """A serialised message as an object with the fields of its type.

    Raises:
        BadInput: not one of Jazzy's common types.
        Exception: of rosbags, where the bytes are not of this type.
    """
    return _store().deserialize_cdr(data, schema(type).type)


def encode(type: str, message: Any) -> bytes:
    """An object made of :func:`types`, serialised."""
    return bytes(_store().serialize_cdr(message, type))


def types() -> Mapping[str, Any]:
    """The classes of Jazzy's message types, by name."""
    return _store().types


def offered_qos(topic: str, depth: int | None = None) -> list[dict[str, object]]:
    """Quality of service offered on a topic, as in version 9 of rosbag2's ``metadata.yaml``.

    Loop topics are latched, in any namespace; all others are volatile. All are reliable.

    Args:
        topic: its name, with or without a namespace.
        depth: of its history [messages]; by default that of the loop topics, or ROS's 10.
    """
    latched = topic.rpartition("/")[2] in BY_NAME
    if depth is None:
        depth = DEPTH if latched else _DEFAULT_DEPTH
    return [
        {
            "history": "keep_last",
            "depth": depth,
            "reliability": "reliable",
            "durability": "transient_local" if latched else "volatile",
            "deadline": dict(_FOREVER),
            "lifespan": dict(_FOREVER),
            "liveliness": "automatic",
            "liveliness_lease_duration": dict(_FOREVER),
            "avoid_ros_namespace_conventions": False,
        }
    ]


def yaml_text(content: object) -> str:
    """Block-style YAML, the order of the keys kept."""
    yaml = YAML()
    yaml.default_flow_style = False
    yaml.width = 4096
    # shared mappings would become anchors and aliases, which not every reader knows
    yaml.representer.ignore_aliases = lambda data: True
    stream = StringIO()
    yaml.dump(content, stream)
    return stream.getvalue()


@cache
def _store() -> Typestore:
    return get_typestore(Stores.ROS2_JAZZY)
