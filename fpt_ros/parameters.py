"""What a parameter is: name, type, default, unit, range. One definition for YAML, ROS and docs.

A law or a stage lists its parameters as :class:`Parameter` objects. The experiment loader and the
ROS nodes both check values with them, so that a bad value gets the same one-line reason everywhere.
"""

import math
from collections.abc import Iterable, Mapping, Sequence, Set
from dataclasses import dataclass, replace

from fpt_ros.errors import BadInput

Value = bool | int | float | str | Sequence[float] | Sequence[str]
"""What a parameter can hold: the scalar types of ROS, and arrays of doubles or strings."""

Values = Mapping[str, Value]
"""Parameters by name; nested ones with dots, as in ROS (``approximate.m``)."""

_WORDS = {
    "bool": "true or false",
    "int": "an integer of 64 bits",
    "float": "a number",
    "str": "a word",
    "floats": "a list of numbers",
    "strings": "a list of words",
}


def _kind_of(value: Value) -> str:
    """The kind of a Python value, in the terms of :attr:`Parameter.kind`."""
    if isinstance(value, bool):
        return "bool"
    if isinstance(value, int):
        return "int"
    if isinstance(value, float):
        return "float"
    if isinstance(value, str):
        return "str"
    return "strings" if value and all(isinstance(v, str) for v in value) else "floats"


@dataclass(frozen=True)
class Parameter:
    """One parameter of a law or a stage.

    Attributes:
        name: as in ``--set NODE.name=`` and ``ros2 param``.
        text: what it means, one line, for ``ros2 param describe`` and the docs.
        default: value when nobody gives one; ``None``: it has to be given.
        kind: ``bool``, ``int``, ``float``, ``str``, ``floats`` or ``strings``; taken from the
            default where there is one, else ``float``.
        unit: SI unit, empty for pure numbers.
        minimum, maximum: closed bounds of a number, or of each element of a list.
        above: open lower bound.
        choices: the valid words, where only some are.
        live: whether it may change while the loop runs; structure may not.
    """

    name: str
    text: str
    default: Value | None = None
    kind: str = ""
    unit: str = ""
    minimum: float = -math.inf
    maximum: float = math.inf
    above: float = -math.inf
    choices: tuple[str, ...] = ()
    live: bool = True

    def __post_init__(self) -> None:
        if not self.kind:
            kind = "float" if self.default is None else _kind_of(self.default)
            object.__setattr__(self, "kind", kind)

    def describe_valid(self) -> str:
        """The valid values in words: type, range or choices, unit."""
        if self.choices:
            return "one of " + ", ".join(self.choices)
        bounds = []
        if self.above > -math.inf:
            bounds.append(f"> {self.above:g}")
        if self.minimum > -math.inf:
            bounds.append(f">= {self.minimum:g}")
        if self.maximum < math.inf:
            bounds.append(f"<= {self.maximum:g}")
        unit = f" [{self.unit}]" if self.unit else ""
        return _WORDS[self.kind] + (" " + " and ".join(bounds) if bounds else "") + unit

    def check(self, value: object, where: str = "") -> Value:
        """Return ``value`` in this parameter's type.

        Whole numbers are taken where a number is wanted; nothing else is converted.

        Raises:
            BadInput: wrong type, out of range, or not one of the choices; ``where`` names the node.
        """
        label = f"{where}.{self.name}" if where else self.name
        wrong = BadInput(f"{label}: {value!r} is not valid, it takes {self.describe_valid()}")
        if self.kind in ("floats", "strings"):
            unordered = isinstance(value, str | bytes | Mapping | Set)
            if unordered or not isinstance(value, Iterable):
                raise wrong
            kind = self.kind[:-1] if self.kind == "floats" else "str"
            return [self._scalar(item, kind, wrong) for item in value]  # type: ignore[return-value]
        return self._scalar(value, self.kind, wrong)

    def _scalar(self, value: object, kind: str, wrong: BadInput) -> bool | int | float | str:
        if kind == "bool" and isinstance(value, bool):
            return value
        if kind == "str" and isinstance(value, str):
            if self.choices and value not in self.choices:
                raise wrong
            return value
        if kind in ("int", "float") and isinstance(value, int | float):
            if isinstance(value, bool) or (kind == "int" and not isinstance(value, int)):
                raise wrong
            if isinstance(value, int) and not -(2**63) <= value < 2**63:  # as ROS stores it
                raise wrong
            number = float(value)
            in_range = self.minimum <= number <= self.maximum and number > self.above
            if not (math.isfinite(number) and in_range):
                raise wrong
            return value if kind == "int" else number
        raise wrong


def resolve(parameters: Iterable[Parameter], given: Values, where: str) -> dict[str, Value]:
    """Complete and check ``given``: every parameter once, in its type, nothing else.

    Raises:
        BadInput: a name that is not a parameter (the valid ones are listed), a value that is not
            valid, or a parameter without default that is not given.
    """
    known = {parameter.name: parameter for parameter in parameters}
    for name in given:
        if name not in known:
            raise BadInput(f"{where} has no parameter '{name}': it has {', '.join(sorted(known))}")
    values: dict[str, Value] = {}
    for name, parameter in known.items():
        value = given.get(name, parameter.default)
        if value is None:
            raise BadInput(f"{where}.{name} is missing: it takes {parameter.describe_valid()}")
        values[name] = parameter.check(value, where)
    return values


def group(values: Values, prefix: str, parameters: Iterable[Parameter]) -> tuple[float, ...]:
    """The numbers ``prefix.NAME`` in the order of ``parameters``, as laws take them."""
    return tuple(number(values, f"{prefix}.{parameter.name}") for parameter in parameters)


def prefixed(prefix: str, parameters: Iterable[Parameter]) -> tuple[Parameter, ...]:
    """The same parameters under ``prefix.``, as a stage declares those of its law."""
    return tuple(replace(parameter, name=f"{prefix}.{parameter.name}") for parameter in parameters)


def number(values: Values, name: str) -> float:
    """The value of a checked number."""
    value = values[name]
    assert isinstance(value, int | float)
    return float(value)


def integer(values: Values, name: str) -> int:
    """The value of a checked integer."""
    value = values[name]
    assert isinstance(value, int)
    return value


def flag(values: Values, name: str) -> bool:
    """The value of a checked bool."""
    return values[name] is True


def word(values: Values, name: str) -> str:
    """The value of a checked word."""
    value = values[name]
    assert isinstance(value, str)
    return value


def numbers(values: Values, name: str) -> list[float]:
    """The value of a checked list of numbers."""
    value = values[name]
    assert not isinstance(value, str | bool | int | float)
    return [float(item) for item in value]


def words(values: Values, name: str) -> list[str]:
    """The value of a checked list of words."""
    value = values[name]
    assert not isinstance(value, str | bool | int | float)
    return [str(item) for item in value]
