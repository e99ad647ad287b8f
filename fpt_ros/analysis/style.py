"""How the figures look: colours, labels, and scales that let the curves be read."""

import re
from collections.abc import Iterable, Sequence
from contextlib import AbstractContextManager
from typing import TYPE_CHECKING, Any

import numpy as np

from fpt_ros.analysis import decimate
from fpt_ros.runs.run import Array

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

Style = dict[str, Any]
"""What matplotlib draws a line with."""

RC: dict[Any, Any] = {
    "font.size": 9.5,
    "axes.titlesize": 9.5,
    "axes.titleweight": "bold",
    "axes.labelsize": 9.5,
    "axes.edgecolor": "#6b7280",
    "axes.linewidth": 0.8,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.xmargin": 0.01,
    "axes.formatter.limits": (-3, 4),
    "axes.formatter.use_mathtext": True,
    "grid.color": "#e5e7eb",
    "grid.linewidth": 0.7,
    "xtick.color": "#374151",
    "ytick.color": "#374151",
    "legend.frameon": False,
    "legend.fontsize": 9.5,
    "lines.solid_joinstyle": "round",
    "figure.facecolor": "white",
    "savefig.dpi": 150,
    "svg.fonttype": "path",
    "svg.hashsalt": "fpt_ros",
}
"""matplotlib settings of every figure. The salt makes equal figures equal files."""

COORDINATES = ("#0072b2", "#009e73", "#a6558a", "#56b4e9", "#e69f00")
"""One a coordinate, in the plant's order: colour-blind eyes tell them apart too (Okabe, Ito)."""

DEFORMED = "#d55e00"
WANTED = "#b4b8bf"
"""Nominal and desired: a broad band behind, which a curve that follows it runs inside of."""

INK = "#374151"

ZERO: Style = {"color": INK, "linewidth": 0.7, "zorder": 1}
CHANGE: Style = {"color": "#7c3aed", "linewidth": 1.0, "linestyle": (0, (1.0, 1.5)), "zorder": 1}
"""Where a parameter was changed in flight."""

HUGE = 1e150
"""Numbers beyond it are as good as infinite: their differences overflow."""

BAND: Style = {"color": WANTED, "linewidth": 3.6, "zorder": 2}
DASHED: Style = {
    "color": DEFORMED,
    "linewidth": 1.3,
    "linestyle": (0, (4.0, 1.6)),
    "zorder": 4,
}


def settings() -> AbstractContextManager[None]:
    """Within it figures are made and saved in this style, whatever the user's matplotlibrc says."""
    import matplotlib  # the page does without

    return matplotlib.rc_context(RC)


def colour(coordinates: Sequence[str], name: str) -> str:
    """The colour of a coordinate among its plant's."""
    at = list(coordinates).index(name) if name in coordinates else 0
    return COORDINATES[at % len(COORDINATES)]


def thin(colour: str) -> Style:
    """Line of what was realised."""
    return {"color": colour, "linewidth": 1.3, "zorder": 3}


def plain(text: str) -> str:
    """Text that matplotlib shall not take for mathematics."""
    return text.replace("$", r"\$")


def symbol(name: str, force: bool = False) -> str:
    """``q2`` as the thesis prints it, its force as Q2; other names as they are."""
    match = re.fullmatch(r"([A-Za-z])(\d*)", name)
    if not match:
        return plain(name)
    letter, number = match.groups()
    if force and letter != "q":
        return f"force on ${letter}$" if not number else f"force on ${letter}_{{{number}}}$"
    letter = letter.upper() if force else letter
    return f"${letter}_{{{number}}}$" if number else f"${letter}$"


_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


def spoken(text: str) -> str:
    """A label of these figures without mathematics: ``q₂`` for what :func:`symbol` gives."""
    text = re.sub(r"_\{(\d+)\}", lambda found: found[1].translate(_SUBSCRIPTS), text)
    text = text.replace(r"^{\,N}", "ᴺ").replace(r"-\,", " − ")
    return text.replace(r"\$", "\0").replace("$", "").replace("\0", "$")


def label(quantity: str, unit: str, per: str = "") -> str:
    """Axis label with its unit, where there is one; ``per``: ``s`` or ``s²``."""
    if not unit:
        return quantity
    return f"{quantity} [{unit}/{per}]" if per else f"{quantity} [{unit}]"


def draw(axes: "Axes", x: Array, y: Array, style: Style, phase: bool = False) -> None:
    """One curve of as many points as can be seen; ``phase``: x is a signal as well."""
    if len(x):
        kept = decimate.keep_path(x, y) if phase else decimate.keep(y)
        marker: Style = {"marker": "o", "markersize": 4} if len(kept) == 1 else {}
        axes.plot(x[kept], y[kept], **style, **marker)


def handle(text: str, style: Style) -> "Line2D":
    """Legend entry for a kind of line."""
    from matplotlib.lines import Line2D

    return Line2D([], [], label=text, **style)


def span(
    curves: Iterable[Array], robust: bool = False, margin: float = 0.06
) -> tuple[float, float] | None:
    """Limits (low, high) of an axis that shows all curves.

    Args:
        curves: any lengths; NaN and infinite numbers do not count.
        robust: leave out the outermost 0.5 percent at both ends of each curve, and give what
            remains more room; rare spikes then leave the axis instead of flattening all else.
        margin: room on both sides, as a part of the span.

    Returns:
        ``None`` where no curve has a number.
    """
    ends: list[float] = []
    extremes: list[float] = []
    for curve in curves:
        known = curve[np.abs(curve) < HUGE]
        if len(known):
            ends += np.percentile(known, (0.5, 99.5) if robust else (0.0, 100.0)).tolist()
            extremes += [float(known.min()), float(known.max())]
    if not ends:
        return None
    low, high = min(ends), max(ends)
    if robust:
        room = 0.2 * (high - low)
        low, high = max(low - room, min(extremes)), min(high + room, max(extremes))
    room = margin * (high - low) or 0.05 * abs(high) or 1.0
    return low - room, high + room
