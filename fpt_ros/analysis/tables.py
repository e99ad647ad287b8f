"""Numbers of runs side by side, in words: for the terminal and for the report page."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby

from rich import box
from rich.table import Table
from rich.text import Text

from fpt_ros.analysis import signals
from fpt_ros.analysis.comparison import Row, baselines, comparison
from fpt_ros.analysis.labels import labels_of
from fpt_ros.analysis.metrics import Summary
from fpt_ros.analysis.outline import numbers_of
from fpt_ros.runs.run import Run

QUANTITIES = {
    "rms_settled": "error, rms settled",
    "max_settled": "error, max settled",
    "rms": "error, rms of all",
    "iae": "error, IAE",
    "ise": "error, ISE",
    "itae": "error, ITAE",
    "rise_time": "rise time",
    "settling_time": "settling time",
    "overshoot_percent": "overshoot",
    "effort": "effort, rms",
    "energy": "energy",
    "chatter": "chatter, mean |r(k) - r(k-1)|",
    "missed_deadlines": "missed deadlines",
    "latency_median_ms": "latency, median [ms]",
    "latency_p99_ms": "latency, p99 [ms]",
    "latency_max_ms": "latency, max [ms]",
}
"""What the rows of :func:`~fpt_ros.analysis.comparison.comparison` are called."""

UNITS = {"rise_time": "s", "settling_time": "s", "overshoot_percent": "%"}
"""Units that are the same for all coordinates."""

PER = {"iae": " s", "ise": "² s", "itae": " s²"}
"""What stands behind the unit of the error."""

WORK = (("N m", "rad"), ("N", "m"))
"""Units of an effort and its coordinate whose product is 1 J."""

NEUTRAL = ("effort", "energy", "chatter", "rise_time")
"""Of these less is not better in itself."""


@dataclass(frozen=True)
class Cell:
    """One number: ``value`` and, against another run, ``ratio``; empty where there is none.

    ``better``: ``True`` for a smaller error than the other run's, ``False`` for a larger one,
    ``None`` where neither can be said.
    """

    value: str
    ratio: str
    better: bool | None


@dataclass(frozen=True)
class Line:
    """One row of the table: ``quantity`` with its unit, a cell a run.

    ``first``: it is the first line of its coordinate, the only one that names it.
    """

    coordinate: str
    quantity: str
    cells: tuple[Cell, ...]
    first: bool


@dataclass(frozen=True)
class Content:
    """Table of runs: headings, lines, and what the ratios mean."""

    headings: tuple[str, ...]
    lines: tuple[Line, ...]
    note: str


def content(runs: Sequence[Run | Summary]) -> Content:
    """The table of errors, efforts and chatter.

    Args:
        runs: runs (units are then given), or their summaries.
    """
    summaries = [numbers_of(one) if isinstance(one, Run) else one for one in runs]
    headings = labels_of([(str(s["experiment"]), str(s["variant"])) for s in summaries])
    against = baselines(summaries)
    lines = []
    for _, rows in groupby(comparison(summaries), lambda row: row.coordinate):
        for i, row in enumerate(rows):
            quantity = QUANTITIES[row.quantity] + _unit(row, runs)
            cells = tuple(_cell(row, column, base) for column, base in enumerate(against))
            lines.append(Line("" if i else row.coordinate, quantity, cells, not i))
    return Content(tuple(headings), tuple(lines), _note(headings, against))


def console_table(runs: Sequence[Run | Summary]) -> Table:
    """The table for the terminal, of runs or of their summaries."""
    table = content(runs)
    rich = Table(box=box.SIMPLE_HEAD, caption=table.note or None, caption_justify="left")
    rich.add_column("")
    rich.add_column("")
    for heading in table.headings:
        rich.add_column(Text(heading), justify="right")
    for at, line in enumerate(table.lines):
        cells = [_styled(cell) for cell in line.cells]
        ends = all(following.first for following in table.lines[at + 1 : at + 2])
        rich.add_row(Text(line.coordinate, "bold"), Text(line.quantity), *cells, end_section=ends)
    return rich


def ratio_text(ratio: float) -> str:
    """A ratio so that it can be pictured: ``÷30.2`` for 0.0331, ``×1.18`` for 1.18."""
    if ratio == 0.0:
        return "×0"
    return f"×{ratio:.3g}" if ratio >= 1.0 else f"÷{1.0 / ratio:.3g}"


def number_text(value: float) -> str:
    """Four significant digits; a power of ten where zeros would hide them."""
    if value != 0.0 and not 1e-4 <= abs(value) < 1e5:
        return f"{value:.3e}"
    return f"{value:#.4g}".rstrip(".")


def _styled(cell: Cell) -> Text:
    text = Text(cell.value or "-")
    colour = {True: "green", False: "red", None: "dim"}[cell.better]
    return text.append(f"  {cell.ratio:>6}", colour) if cell.ratio else text


def _cell(row: Row, column: int, base: int) -> Cell:
    value, ratio = row.values[column], row.ratios[column]
    if value is None:
        return Cell("", "", None)
    if isinstance(value, int):
        return Cell(str(value), "", None)
    if ratio is None or base == column:
        return Cell(number_text(value), "", None)
    error = row.quantity not in NEUTRAL
    better = ratio < 1.0 if error and ratio != 1.0 else None
    return Cell(number_text(value), ratio_text(ratio), better)


def _unit(row: Row, runs: Sequence[Run | Summary]) -> str:
    """The unit of a row, where all runs agree on it."""
    if row.quantity in UNITS:
        return f" [{UNITS[row.quantity]}]"
    if not row.coordinate:
        return ""
    having = [
        run
        for run, value in zip(runs, row.values, strict=True)
        if isinstance(run, Run) and value is not None
    ]
    units = {_unit_of(run, row) for run in having}
    unit = units.pop() if len(units) == 1 else ""
    return f" [{unit}]" if unit else ""


def _unit_of(run: Run, row: Row) -> str:
    unit, effort = signals.unit(run, row.coordinate), signals.effort_unit(run, row.coordinate)
    if row.quantity == "effort":
        return effort
    if row.quantity == "energy":
        return "J" if (effort, unit) in WORK else ""
    if not unit:
        return ""
    return unit + PER.get(row.quantity, "")


def _note(headings: Sequence[str], against: Sequence[int]) -> str:
    """Which run the ratios are against."""
    bases: Mapping[int, None] = dict.fromkeys(
        base for column, base in enumerate(against) if base != column
    )
    names = [headings[base] for base in bases]
    return f"÷ and ×: against {' and '.join(names)}" if names else ""
