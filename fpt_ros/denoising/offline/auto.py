"""``auto``: the risk-based choice among a library of smoothers, each made robust by EM.

Beyond the thesis, in the place of its fuzzy supervisor (section 5.1.1). What the noise is is found
first (:mod:`noise_found`), then all members are fitted and weighed (:mod:`library`). Long records
are done in windows that overlap (:mod:`windows`). Where the steps of time differ, only the Gaussian
processes know what to do, and they are all there is.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fpt_ros.denoising.offline import Found, Info, Mask, Method, Record, Signal, doubts, library
from fpt_ros.denoising.offline.gaussian_process import Process
from fpt_ros.denoising.offline.noise_found import Beginning, find
from fpt_ros.parameters import Values

SHORTEST = 16


@dataclass(frozen=True)
class Part:
    """What was found in a record, or in a window of a long one.

    Attributes:
        estimate: shape (n,).
        beginning: the noise.
        impulses: share of the samples.
        weights: of the last mean, by name.
        general: weights of the general smoothers, by name.
    """

    estimate: Signal
    beginning: Beginning
    impulses: float
    weights: dict[str, float]
    general: dict[str, float]


def middle(y: Signal) -> float:
    """The median where it is far from 0, so that a large offset costs no digits; else 0.

    A mean that is not significantly different from 0 is no parameter for the sinusoids.
    """
    found = float(np.median(y))
    return found if abs(found) > 3.0 * float(np.std(y)) else 0.0


def part(
    y: Signal,
    present: Mask,
    choice: library.Choice | None = None,
    known: tuple[tuple[Process, float], ...] = (),
    step: float | None = None,
) -> Part:
    """The weighted mean of the library for one window.

    Args:
        y: samples, shape (n,), missing ones filled.
        present: False where a sample is missing.
        choice: members that are fitted; None: all.
        known: processes found in other windows.
        step: of rounding, where that is known.
    """
    offset = middle(y[present])
    y = y - offset
    beginning = find(y, present, np.ones(len(y)), known, step)
    white = beginning.process.colour is None
    judge, general, special = library.fit_all(
        y, present, beginning.begin, beginning.process.fit, white, choice
    )
    varies = np.ndim(beginning.begin.profile) > 0
    if varies:
        general = [*general, special[0]]
    coarse = beginning.step if beginning.begin.sigma < beginning.step else 0.0
    estimate, weights, inner = believed(y, present, judge, general, special, varies, coarse)
    return Part(
        np.asarray(estimate + offset),
        beginning,
        judge.noise.p,
        weights,
        inner,
    )


def believed(
    y: Signal,
    present: Mask,
    judge: library.Judge,
    general: Sequence[library.Member],
    special: Sequence[library.Member],
    varies: bool,
    coarse: float = 0.0,
) -> tuple[Signal, dict[str, float], dict[str, float]]:
    """The mean of the members that are not doubted (:mod:`doubts`), and the weights of both means.

    Args:
        y: samples, shape (n,).
        present: False where a sample is missing.
        judge: of the members.
        general, special: the members; the record as it is is among the special ones.
        varies: whether the noise varies along the record.
        coarse: step of rounding, unit of y, where other noise is below it; else 0.
    """
    doubt = library.DOUBT if varies else 1.0
    last = [judge.mean("general", general, doubt * library.WIDE), *special]
    weight = judge.weights(last, doubt * library.SHARP)
    while (favourite := last[int(np.argmax(weight))]).name != library.UNCHANGED:
        if doubts.leaves_noise(y, present, judge, favourite):
            break
        last = [member for member in last if member is not favourite]
        weight = judge.weights(last, doubt * library.SHARP)
    estimate = weight @ np.array([member.estimate for member in last])
    stays = len(y) < doubts.SHORT and doubts.hardly_told(y, present, judge, estimate)
    if not varies:  # where the noise changes, its profile is late, and noise looks like a burst
        impulses = present - judge.noise.inlier(y - estimate, present)
        estimate = np.where(doubts.bursts(impulses), y, estimate)
    if coarse > 0.0:
        estimate = np.where(present & doubts.no_rounding(y, estimate, coarse), y, estimate)
    # not finite: a record of two levels, with no noise to weigh by
    if stays or not np.isfinite(estimate).all():
        estimate, weight = y, np.array([m.name == library.UNCHANGED for m in last]) * 1.0
    inner = judge.weights(general, doubt * library.WIDE)
    return (
        estimate,
        {m.name: float(w) for m, w in zip(last, weight, strict=True)},
        {m.name: float(w) for m, w in zip(general, inner, strict=True)},
    )


def _info(weights: dict[str, float], impulses: float) -> Info:
    shares = {name: round(w, 3) for name, w in weights.items() if w > 5e-4}
    return {**shares, "impulses": round(impulses, 4)}


def _uneven(record: Record) -> Found:
    """Gaussian processes alone, which take any steps of time."""
    offset = float(np.mean(record.y[record.present]))
    found = find(record.y - offset, record.present, record.dt)
    fit = found.process.fit
    weights = {library.PROCESS: 1.0}
    return Found(
        fit.estimate + offset, _info(weights, fit.noise.p), weights, found.noise(fit.noise.p)
    )


def _whole(record: Record, values: Values) -> Found:
    from fpt_ros.denoising.offline import windows

    if not record.even:
        return _uneven(record)
    if len(record.y) > windows.LONGEST:
        return windows.smooth(record)
    found = part(record.y, record.present)
    return Found(
        found.estimate,
        _info(found.weights, found.impulses),
        found.weights,
        found.beginning.noise(found.impulses),
    )


def _estimate(y: Signal, present: Mask, values: Values) -> Signal:
    return _whole(Record(y, present, np.ones(len(y))), values).estimate


AUTO = Method((), _estimate, lambda _: SHORTEST, whole=_whole)
