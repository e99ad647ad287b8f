"""The picture of a gain analysis: behaviour over |A|, where the iteration ends, multipliers."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from fpt_ros.analysis import style
from fpt_ros.gain.bands import (
    CHAOS,
    DOUBLING,
    DOUBLING_TO_CHAOS,
    LEAVES,
    MONOTONE,
    OR_TWO_CYCLE,
    PRECURSOR,
    RUNS_AWAY,
    TWO_CYCLE,
)
from fpt_ros.gain.limits import Gain
from fpt_ros.gain.motion import Course
from fpt_ros.runs.run import Array

COLOURS = {
    MONOTONE: "#cfe8d8",
    PRECURSOR: "#f6edc3",
    MONOTONE + OR_TWO_CYCLE: "#e3e4c0",
    PRECURSOR + OR_TWO_CYCLE: "#fadfb0",
    TWO_CYCLE: "#f6c3a5",
    DOUBLING: "#efab9f",
    DOUBLING_TO_CHAOS: "#e59a9a",
    CHAOS: "#dd8c97",
    LEAVES: "#c9c9d2",
    RUNS_AWAY: "#c9c9d2",
}

GIVEN: style.Style = {"color": style.DEFORMED, "linewidth": 1.6, "linestyle": (0, (4.0, 1.6))}
ADVISED: style.Style = {"color": style.COORDINATES[0], "linewidth": 1.6}
COLUMNS = 420
SKIP, KEEP = 400, 48
"""Iterations that are left out, and shown, of each orbit."""


def figure(gain: Gain, course: Course, title: str, unit: str = "") -> Figure:
    """Behaviour over |A|, the response errors that remain, and the multipliers over time.

    Args:
        gain: the analysis.
        course: of the eigenvalues along the motion.
        title: of the whole.
        unit: of the response.
    """
    with style.settings():
        if gain.sign:
            picture = Figure(figsize=(9.0, 8.4), layout="constrained")
            strip, ends, time = picture.subplots(3, 1, height_ratios=(0.62, 1.5, 1.4))
            end = _end(gain)
            _strip(strip, gain, end)
            _ends(ends, gain, end, unit)
            strip.sharex(ends)
            strip.tick_params(labelbottom=False, bottom=False)
        else:
            picture = Figure(figsize=(9.0, 3.6), layout="constrained")
            time = picture.subplots()
        _course(time, gain, course)
        picture.suptitle(style.plain(title), fontsize=11.5, fontweight="bold", x=0.02, ha="left")
        FigureCanvasAgg(picture)
    return picture


def _end(gain: Gain) -> float:
    """Largest |A| that is shown."""
    marks = [gain.linear_limit, gain.hard_onset, gain.doubling, gain.domain_limit]
    last = 1.22 * max(mark for mark in marks if mark is not None)
    given = abs(gain.given) if not gain.calculated else 0.0
    return max(last, 1.1 * given if given < 3.0 * last else 0.0)


def _shade(axes: Axes, gain: Gain, end: float, strength: float) -> None:
    for band in gain.bands:
        stop = min(band.end, end)
        if band.start < stop:
            axes.axvspan(
                band.start, stop, color=COLOURS[band.name], alpha=strength, linewidth=0, zorder=0
            )


def _strip(axes: Axes, gain: Gain, end: float) -> None:
    """The bands with their names, the limits between them, and the two gains."""
    _shade(axes, gain, end, 1.0)
    axes.set(xlim=(0.0, end), ylim=(0.0, 1.0))
    axes.grid(visible=False)
    axes.yaxis.set_visible(False)
    axes.spines["left"].set_visible(False)
    edges: list[float] = []
    for band in gain.bands:
        stop = min(band.end, end)
        if band.start >= stop:
            continue
        if band.start > 0.0:
            edges.append(band.start)
        width = (stop - band.start) / end
        words = band.name.replace(OR_TWO_CYCLE, "\nor " + TWO_CYCLE).replace("period d", "d")
        if width < 0.2:
            words = words.replace("precursor osc", "precursor\nosc").replace(", chaos", ",\nchaos")
            words = words.replace("leaves the", "leaves\nthe").replace("two-cycle", "two-\ncycle")
        if width > 0.035:
            turned = 90 if width < 0.075 else 0
            axes.text(
                band.start + 0.5 * (stop - band.start),
                0.42,
                words.replace("\n", " ") if turned else words,
                ha="center",
                va="center",
                rotation=turned,
                fontsize=7.0 if turned else 8.5,
                color=style.INK,
                linespacing=1.15,
            )
    top, last = 0, -1.0
    for edge in edges:
        axes.axvline(edge, color=style.INK, linewidth=1.0)
        top = 1 - top if edge - last < 0.085 * end else 0
        axes.annotate(
            f"{edge:.4g}",
            (edge, 1.0),
            xytext=(0, 3 + 11 * top),
            textcoords="offset points",
            ha="center",
            va="bottom",
            fontsize=8.5,
            color=style.INK,
        )
        last = edge
    for at, look in _marks(gain, end):
        axes.plot(
            [at], [0.0], marker="^", markersize=9, color=look["color"], clip_on=False, zorder=6
        )


def _marks(gain: Gain, end: float) -> list[tuple[float, style.Style]]:
    """|A| of the recommended and of the given gain, where they are in the picture."""
    found = [(abs(gain.recommended), ADVISED)]
    if not gain.calculated and 0.0 < gain.given * gain.sign <= end:
        found.append((abs(gain.given), GIVEN))
    return found


def _ends(axes: Axes, gain: Gain, end: float, unit: str) -> None:
    """The response errors that the iteration ends with, from a small start and a large one."""
    _shade(axes, gain, end, 0.45)
    scalar = gain.scalar
    small = 1e-3 * min(1.0, gain.reach)
    starts: list[tuple[float, style.Style, str]] = [
        (small, {"color": style.INK, "markersize": 1.1, "zorder": 4}, "from a small error")
    ]
    hard = scalar.hard_onset()
    if hard is not None:
        large: style.Style = {"color": "#a33b00", "markersize": 1.1, "zorder": 3}
        starts.append((hard.high * (1.0 + 1e-6), large, "from a large error"))
    shown: list[float] = []
    for start, look, label in starts:
        x: list[float] = []
        y: list[float] = []
        for A in np.linspace(0.03 * end, end, COLUMNS):
            last = np.array(scalar.attractor(float(A) / gain.scale, start, SKIP, KEEP)) / A
            if hard is not None and len(last):
                # saturated two-cycles can be shifted as a whole: what they swing about says nothing
                last = last - last.mean()
            x += [float(A)] * len(last)
            y += last.tolist()
        axes.plot(x, y, ".", rasterized=True, **look)
        axes.plot([], [], "o", color=look["color"], markersize=3.5, label=label)
        shown += [h for h in y if abs(h) > 1e-9]
    if len(starts) > 1:
        axes.legend(loc="upper left", frameon=True, framealpha=0.85, edgecolor="none")
    for at, look in _marks(gain, end):
        axes.axvline(at, **look, zorder=2)
    for band in gain.bands[1:]:
        axes.axvline(band.start, color=style.INK, linewidth=0.8, zorder=2)
    axes.set_xlim(0.0, end)
    low, high = np.percentile(shown, (0.2, 99.8)).tolist() if shown else (-1.0, 1.0)
    room = 0.25 * (high - low)
    axes.set_ylim(min(low, 0.0) - room, max(high, 0.0) + room)
    axes.set_xlabel("$|A|$, $A < 0$" if gain.sign < 0 else "$A$")
    axes.set_ylabel(style.label("response error", unit))
    axes.set_title("where the iteration ends", loc="left")
    axes.xaxis.set_major_locator(MaxNLocator(10))


def _course(axes: Axes, gain: Gain, course: Course) -> None:
    """The multipliers of the given and of the recommended gain along the motion."""
    if not gain.sign:
        _lines(axes, course, course.eigenvalues, ADVISED)
        axes.axhline(0.0, color=style.INK, linewidth=1.0)
        axes.set_title(
            "eigenvalues of the response along the motion: they have to be of one sign", loc="left"
        )
        axes.set(xlabel="t [s]", ylabel="eigenvalue")
        return
    handles = []
    lowest, highest = -1.15, 1.1
    chosen = [(gain.recommended, ADVISED, "recommended")]
    if not gain.calculated and gain.given != gain.recommended:
        chosen.append((gain.given, GIVEN, "given"))
    for A, look, what in chosen:
        multipliers = gain.multipliers(A, course.eigenvalues)
        _lines(axes, course, multipliers, look)
        handles.append(style.handle(f"{what}, A = {A:g}", look))
        finite = multipliers[np.isfinite(multipliers)]
        if finite.size:
            lowest = min(lowest, 1.06 * float(finite.min()))
            highest = max(highest, 1.06 * float(finite.max()))
    # what is far outside would flatten what matters
    lowest, highest = max(lowest, -4.0), min(highest, 4.0)
    axes.axhspan(0.0, 1.0, color=COLOURS[MONOTONE], alpha=0.45, linewidth=0, zorder=0)
    axes.axhspan(-1.0, 0.0, color=COLOURS[PRECURSOR], alpha=0.45, linewidth=0, zorder=0)
    for edge in (-1.0, 1.0):
        axes.axhline(edge, color=style.INK, linewidth=1.0)
    axes.set_ylim(lowest, highest)
    axes.set_title("multipliers of the response error along the motion", loc="left")
    axes.set_xlabel("t [s]")
    axes.set_ylabel("multiplier per learning step")
    picture = axes.get_figure()
    assert picture is not None
    axes.legend(handles=handles, loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2)


def _lines(axes: Axes, course: Course, rows: Array, look: style.Style) -> None:
    for column in rows.T:
        if np.isfinite(column).any():
            axes.plot(course.time, column, **look, zorder=3)
