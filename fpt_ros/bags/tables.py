"""A recording as pandas tables, one a topic."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from fpt_ros.bags import columns, numbers, parameter_text, units
from fpt_ros.bags.bag import Bag
from fpt_ros.bags.block import Source
from fpt_ros.bags.chosen import Chosen
from fpt_ros.bags.loop_series import loop_topic
from fpt_ros.bags.numbers import Reading
from fpt_ros.errors import BadInput
from fpt_ros.messages.frames import SECOND
from fpt_ros.messages.topics import JOINT_TRAJECTORY

if TYPE_CHECKING:
    import pandas as pd


_OF_NO_UNIT = ("combined_error.", "deformed.", "accelerations.")
"""Vectors of the loop whose unit depends on the order of the plant."""


@dataclass(frozen=True)
class Tables:
    """All topics of a recording.

    Attributes:
        tables: by topic.
        missing: what is damaged or not there, a line each.
        left_out: topics that are not in the tables, and why.
    """

    tables: Mapping[str, "pd.DataFrame"]
    missing: tuple[str, ...]
    left_out: Mapping[str, str]


def load(path: str | Path) -> dict[str, "pd.DataFrame"]:
    """A recording as pandas tables: one a topic, a row a message, a column a number.

    The index is the log time in seconds, ``attrs["units"]`` gives the unit of each column where it
    is known, and ``attrs["missing"]`` says what of the recording is damaged. Numbers of joints are
    named by the joint; in topics of a recorded loop columns have the names that the loop gives
    them.

    >>> tables = fpt_ros.load("bags/tora")                      # doctest: +SKIP
    >>> tables["/joint_states"]["position.q3"].plot()           # doctest: +SKIP

    Args:
        path: a recording or one of its files, whoever made it.

    Raises:
        BadInput: it is not a recording.
    """
    found = read_tables(Path(path))
    for table in found.tables.values():
        table.attrs["missing"] = list(found.missing)
    return dict(found.tables)


def read_tables(path: Path, topics: tuple[str, ...] = ()) -> Tables:
    """The tables of a recording, of all topics or of some.

    Raises:
        BadInput: it is not a recording, or has no such topic.
    """
    bag = Bag(path)
    chosen = Chosen(topics)
    readings = numbers.read(bag, chosen)
    chosen.check(bag)
    known = units.plant_units(_parameters(bag))
    tables: dict[str, pd.DataFrame] = {}
    left_out: dict[str, str] = {}
    missing = list(bag.missing)
    for source in sorted(readings, key=lambda each: each.topic):
        reading = readings[source]
        if isinstance(reading, BadInput):
            left_out[source.topic] = str(reading)
            continue
        if reading.bad:
            missing.append(f"{reading.bad} messages on {source.topic} cannot be read")
        key = source.topic if source.topic not in tables else f"{source.topic} ({source.type})"
        tables[key] = _table(source, reading, known)
    return Tables(tables, tuple(missing), left_out)


def _parameters(bag: Bag) -> Mapping[str, Any]:
    text = bag.attachments.get(parameter_text.NAME)
    try:
        return parameter_text.from_text(text, str(bag.path)) if text is not None else {}
    except BadInput:
        return {}


def _table(
    source: Source, reading: Reading, known: tuple[Mapping[str, str], Mapping[str, str]]
) -> "pd.DataFrame":
    import pandas as pd

    count = len(reading.stamps)
    data: dict[str, Any] = {}
    found_units: dict[str, str] = {}
    names = _Names(source)
    parts = sorted(reading.parts, key=lambda part: int(part.at.min()))
    for part in parts:
        whole = len(part.at) == count
        for column in columns.columns(part):
            name = names(column.name, column.path)
            own = part.numbers[column.path][:, column.element]
            if whole:
                data[name] = own
            else:
                if name not in data:
                    data[name] = _empty(parts, column.name, own.dtype, count)
                data[name][part.at] = own
            own_words = name.startswith(_OF_NO_UNIT)
            found_units[name] = "" if own_words else units.unit(source.type, column, *known)
        for path, text in part.layout.texts.items():
            if not (text or path in data) or path.partition("[")[0] in columns.JOINTS:
                continue
            if path not in data:
                data[path] = np.full(count, "", dtype=object)
            data[path][part.at] = text
            found_units[path] = ""
    index = pd.Index(reading.stamps / SECOND, name="time")
    table = pd.DataFrame(data, index=index)
    if not index.is_monotonic_increasing:
        table = table.sort_index(kind="stable")
    table.attrs["units"] = {"time": "s", **found_units}
    table.attrs["topic"], table.attrs["type"] = source.topic, source.type
    return table


def _empty(parts: list[numbers.Part], name: str, dtype: Any, count: int) -> Any:
    """A column to be filled: of numbers that are not in all messages NaN where they are not."""
    have = sum(
        len(part.at)
        for part in parts
        if any(column.name == name for column in columns.columns(part))
    )
    if have == count:
        return np.empty(count, dtype=dtype)
    return np.full(count, np.nan)


class _Names:
    """The names of columns: in the topics of a loop those of its frames."""

    def __init__(self, source: Source) -> None:
        topic = loop_topic(source)
        self._known: dict[str, str] = {}
        if topic is not None:
            prefix = "points[0]." if topic.type == JOINT_TRAJECTORY else ""
            fields = zip(topic.fields, topic.vectors, strict=True)
            self._known = {f"{prefix}{field}": vector for field, vector in fields}

    def __call__(self, name: str, path: str) -> str:
        known = self._known.get(path)
        return name if known is None else known + name[len(path) :]
