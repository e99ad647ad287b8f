"""What one panel of a figure shows, as data."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from fpt_ros.analysis.style import Style
from fpt_ros.runs.run import Array

Span = tuple[float, float]
"""Lowest and highest number of an axis."""


@dataclass(frozen=True)
class Curve:
    """One curve of a panel.

    Attributes:
        x, y: (N,) points.
        style: how it is drawn.
        label: what the legend calls its kind; empty: it has no entry.
        time: (N,) of a path, both of whose coordinates are signals; ``None``: x is the axis.
    """

    x: Array
    y: Array
    style: Style
    label: str
    time: Array | None


@dataclass(frozen=True)
class Mark:
    """A line across the panel at one number; ``text`` says what happened there."""

    at: float
    style: Style
    label: str = ""
    text: str = ""


@dataclass(frozen=True)
class Bars:
    """A histogram: (n + 1,) borders and (n,) counts."""

    borders: Sequence[float]
    counts: Sequence[int]


@dataclass
class Panel:
    """What one panel shows.

    Attributes:
        x_label, y_label: of its axes, with units.
        note: a few words above it, where they cover no curve.
        curves: in the order in which they are drawn.
        levels, marks: lines at one y, and at one x.
        shaded: stretch of the x axis that does not count.
        bars: a histogram.
        x_span, y_span: what the axes show; ``None``: all there is.
    """

    x_label: str = ""
    y_label: str = ""
    note: str = ""
    curves: list[Curve] = field(default_factory=list)
    levels: list[Mark] = field(default_factory=list)
    marks: list[Mark] = field(default_factory=list)
    shaded: Span | None = None
    bars: Bars | None = None
    x_span: Span | None = None
    y_span: Span | None = None

    def draw(
        self, x: Array, y: Array, style: Style, label: str = "", time: Array | None = None
    ) -> None:
        """Add a curve; of a path with its ``time``."""
        if len(x):
            self.curves.append(Curve(x, y, style, label, time))
