"""A grid of panels: a row a quantity, a column a run, and one scale a row for runs of one plant."""

from collections.abc import Iterator, Sequence
from typing import Any, TypeVar

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.legend_handler import HandlerTuple
from matplotlib.ticker import MaxNLocator

from fpt_ros.analysis import signals, style
from fpt_ros.analysis.labels import run_labels
from fpt_ros.analysis.legends import Entry
from fpt_ros.runs.run import Array, Run

R = TypeVar("R", bound=Run)

ABREAST = 3
"""Panels beside each other where there is one run only and its panels are small."""

FLAT = 20
"""A run whose curves fill less than this part of a common scale gets a finer one."""

Span = tuple[float, float]
"""Lowest and highest number of an axis."""


class Panels:
    """Axes of one figure while it is being drawn.

    Args:
        rows: names of the quantities.
        labels: heading of each column.
        groups: of each column; columns of one group share their scales.
        height: of a row [inch].
        time: the x axis is time, common to the rows of a column.
    """

    def __init__(
        self,
        rows: Sequence[str],
        labels: Sequence[str],
        groups: Sequence[str],
        height: float,
        time: bool,
    ) -> None:
        self._rows, self._labels, self._groups, self._time = rows, labels, groups, time
        # a single run leaves room to set many rows beside each other
        self._abreast = ABREAST if len(labels) == 1 and len(rows) > ABREAST else 1
        columns = len(labels) if self._abreast == 1 else self._abreast
        lines = -(-len(rows) // self._abreast)
        width = {1: 8.0, 2: 10.5}.get(columns, 3.9 * columns)
        if columns == 1 and not time:
            width = 5.6
        self.figure = Figure(figsize=(width, height * lines + 0.9), layout="constrained")
        self._grid = self.figure.subplots(lines, columns, squeeze=False)
        self._taken: dict[tuple[str, int], Axes] = {}
        self._spans: dict[str, dict[tuple[str, int], Span]] = {"x": {}, "y": {}}
        self._extremes: dict[tuple[str, int], float] = {}
        self._notes: dict[tuple[str, int], str] = {}
        self._scales: dict[tuple[str, int], tuple[str, int]] = {}
        self.remarks: list[str] = []

    @property
    def empty(self) -> bool:
        """Whether no cell has anything in it."""
        return not self._taken

    @classmethod
    def of(
        cls, runs: Sequence[Run], rows: Sequence[str], height: float = 2.3, *, time: bool = True
    ) -> "Panels":
        """A column for each run; runs of one plant are a group."""
        labels = [style.plain(label) for label in run_labels(runs)]
        groups = [str(signals.parameter(run, "plant_simulator", "plant")) for run in runs]
        return cls(rows, labels, groups, height, time)

    def cells(self, runs: Sequence[R]) -> Iterator[tuple[str, int, R]]:
        """Every (row, column, run)."""
        for name in self._rows:
            for column, run in enumerate(runs):
                yield name, column, run

    def _axes(self, name: str, column: int) -> Axes:
        row = self._rows.index(name)
        if self._abreast == 1:
            return self._at(row, column)
        return self._at(*divmod(row, self._abreast))

    def _at(self, row: int, column: int) -> Axes:
        axes = self._grid[row][column]
        assert isinstance(axes, Axes)
        return axes

    def take(self, name: str, column: int, curve: Array) -> Axes | None:
        """The axes for a cell, or ``None`` where the run has no numbers for it."""
        if not np.isfinite(curve).any():
            return None
        axes = self._taken[name, column] = self._axes(name, column)
        return axes

    def note(self, name: str, column: int, text: str) -> None:
        """A few words above a panel, where they cover no curve."""
        self._notes[name, column] = text

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

    def finish(self, *legend: Entry) -> "Panels":
        """Scales, headings, labels at the outside, legend above all panels."""
        for name in self._rows:
            for group in dict.fromkeys(self._groups):
                self._share("x", name, group)
                self._share("y", name, group)
        self._remark()
        self._headings()
        self._outer_labels()
        self.figure.align_ylabels()
        if legend:
            handles: list[Any] = list(legend)  # matplotlib's stubs do not know tuples of them
            self.figure.legend(
                handles,
                [str((e[0] if isinstance(e, tuple) else e).get_label()) for e in legend],
                loc="outside upper center",
                ncols=len(legend),
                handler_map={tuple: HandlerTuple(ndivide=None, pad=0.3)},
            )
        return self

    def _share(self, axis: str, name: str, group: str) -> None:
        """One scale for the runs of a group; a finer one for those that it would flatten."""
        spans = {
            column: span
            for (row, column), span in self._spans[axis].items()
            if row == name and self._groups[column] == group
        }
        level = 0
        while spans:
            widest = max(high - low for low, high in spans.values())
            here = {
                column: span
                for column, span in spans.items()
                if axis == "x" or span[1] - span[0] >= widest / FLAT
            }
            low, high = min(s[0] for s in here.values()), max(s[1] for s in here.values())
            for column in here:
                axes = self._taken[name, column]
                if axis == "x":
                    axes.set_xlim(low, high)
                    continue
                axes.set_ylim(low, high)
                self._scales[name, column] = group, level
                if level:
                    note = self._notes.get((name, column))
                    self._notes[name, column] = f"{note}, finer scale" if note else "finer scale"
            spans = {column: span for column, span in spans.items() if column not in here}
            level += 1

    def _remark(self) -> None:
        """Say in the caption what the scales do."""
        if any(level for _, level in self._scales.values()):
            self.remarks.append(
                f"Runs that the common scale would flatten to less than 1/{FLAT} of the panel "
                "have a finer one, as is written above them."
            )
        beyond: dict[str, float] = {}
        for (name, column), largest in self._extremes.items():
            low, high = self._taken[name, column].get_ylim()
            if largest > max(abs(low), abs(high)):
                beyond[name] = max(largest, beyond.get(name, 0.0))
        if beyond:
            reach = ", ".join(f"{largest:.3g} ({name})" for name, largest in beyond.items())
            self.remarks.append(
                "The scale is chosen for the bulk of the settled motion; what leaves it reaches, "
                f"in size, {reach}."
            )

    def _headings(self) -> None:
        for cell, note in self._notes.items():
            self._taken[cell].set_title(note, loc="right", fontweight="normal", color=style.INK)
        used = {id(axes) for axes in self._taken.values()}
        for axes in self._grid.flat:
            if id(axes) not in used:
                axes.set_axis_off()
        if self._abreast > 1:
            self._at(0, 0).set_title(self._labels[0], loc="left", pad=9)
            return
        noted = any(row == self._rows[0] for row, _ in self._notes)
        for column, label in enumerate(self._labels):
            # one line higher where a note stands above the panel
            heading = f"{label}\n" if noted else label
            self._at(0, column).set_title(heading, loc="left", pad=6)
            for row, name in enumerate(self._rows):
                if (name, column) not in self._taken:
                    where = self._at(row, column)
                    text = f"{style.symbol(name)}: no such curve"
                    where.text(0.5, 0.5, text, ha="center", color=style.WANTED)

    def _outer_labels(self) -> None:
        """Time at the lowest panels only, y labels at the first of each group only."""
        lowest: dict[int, str] = {column: row for row, column in self._taken}
        for (row, column), axes in self._taken.items():
            before = [c for r, c in self._taken if r == row and c < column]
            if any(self._groups[c] == self._groups[column] for c in before):
                axes.set_ylabel("")
            scale = self._scales.get((row, column))
            if any(self._scales.get((row, c)) == scale for c in before):
                axes.tick_params(labelleft=False)
            axes.xaxis.set_major_locator(MaxNLocator(7, steps=[1, 2, 4, 5, 10]))
            if self._time and (lowest[column] == row or self._abreast > 1):
                axes.set_xlabel("time [s]")
            elif self._time:
                axes.tick_params(labelbottom=False)
