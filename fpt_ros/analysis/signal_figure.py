"""The picture of a denoised signal: the record, the estimate, and what was taken away."""

import io

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray

from fpt_ros.analysis import style
from fpt_ros.analysis.estimates import Estimate, name_of, step_of
from fpt_ros.analysis.signal_source import Source
from fpt_ros.runs.run import Array

BINS = 61
WIDEST = 6.0
"""Of the histogram [standard deviations]; what lies beyond counts in its outermost bins."""

SHORTEST = 8
"""Samples that a spectrum needs."""

THIN: style.Style = {"color": style.INK, "linewidth": 0.8}
DASHED: style.Style = {"color": style.DEFORMED, "linewidth": 1.1, "linestyle": "--"}


def picture(source: Source, found: Estimate, kind: str) -> bytes:
    """The picture as the bytes of a file of this kind (png, svg, pdf).

    Above the record and the estimate, then the residual, then its spectrum and its distribution
    beside those of white normal noise of the standard deviation found.
    """
    with style.settings():
        figure = Figure(figsize=(9.5, 8.0), layout="constrained")
        FigureCanvasAgg(figure)
        above, middle, spectrum, histogram = figure.subplot_mosaic(
            [["a", "a"], ["r", "r"], ["s", "h"]], height_ratios=(2.2, 1.0, 1.3)
        ).values()
        middle.sharex(above)
        order = _order(source)
        time = _time(source)[order]
        _record(above, time, order, found)
        _residual(middle, time, order, source, found)
        _spectrum(spectrum, source, found)
        _distribution(histogram, found)
        buffer = io.BytesIO()
        figure.savefig(buffer, format=kind)
    return buffer.getvalue()


def _order(source: Source) -> NDArray[np.intp]:
    """The rows in the order of time."""
    order: NDArray[np.intp] = np.argsort(source.spacing.index, kind="stable")
    return order


def _time(source: Source) -> Array:
    if source.axis is None:
        return np.arange(len(source.table), dtype=np.float64)
    return source.axis.values


def _record(axes: Axes, time: Array, order: NDArray[np.intp], found: Estimate) -> None:
    record: style.Style = {"color": style.WANTED, "linewidth": 0.9}
    own: style.Style = {"color": style.COORDINATES[0], "linewidth": 1.3}
    style.draw(axes, time, found.measured[order], record)
    style.draw(axes, time, found.estimate[order], own)
    handles = [style.handle("measured", record), style.handle("estimate", own)]
    healed = found.healed[order]
    if healed.any():
        dots: style.Style = {"color": style.DEFORMED, "linestyle": "", "marker": "o"}
        at = np.flatnonzero(healed)[:: max(int(healed.sum()) // 2000, 1)]
        axes.plot(time[at], found.estimate[order][at], markersize=3.5, **dots)
        handles.append(style.handle(f"healed ({healed.sum()})", dots))
    title = style.plain(f"{found.signal.name}: {found.result.method}")
    axes.set_title(title, loc="left")
    axes.set_ylabel(style.plain(name_of(found)))
    axes.tick_params(labelbottom=False)
    axes.legend(handles=handles, loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=3)


def _residual(
    axes: Axes, time: Array, order: NDArray[np.intp], source: Source, found: Estimate
) -> None:
    residual = found.residual[order]
    style.draw(axes, time, residual, THIN)
    for limit in (-2.0 * found.result.sigma, 2.0 * found.result.sigma):
        axes.axhline(limit, **DASHED)
    limits = style.span([residual], robust=True)
    if limits is not None:
        axes.set_ylim(*limits)
    axes.set_ylabel("residual")
    axes.set_xlabel(style.plain(source.axis.title) if source.axis is not None else "sample")
    axes.set_title("dashed: two standard deviations of the noise", fontweight="normal", loc="left")


def _spectrum(axes: Axes, source: Source, found: Estimate) -> None:
    from scipy.signal import welch

    residual = source.spacing.samples(found.residual)
    known = ~np.isnan(residual)
    step, unit = step_of(source)
    axes.set_title("spectrum of the residual", loc="left")
    axes.set_xlabel(_frequency(unit, source))
    if len(residual) < SHORTEST or not np.any(residual[known]):
        axes.text(0.5, 0.5, "nothing was taken away", ha="center", transform=axes.transAxes)
        return
    length = min(len(residual), max(256, min(len(residual) // 8, 8192)))
    scale = float(np.max(np.abs(residual[known])))  # squares shall not overflow
    filled = np.where(known, residual / scale, 0.0)
    frequency, power = welch(filled, 1.0 / step, nperseg=length)
    amplitude = scale * np.sqrt(power[1:] / known.mean())
    axes.semilogy(frequency[1:], np.maximum(amplitude, 1e-6 * np.max(amplitude)), **THIN)
    if found.result.sigma > 0.0:
        axes.axhline(np.sqrt(2.0 * step) * found.result.sigma, **DASHED)
    axes.set_ylabel("amplitude density")
    axes.text(0.98, 0.95, "dashed: white", ha="right", va="top", transform=axes.transAxes)


def _frequency(unit: str, source: Source) -> str:
    if source.axis is None or source.spacing.times is not None:
        return "frequency [1/sample]" if source.axis is None else "frequency, of mean spacing"
    if unit == "s":
        return "frequency [Hz]"
    return style.plain(f"frequency [1/{unit}]" if unit else f"frequency [1/{source.axis.column}]")


def _distribution(axes: Axes, found: Estimate) -> None:
    residual = found.residual[~np.isnan(found.residual)]
    sigma = found.result.sigma or float(np.std(residual))
    axes.set_title("distribution of the residual", loc="left")
    axes.set_xlabel(style.plain(style.label("residual", found.signal.unit)))
    if sigma == 0.0 or not np.any(residual):
        axes.text(0.5, 0.5, "nothing was taken away", ha="center", transform=axes.transAxes)
        return
    limit = min(WIDEST * sigma, max(float(np.max(np.abs(residual))), 3.0 * sigma))
    edges = np.linspace(-limit, limit, BINS)
    inside = np.clip(residual, -limit, limit)
    axes.hist(inside, edges.tolist(), color=style.COORDINATES[0], alpha=0.5, log=True)
    middle = (edges[1:] + edges[:-1]) / 2.0
    normal = np.exp(-0.5 * (middle / sigma) ** 2) / (np.sqrt(2.0 * np.pi) * sigma)
    expected = len(residual) * normal * (edges[1] - edges[0])
    axes.plot(middle, expected, **DASHED)
    axes.set_ylim(bottom=0.5)
    axes.set_ylabel("samples")
    axes.text(0.98, 0.95, "dashed: normal", ha="right", va="top", transform=axes.transAxes)
