"""The column of times of a table, and what it is in seconds."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fpt_ros.errors import BadInput
from fpt_ros.tables import headings, times
from fpt_ros.tables.table import Column, Kind, Table, titled

NONE = "none"
"""The word for: no column of times, the rows are equally spaced."""

EPOCHS = ((1e17, "ns"), (1e14, "us"), (1e11, "ms"), (1e9, "s"))
"""Times since 1970: the unit by their size, for the years from 2001 on."""

EVEN = 1e-3
"""Steps that differ by less than this part are equal, for columns without a telling name."""

FEWEST = 8
"""Rows from which on an even column without a telling name is taken for the times."""

REMEDY = "or --time none takes the rows as equally spaced"


@dataclass(frozen=True)
class TimeAxis:
    """The times of the rows.

    Attributes:
        column: the name of their column.
        values: (n,), in ``unit``; seconds since the first row where the file has dates.
        unit: ``s``, ``ms`` ...; empty where it is not known.
    """

    column: str
    values: NDArray[np.float64]
    unit: str

    @property
    def title(self) -> str:
        """For the axis of a picture."""
        return titled(self.column, self.unit)

    @property
    def second(self) -> float | None:
        """Length of the unit [s]; ``None`` where it is not known."""
        return headings.TIME_UNITS.get(self.unit)


def find(table: Table, wanted: str | None, signals: Sequence[str] = ()) -> TimeAxis | None:
    """The times of a table; ``None`` where it has none, or ``wanted`` is ``none``.

    A column of dates or times of day comes first, then one whose name or unit says so, then the
    first column if it goes up in equal steps.

    Args:
        table: the table.
        wanted: name of the column, ``none``, or nothing: then it is looked for.
        signals: names of columns that are signals, and so are not the times.

    Raises:
        BadInput: no such column, times missing, or not numbers.
    """
    if wanted == NONE:
        return None
    column = table.column(wanted) if wanted is not None else _guess(table, signals)
    return None if column is None else _axis(table, column)


def _guess(table: Table, signals: Sequence[str]) -> Column | None:
    others = [each for each in table.columns if each.name not in signals]
    for each in others:
        if each.kind in (Kind.TIME, Kind.CLOCK):
            return each
    for each in others:
        if each.kind is Kind.NUMBER and headings.is_time_name(each.name):
            return each
    for each in others:
        if each.kind is Kind.NUMBER and each.unit in headings.TIME_UNITS and _rises(each):
            return each
    if sum(each.numeric for each in table.columns) < 2:
        return None
    whole = (each for each in table.columns if each.kind is Kind.NUMBER and not _lacks(each))
    first = next(whole, None)
    return first if first is not None and first.name not in signals and _even(first) else None


def _lacks(column: Column) -> bool:
    return bool(np.isnan(column.values).any())


def _rises(column: Column) -> bool:
    return bool(np.all(np.diff(column.values) > 0))


def _even(column: Column) -> bool:
    if column.kind is not Kind.NUMBER or len(column.values) < FEWEST or not _rises(column):
        return False
    line = np.linspace(column.values[0], column.values[-1], len(column.values))
    step = line[1] - line[0]
    rounding = 1e-15 * abs(float(line[-1]))
    steps = np.diff(column.values.astype(np.float64))
    return bool(np.all(np.abs(steps - step) <= EVEN * step + rounding))


def unread(table: Table) -> str:
    """A remark on a column that by its name holds times, which cannot be read; empty if none."""
    for each in table.columns:
        if each.kind is Kind.TEXT and headings.is_time_name(each.name) and len(table):
            return (
                f"times of '{each.name}' ('{each.values[0]}') cannot be read: rows are taken as "
                "equally spaced; write them as in 2024-03-01T12:00:10.25"
            )
    return ""


def _axis(table: Table, column: Column) -> TimeAxis:
    name, values = column.name, column.values
    if column.refusal:
        raise BadInput(f"{table.name}: the times: {column.refusal}, {REMEDY}")
    if column.kind not in (Kind.NUMBER, Kind.TIME, Kind.CLOCK):
        raise BadInput(f"{table.name}: column '{name}' is no times: it has {column.kind}")
    lost = np.flatnonzero(np.isnat(values) if values.dtype.kind in "mM" else ~np.isfinite(values))
    if len(lost):
        more = f" and in {len(lost) - 1} more" if len(lost) > 1 else ""
        raise BadInput(
            f"{table.name}: the time '{name}' is missing in {table.where(int(lost[0]))}{more}: "
            f"fill it in, {REMEDY}"
        )
    if column.kind is Kind.NUMBER:
        return _numbers(column)
    if column.kind is Kind.CLOCK:
        values = times.over_midnight(values)
    elif np.all(values == values.astype("datetime64[D]")):  # dates alone: add the time of day
        clock = next((each for each in table.columns if each.kind is Kind.CLOCK), None)
        if clock is not None and not np.isnat(clock.values).any():
            same_day = bool(np.all(values == values[0]))
            values = values + (times.over_midnight(clock.values) if same_day else clock.values)
    since = (values - values[0]) / np.timedelta64(1, "s")
    return TimeAxis(name if not name.isdigit() else "time", since, "s")


def _numbers(column: Column) -> TimeAxis:
    values, unit = column.values, column.unit
    named = headings.is_time_name(column.name)
    size = float(np.min(values))
    if named and unit not in headings.TIME_UNITS:
        unit = next((each for limit, each in EPOCHS if size > limit), unit)
    if size > EPOCHS[-1][0] and unit in headings.TIME_UNITS:
        since = (values - values[0]).astype(np.float64)  # exact: whole numbers are int64
        return TimeAxis(column.name, since * headings.TIME_UNITS[unit], "s")
    return TimeAxis(column.name, values.astype(np.float64), unit)
