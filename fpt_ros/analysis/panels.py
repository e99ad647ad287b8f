"""A grid of panels as data: a row a quantity, a column a run, one scale a row and plant.

What stands in the panels is said once; ``printed`` draws it with matplotlib, ``plots`` with
Bokeh.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from fpt_ros.analysis import signals, style
from fpt_ros.analysis.labels import run_labels
from fpt_ros.analysis.panel import Curve, Mark, Panel, Span
from fpt_ros.analysis.style import Style
from fpt_ros.messages.frames import SECOND
from fpt_ros.runs.run import Array, Run

if TYPE_CHECKING:
    from matplotlib.figure import Figure

R = TypeVar("R", bound=Run)

ABREAST = 3
"""Panels beside each other where there is one run only and its panels are small."""

FLAT = 20
"""A run whose curves fill less than this part of a common scale gets a finer one."""

CHANGED = "changed in flight"
"""What the legend calls the marks of such changes."""


@dataclass(frozen=True)
class Entry:
    """Of a legend: a kind of line in all the styles that it has."""

    label: str
    styles: tuple[Style, ...]


class Panels:
    """The panels of one figure.

    Args:
        rows: names of the quantities.
        labels: heading of each column.
        groups: of each column; columns of one group share their scales.
        height: of a row [inch].
        time: the x axis is time, common to the rows of a column.
        logarithmic: both axes.

    Attributes:
        taken: panels with something in them, by row and column.
        remarks: what the caption has to say of the scales.
        linked: its time is that of the other figures, not an excerpt's.
        legend: entries, once the figure is finished.
    """

    def __init__(
        self,
        rows: Sequence[str],
        labels: Sequence[str],
        groups: Sequence[str],
        height: float,
        time: bool = True,
        logarithmic: bool = False,
    ) -> None:
        self.rows, self.labels, self.groups = rows, labels, groups
        self.height, self.time, self.logarithmic = height, time, logarithmic
        # a single run leaves room to set many rows beside each other
        self.abreast = ABREAST if len(labels) == 1 and len(rows) > ABREAST else 1
        self.taken: dict[tuple[str, int], Panel] = {}
        self.remarks: list[str] = []
        self.linked = True
        self.legend: list[Entry] = []
        self._spans: dict[str, dict[tuple[str, int], Span]] = {"x": {}, "y": {}}
        self._extremes: dict[tuple[str, int], float] = {}
        self._levels: dict[tuple[str, int], tuple[str, int]] = {}
        self._changes: list[list[Mark]] = [[] for _ in labels]

    @property
    def empty(self) -> bool:
        """Whether no cell has anything in it."""
        return not self.taken

    @cached_property
    def figure(self) -> "Figure":
        """The figure as the thesis prints it, to be saved within :func:`style.settings`."""
        from fpt_ros.analysis import printed

        return printed.figure(self)

    @classmethod
    def of(
        cls,
        runs: Sequence[Run],
        rows: Sequence[str],
        height: float = 2.3,
        *,
        time: bool = True,
        logarithmic: bool = False,
    ) -> "Panels":
        """A column for each run; runs of one plant are a group."""
        groups = [str(signals.parameter(run, "plant_simulator", "plant")) for run in runs]
        panels = cls(rows, run_labels(runs), groups, height, time, logarithmic)
        if time:
            panels._changes = [_changes(run) for run in runs]
        return panels

    def cells(self, runs: Sequence[R]) -> Iterator[tuple[str, int, R]]:
        """Every (row, column, run)."""
        for name in self.rows:
            for column, run in enumerate(runs):
                yield name, column, run

    @property
    def shape(self) -> tuple[int, int]:
        """Lines and columns of the grid."""
        columns = len(self.labels) if self.abreast == 1 else self.abreast
        return -(-len(self.rows) // self.abreast), columns

    def place(self, name: str, column: int) -> tuple[int, int]:
        """Line and column of a cell in the grid."""
        row = self.rows.index(name)
        return (row, column) if self.abreast == 1 else divmod(row, self.abreast)

    def take(self, name: str, column: int, curve: Array) -> Panel | None:
        """The panel of a cell, or ``None`` where the run has no numbers for it."""
        if not np.isfinite(curve).any():
            return None
        panel = self.taken[name, column] = Panel(marks=[*self._changes[column]])
        return panel

    def scale(self, name: str, column: int, *curves: Array, robust: bool = False) -> None:
        """Curves that the y axis of this cell shall show."""
        span = style.span(curves, robust)
        if span is not None:
            self._spans["y"][name, column] = span

    def scale_x(self, name: str, column: int, *curves: Array) -> None:
        """Curves that the x axis of this cell shall show."""
        span = style.span(curves)
        if span is not None:
            self._spans["x"][name, column] = span

    def extent(self, name: str, column: int, *curves: Array) -> None:
        """Curves that may leave the axis: if they do, the caption says how far they go."""
        known = [np.abs(curve[np.isfinite(curve)]).max(initial=0.0) for curve in curves]
        self._extremes[name, column] = float(max(known))

    def finish(self, *legend: str) -> "Panels":
        """Share the scales; ``legend``: labels of curves and levels, in this order."""
        for name in self.rows:
            for group in dict.fromkeys(self.groups):
                self._share("x", name, group)
                self._share("y", name, group)
        self._remark()
        labels = (*legend, CHANGED)
        self.legend = [entry for label in labels if (entry := self._entry(label)).styles]
        return self

    def _entry(self, label: str) -> Entry:
        """All styles that lines of a kind have, each once."""
        styles: list[Style] = []
        for panel in self.taken.values():
            lines: list[Curve | Mark] = [*panel.curves, *panel.levels, *panel.marks]
            for line in lines:
                if line.label == label and line.style not in styles:
                    styles.append(line.style)
        return Entry(label, tuple(styles))

    def first_of_group(self, name: str, column: int) -> bool:
        """Whether no panel to the left in its row is of the same plant."""
        return not any(self.groups[c] == self.groups[column] for c in self._before(name, column))

    def first_of_scale(self, name: str, column: int) -> bool:
        """Whether no panel to the left in its row has the same scale."""
        scale = self.scale_of(name, column)
        return all(self.scale_of(name, c) != scale for c in self._before(name, column))

    def scale_of(self, name: str, column: int) -> object:
        """What the panels of a row that share their scale have in common."""
        return self._levels.get((name, column), column)

    def lowest(self, name: str, column: int) -> bool:
        """Whether no panel stands below it."""
        return self.abreast > 1 or [row for row, c in self.taken if c == column][-1] == name

    def _before(self, name: str, column: int) -> list[int]:
        return [c for row, c in self.taken if row == name and c < column]

    def _share(self, axis: str, name: str, group: str) -> None:
        """One scale for the runs of a group; a finer one for those that it would flatten."""
        spans = {
            column: span
            for (row, column), span in self._spans[axis].items()
            if row == name and self.groups[column] == group
        }
        level = 0
        while spans:
            widest = max(high - low for low, high in spans.values())
            here = {
                column: span
                for column, span in spans.items()
                if axis == "x" or span[1] - span[0] >= widest / FLAT
            }
            common = min(s[0] for s in here.values()), max(s[1] for s in here.values())
            for column in here:
                panel = self.taken[name, column]
                if axis == "x":
                    panel.x_span = common
                    continue
                panel.y_span = common
                self._levels[name, column] = group, level
                if level:
                    panel.note += ", finer scale" if panel.note else "finer scale"
            spans = {column: span for column, span in spans.items() if column not in here}
            level += 1

    def _remark(self) -> None:
        """Say in the caption what the scales do."""
        if any(level for _, level in self._levels.values()):
            self.remarks.append(
                f"Runs that the common scale would flatten to less than 1/{FLAT} of the panel "
                "have a finer one, as is written above them."
            )
        beyond: dict[str, float] = {}
        for (name, column), largest in self._extremes.items():
            low, high = self.taken[name, column].y_span or (0.0, 0.0)
            if largest > max(abs(low), abs(high)):
                beyond[name] = max(largest, beyond.get(name, 0.0))
        if beyond:
            reach = ", ".join(f"{largest:.3g} ({name})" for name, largest in beyond.items())
            self.remarks.append(
                "The scale is chosen for the bulk of the settled motion; what leaves it reaches, "
                f"in size, {reach}."
            )


def _changes(run: Run) -> list[Mark]:
    """Where parameters were changed in flight."""
    return [
        Mark(
            (change.stamp - signals.origin(run)) / SECOND,
            style.CHANGE,
            CHANGED,
            f"{change.node}: "
            + ", ".join(f"{name} = {value}" for name, value in change.values.items()),
        )
        for change in run.changes
    ]
