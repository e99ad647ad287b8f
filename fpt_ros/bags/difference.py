"""What differs between two recordings: the first place, and how much, by topic and field."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from fpt_ros.bags.tables import Tables

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class FieldDifference:
    """One number of a topic in both recordings.

    Attributes:
        topic, name: of the column.
        count: messages in which the two differ.
        largest, rms: of the difference, over the messages of both; of words NaN.
        unit: of both; empty: not known.
    """

    topic: str
    name: str
    count: int
    largest: float
    rms: float
    unit: str


@dataclass(frozen=True)
class First:
    """The first message that differs: ``row`` of its topic, at ``time`` [s]."""

    topic: str
    name: str
    row: int
    time: float
    values: tuple[Any, Any]


@dataclass
class Difference:
    """What differs.

    Attributes:
        first: of all topics, by time; None: no number differs.
        fields: that differ.
        counts: messages, by topic, where the two have not the same number of them.
        only: topics that one of them has, with its number, 1 or 2.
    """

    first: First | None = None
    fields: list[FieldDifference] = field(default_factory=list)
    counts: dict[str, tuple[int, int]] = field(default_factory=dict)
    only: dict[str, int] = field(default_factory=dict)

    @property
    def equal(self) -> bool:
        """Both say the same."""
        return not (self.fields or self.counts or self.only)


IGNORED = ("/diagnostics", "/rosout", "/parameter_events")
"""Topics with times of the wall clock, of no meaning to the loop."""


def compare(one: Tables, other: Tables) -> Difference:
    """Compare all topics but :data:`IGNORED`, message by message in the order of time."""
    found = Difference()
    first, second = _used(one), _used(other)
    for topic in dict.fromkeys((*first, *second)):
        if topic not in second or topic not in first:
            found.only[topic] = 1 if topic in first else 2
            continue
        a, b = first[topic], second[topic]
        if len(a) != len(b):
            found.counts[topic] = len(a), len(b)
        for name in dict.fromkeys((*a.columns, *b.columns)):
            _compare_column(found, topic, str(name), a, b)
    return found


def _used(tables: Tables) -> Mapping[str, "pd.DataFrame"]:
    return {
        topic: table
        for topic, table in tables.tables.items()
        if topic not in IGNORED and not topic.endswith("/recorded_until")
    }


def _compare_column(
    found: Difference, topic: str, name: str, a: "pd.DataFrame", b: "pd.DataFrame"
) -> None:
    count = min(len(a), len(b))
    x, y = _column(a, name, count), _column(b, name, count)
    if x is None or y is None:
        there = x if y is None else y
        assert there is not None
        differs = np.ones(count, dtype=bool)
        x = np.full(count, None) if x is None else x
        y = np.full(count, None) if y is None else y
    elif x.dtype == object or y.dtype == object:
        differs = x.astype(str) != y.astype(str)
    else:
        differs = (x != y) & ~((x != x) & (y != y))
    if not differs.any():
        return
    numbers = x.dtype != object and y.dtype != object
    gap = np.abs(x[differs].astype(float) - y[differs].astype(float)) if numbers else np.empty(0)
    known = gap[np.isfinite(gap)]
    unit = a.attrs["units"].get(name) or b.attrs["units"].get(name) or ""
    largest = float(known.max()) if len(known) else float("nan")
    rms = float(np.sqrt((known**2).sum() / count)) if len(known) else float("nan")
    found.fields.append(FieldDifference(topic, name, int(differs.sum()), largest, rms, unit))
    row = int(np.argmax(differs))
    time = float(a.index[row])
    if found.first is None or time < found.first.time:
        found.first = First(topic, name, row, time, (_plain(x[row]), _plain(y[row])))


def _column(table: "pd.DataFrame", name: str, count: int) -> Any:
    return table[name].to_numpy()[:count] if name in table else None


def _plain(value: Any) -> Any:
    """As JSON has it."""
    value = value.item() if hasattr(value, "item") else value
    return str(value) if isinstance(value, float) and not np.isfinite(value) else value
