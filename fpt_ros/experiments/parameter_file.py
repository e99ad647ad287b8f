"""Reading and writing ROS 2 parameter files.

A section is the name of a node, with any namespace (``/**/denoiser`` is the node in whatever
namespace it runs), and ``/**`` holds what several nodes share. Nested names become dotted ones.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from ruamel.yaml import YAML
from ruamel.yaml.error import YAMLError
from ruamel.yaml.scalarstring import DoubleQuotedScalarString

from fpt_ros.errors import BadInput
from fpt_ros.parameters import Value, Values
from fpt_ros.yaml_text import parse

SHARED = "/**"


@dataclass
class ParameterFile:
    """Parameters by node, and those under ``/**``."""

    shared: dict[str, Value] = field(default_factory=dict)
    nodes: dict[str, dict[str, Value]] = field(default_factory=dict)

    def overlay(self, other: "ParameterFile") -> "ParameterFile":
        """A copy of the file with the values of ``other`` on top."""
        nodes = {name: dict(values) for name, values in self.nodes.items()}
        for name, values in other.nodes.items():
            nodes.setdefault(name, {}).update(values)
        return ParameterFile({**self.shared, **other.shared}, nodes)


def scalar(text: str) -> object:
    """The value that a YAML scalar or list stands for, as in ``--set NODE.PARAM=text``.

    Raises:
        BadInput: not YAML.
    """
    try:
        return parse(text)
    except YAMLError as error:
        raise BadInput(f"'{text}' is not a YAML value: {_first_line(error)}") from error


def read(path: Path) -> ParameterFile:
    """Read a parameter file.

    Raises:
        BadInput: it cannot be read, is not YAML, or is not made of ``ros__parameters`` sections.
    """
    try:
        content = parse(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "not UTF-8 text"
        raise BadInput(f"{path} cannot be read: {reason}") from error
    except YAMLError as error:
        raise BadInput(f"{path} is not YAML: {_first_line(error)}") from error
    if not isinstance(content, dict):
        raise BadInput(f"{path} is not a ROS 2 parameter file: it has to be sections by node name")
    file = ParameterFile()
    for section, body in content.items():
        if not isinstance(body, dict) or not isinstance(body.get("ros__parameters"), dict):
            raise BadInput(f"{path}: section '{section}' has to hold a map 'ros__parameters'")
        values = _flatten(body["ros__parameters"], "")
        if section == SHARED:
            file.shared.update(values)
        else:
            file.nodes.setdefault(str(section).rsplit("/", 1)[-1], {}).update(values)
    return file


def write(path: Path, nodes: Mapping[str, Values]) -> None:
    """Write complete parameters, one section per node, valid in any namespace.

    Empty lists are left out: ROS cannot tell their type, and they are the default of theirs.
    """
    content = {
        f"{SHARED}/{node}": {
            "ros__parameters": {
                name: _plain(value) for name, value in values.items() if value != []
            }
        }
        for node, values in nodes.items()
    }
    yaml = YAML()
    yaml.default_flow_style = None
    yaml.width = 4096
    with path.open("w", encoding="utf-8") as stream:
        yaml.dump(content, stream)


def _plain(value: Value) -> object:
    """Words in quotes: ROS reads a bare ``no`` as false."""
    if isinstance(value, str):
        return DoubleQuotedScalarString(value)
    if isinstance(value, bool | int | float):
        return value
    return [_plain(item) for item in value]


def _flatten(tree: Mapping[object, object], prefix: str) -> dict[str, Value]:
    flat: dict[str, Value] = {}
    for key, value in tree.items():
        name = f"{prefix}{key}"
        if isinstance(value, dict):
            flat.update(_flatten(value, name + "."))
        else:
            flat[name] = value  # type: ignore[assignment]  # checked against its Parameter later
    return flat


def _first_line(error: YAMLError) -> str:
    problem = getattr(error, "problem", None) or str(error).splitlines()[0]
    mark = getattr(error, "problem_mark", None)
    return f"{problem} (line {mark.line + 1})" if mark is not None else str(problem)
