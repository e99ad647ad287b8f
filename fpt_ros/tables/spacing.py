"""How the samples of a record lie in time: equally spaced, with holes, or anyhow."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from fpt_ros.errors import BadInput
from fpt_ros.tables.table import Table
from fpt_ros.tables.time_axis import REMEDY, TimeAxis

Floats = NDArray[np.float64]

EQUAL = 0.05
"""Times that deviate from equal spacing by less than this part of the step are equally spaced."""

NEAR = 0.5
"""Below this part the times jitter, and every sample still has its own place."""

SPARSE = 4
"""Holes are filled where at most this many places come to one sample."""

RESTART = 10
"""Steps back by which a time begins anew."""


@dataclass(frozen=True)
class Spacing:
    """The places of the rows among samples in the order of time.

    Attributes:
        index: (n,) the place of each row.
        count: number of places; those that no row has are holes.
        step: between places, the median if they are not equally spaced [unit of the times].
        times: (count,) of the places, where they are not equally spaced; else ``None``.
        jitter: largest deviation from equal spacing [step].
        even: the places may be taken as equally spaced.
        remarks: what a user should know.
    """

    index: NDArray[np.intp]
    count: int
    step: float
    times: Floats | None = None
    jitter: float = 0.0
    even: bool = True
    remarks: tuple[str, ...] = ()

    def samples(self, rows: Floats) -> Floats:
        """(count,) the rows' values in their places, NaN in holes; at equal times the mean."""
        known = ~np.isnan(rows)
        at = self.index[known]
        if self.count == len(rows) and np.array_equal(self.index, np.arange(self.count)):
            return rows
        sums = np.bincount(at, weights=rows[known], minlength=self.count)
        counts = np.bincount(at, minlength=self.count)
        with np.errstate(invalid="ignore"):
            means = sums / counts
        alone = counts[at] == 1
        means[at[alone]] = rows[known][alone]  # infinite numbers stay what they are
        return means

    def rows(self, samples: Floats) -> Floats:
        """(n,) the samples in the order of the rows."""
        found: Floats = samples[self.index]
        return found


def spacing_of(table: Table, axis: TimeAxis | None) -> Spacing:
    """The places of a table's rows; without times they are equally spaced.

    Raises:
        BadInput: all times are equal, or they begin anew.
    """
    count = len(table)
    if axis is None or count < 2:
        return Spacing(np.arange(count), count, 1.0)
    t, name = axis.values, axis.title
    if np.all(t == t[0]):
        raise BadInput(f"{table.name}: the times '{name}' are all {t[0]:g}: give others, {REMEDY}")
    remarks = []
    order = np.arange(count)
    if np.any(np.diff(t) < 0):
        _check_restart(table, t, name)
        order = np.argsort(t, kind="stable")
        remarks.append(f"rows are not in the order of '{name}': sorted by it for the estimate")
    index = np.empty(count, dtype=np.intp)
    index[order] = np.arange(count)
    t = t[order]
    ticks, place, sizes = np.unique(t, return_inverse=True, return_counts=True)
    doubled = count - len(ticks)
    if doubled and _coarse(sizes):
        step = float((ticks[-1] - ticks[0]) / (count - sizes[-1]))
        remarks.append(
            f"times of '{name}' come {int(np.median(sizes))} at once, a coarse clock: "
            f"taken as equally spaced, {step:g} apart"
        )
        return Spacing(index, count, step, None, 0.0, True, tuple(remarks))
    if doubled:
        remarks.append(f"{doubled} rows have the time of another: the mean counts")
        index = place[index]
    if len(ticks) < 3:
        return Spacing(index, len(ticks), float(ticks[-1] - ticks[0]), remarks=tuple(remarks))
    found = _places(ticks)
    if found is None:
        steps = np.diff(ticks)
        step = float(np.median(steps))
        remarks.append(
            f"times of '{name}' are unequally spaced, by {steps.min():.4g} to {steps.max():.4g}"
        )
        return Spacing(index, len(ticks), step, ticks, np.inf, False, tuple(remarks))
    places, step, jitter = found
    total = int(places[-1]) + 1
    if total > len(ticks):
        remarks.append(f"{total - len(ticks)} samples are missing between the rows, by '{name}'")
    grid = None
    if jitter > EQUAL:
        grid = ticks[0] + step * np.arange(total)
        grid[places] = ticks
        remarks.append(f"times of '{name}' jitter by up to {100 * jitter:.0f} % of {step:.4g}")
    return Spacing(places[index], total, step, grid, jitter, True, tuple(remarks))


def _coarse(sizes: NDArray[np.intp]) -> bool:
    """Whether a clock is coarser than the sampling: each tick has as many rows, but the ends."""
    inner = sizes[1:-1] if len(sizes) > 3 else sizes
    return bool(inner.min() > 1 and inner.max() - inner.min() <= 1)


def _places(ticks: Floats) -> tuple[NDArray[np.intp], float, float] | None:
    """Places on an equally spaced grid, its step, and the largest deviation [step]."""
    each = np.arange(len(ticks))
    steps = np.diff(ticks)
    typical = float(np.median(steps))
    whole = np.maximum(np.round(steps / typical), 1.0)
    for places in (each, np.concatenate(([0.0], np.cumsum(whole)))):
        if places[-1] >= SPARSE * len(ticks):
            return None
        slope, start = np.polyfit(places - places.mean(), ticks - ticks[0], 1)
        off = np.abs(ticks - ticks[0] - start - slope * (places - places.mean())) / slope
        if float(off.max()) < NEAR:
            return places.astype(np.intp), float(slope), float(off.max())
    return None


def _check_restart(table: Table, t: Floats, name: str) -> None:
    """Two records behind one another in a file would be mixed by sorting.

    Raises:
        BadInput: the times begin anew, over times that were there.
    """
    steps = np.diff(t)
    back = np.flatnonzero(steps < -RESTART * np.median(np.abs(steps)))
    if not len(back) or len(back) > len(t) // 20:
        return
    ends = [0, *(back + 1).tolist(), len(t)]
    blocks = sorted((float(t[a:b].min()), float(t[a:b].max())) for a, b in pairwise(ends))
    if any(after[0] <= before[1] for before, after in pairwise(blocks)):
        raise BadInput(
            f"{table.name}: the times '{name}' begin anew in {table.where(int(back[0]) + 1)}: are "
            f"these several records? give each a file of its own, {REMEDY}"
        )
