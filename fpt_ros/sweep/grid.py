"""What a sweep varies: the ranges of ``--grid``, and the points that they make.

A point is worked out from its number alone, so that no list of them is ever kept.
"""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from fpt_ros.errors import BadInput
from fpt_ros.experiments import parameter_file
from fpt_ros.parameters import Value

FORM = (
    "it takes NODE.PARAM=START:STOP:COUNT, START:STOP:COUNT:log or a list A,B,C, "
    "as in fpt_deformer.A=-0.1:-4:64"
)

Point = tuple[Value, ...]
"""A value for each axis."""

_TARGET = re.compile(r"(?P<node>\w+)\.(?P<name>[\w.]+?)(?:\[(?P<index>\d+)\])?")


@dataclass(frozen=True)
class Target:
    """A parameter, or one element of a list.

    Attributes:
        node, name: of the parameter.
        index: of the element, from 0; ``None``: the whole value.
    """

    node: str
    name: str
    index: int | None = None

    @property
    def parameter(self) -> str:
        """``NODE.PARAM``."""
        return f"{self.node}.{self.name}"

    def __str__(self) -> str:
        return self.parameter if self.index is None else f"{self.parameter}[{self.index}]"


@dataclass(frozen=True)
class Axis:
    """One parameter and the values that it takes.

    Attributes:
        target: what is varied.
        choices: the values one by one; empty for a range.
        start, stop: ends of a range, both of them in it.
        count: values of a range; 0 where only random ones are taken.
        log: whether they are in equal ratios.
        whole: whether the parameter takes integers.
    """

    target: Target
    choices: tuple[Value, ...] = ()
    start: float = 0.0
    stop: float = 0.0
    count: int = 0
    log: bool = False
    whole: bool = False

    @property
    def size(self) -> int:
        """Number of values."""
        return len(self.choices) or self.count

    @property
    def numeric(self) -> bool:
        """Whether all values are numbers."""
        return all(is_number(value) for value in self.choices)

    def random(self, share: float) -> Value:
        """The value at ``share`` in [0, 1) of the way, uniform or log-uniform."""
        if self.choices:
            return self.choices[int(share * len(self.choices))]
        if self.whole:
            low, high = sorted((self.start, self.stop))
            return int(low + math.floor(share * (high - low + 1.0)))
        if self.log:
            return self.start * math.exp(share * math.log(self.stop / self.start))
        return self.start + share * (self.stop - self.start)


def is_number(value: object) -> bool:
    """Whether a value is a number, and no truth value."""
    return isinstance(value, int | float) and not isinstance(value, bool)


def target(text: str, form: str) -> Target:
    """Read ``NODE.PARAM`` or ``NODE.PARAM[INDEX]``.

    Raises:
        BadInput: it is neither; ``form`` is what the message says of the right one.
    """
    match = _TARGET.fullmatch(text.strip())
    if match is None:
        raise BadInput(form)
    index = match["index"]
    return Target(match["node"], match["name"], None if index is None else int(index))


def parse(text: str, random: bool = False) -> Axis:
    """Read one ``--grid``.

    Args:
        text: ``NODE.PARAM=RANGE``.
        random: whether values are drawn; a range needs no count then.

    Raises:
        BadInput: it is not of this form, or has no values.
    """
    name, equals, body = text.partition("=")
    wrong = f"--grid {text}: {FORM}"
    if not equals:
        raise BadInput(wrong)
    where = target(name, wrong)
    if ":" in body and not body.lstrip().startswith(("[", "{", '"', "'")):
        return _range(where, body, random, f"--grid {text}")
    try:
        values = parameter_file.scalar(f"[{body}]")
    except BadInput as error:
        raise BadInput(wrong) from error
    if not isinstance(values, list) or any(value is None for value in values):
        raise BadInput(wrong)
    if not values:
        raise BadInput(f"--grid {text}: it has no values; {FORM}")
    frozen = tuple(tuple(value) if isinstance(value, list) else value for value in values)
    return Axis(where, choices=frozen)


def _range(where: Target, body: str, random: bool, label: str) -> Axis:
    parts = [part.strip() for part in body.split(":")]
    log = parts[-1] == "log"
    if log:
        parts.pop()
    try:
        start, stop = float(parts[0]), float(parts[1])
        count = int(parts[2]) if len(parts) > 2 else 0
        if len(parts) > 3 or not (math.isfinite(start) and math.isfinite(stop)):
            raise ValueError
    except (ValueError, IndexError):
        raise BadInput(f"{label}: {FORM}") from None
    if len(parts) > 2 and count < 1:
        raise BadInput(f"{label}: the count is {count}, it takes 1 or more")
    if not count and not random:
        raise BadInput(f"{label}: the count is missing; {FORM}")
    if log and not start * stop > 0.0:
        raise BadInput(f"{label}: log takes ends of one sign, neither of them 0")
    return Axis(where, start=start, stop=stop, count=count, log=log)


def values(axis: Axis) -> tuple[Value, ...]:
    """All values of an axis, in their order."""
    return axis.choices or _range_values(axis)


@lru_cache(maxsize=64)
def _range_values(axis: Axis) -> tuple[Value, ...]:
    if axis.count == 1 or axis.start == axis.stop:
        found = [axis.start] * axis.count
    else:
        make = np.geomspace if axis.log else np.linspace
        found = make(axis.start, axis.stop, axis.count).tolist()
    return tuple(int(v) for v in found) if axis.whole else tuple(found)


@dataclass(frozen=True)
class Space:
    """All points of a sweep.

    Attributes:
        axes: what is varied; the last one fastest.
        random: number of random points; 0: the product of the axes.
        seed: of the random points.
    """

    axes: tuple[Axis, ...]
    random: int = 0
    seed: int = 0

    @property
    def size(self) -> int:
        """Number of points."""
        return self.random or math.prod(axis.size for axis in self.axes)

    def point(self, number: int) -> Point:
        """The point with this number, from 0."""
        if self.random:
            shares: Sequence[float] = (
                np.random.default_rng([self.seed, number]).random(len(self.axes)).tolist()
            )
            return tuple(axis.random(u) for axis, u in zip(self.axes, shares, strict=True))
        found: list[Value] = []
        for axis in reversed(self.axes):
            number, at = divmod(number, axis.size)
            found.append(values(axis)[at])
        return tuple(reversed(found))
