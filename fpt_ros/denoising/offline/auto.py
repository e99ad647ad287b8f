"""``auto``: the risk-based choice among a library of smoothers, each made robust by EM.

Beyond the thesis, in the place of its fuzzy supervisor (section 5.1.1). What the noise is is found
first (:mod:`noise_found`), then all members are fitted and weighed (:mod:`library`). Where what is
left has heavier tails than impulses in normal noise, there is a second look at the samples without
them (:mod:`heavy_tails`). Long records are done in windows that overlap (:mod:`windows`). Where the
steps of time differ, only the Gaussian processes know what to do, and they are all there is.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from fpt_ros.denoising.offline import (
    Found,
    Info,
    Mask,
    Method,
    Record,
    Signal,
    doubts,
    heavy_tails,
    library,
)
from fpt_ros.denoising.offline.gaussian_process import Process
from fpt_ros.denoising.offline.noise_found import Beginning, find
from fpt_ros.parameters import Values

SHORTEST = 16
MANY = 0.075
"""Share of impulses that makes the first look doubtful: all members are tried again."""
SMALL = 0.03
"""Members of less weight are not tried again."""


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


@dataclass(frozen=True)
class Look:
    """What one look found.

    Attributes:
        part: estimate, noise and weights.
        judge: of the members.
        df: degrees of freedom of the estimate.
    """

    part: Part
    judge: library.Judge
    df: float


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
    first = look(y, present, choice, known, step)
    tail = heavy_tail(y, present, first)
    found = first.part if tail is None else without(tail, y, present, first, choice)
    return replace(found, estimate=found.estimate + offset)


def look(
    y: Signal,
    present: Mask,
    choice: library.Choice | None,
    known: tuple[tuple[Process, float], ...],
    step: float | None,
) -> Look:
    """The noise, all members, and what is believed of them; arguments as of :func:`part`."""
    beginning = find(y, present, np.ones(len(y)), known, step)
    white = beginning.process.colour is None
    judge, general, special = library.fit_all(
        y, present, beginning.begin, beginning.process.fit, white, choice
    )
    if judge.was_hidden:
        beginning = beginning.at_level(judge.noise.s)
    varies = np.ndim(beginning.begin.profile) > 0
    if varies:
        general = [*general, special[0]]
    coarse = beginning.step if beginning.begin.sigma < beginning.step else 0.0
    estimate, df, weights, inner = believed(y, present, judge, general, special, varies, coarse)
    process = beginning.process
    if process.colour is not None and process.whole is not None:
        estimate = process.whole + process.colour.trust * (estimate - process.whole)
    return Look(Part(estimate, beginning, judge.noise.p, weights, inner), judge, df)


def heavy_tail(y: Signal, present: Mask, first: Look) -> heavy_tails.Tail | None:
    """The tails of white noise of one level, where they are heavy.

    Rounding and colour have other remedies; where the level varies its profile is late, and what it
    leaves looks like tails.
    """
    beginning = first.part.beginning
    varies = np.ndim(beginning.begin.profile) > 0
    if varies or beginning.step > 0.0 or beginning.process.colour is not None:
        return None
    return heavy_tails.find(y - first.part.estimate, present, first.judge.noise)


def without(
    tail: heavy_tails.Tail,
    y: Signal,
    present: Mask,
    first: Look,
    choice: library.Choice | None,
) -> Part:
    """The mean of the first look and of one at the samples without the tails of their noise."""
    before = first.part
    z = np.where(present, tail.normal(y, before.estimate), y)
    known: tuple[tuple[Process, float], ...] = ()
    if choice is not None or before.impulses < MANY:
        known = before.beginning.process.processes
        choice = library.Choice(
            frozenset(name for name, w in before.general.items() if w > SMALL),
            frozenset(name for name, w in before.weights.items() if w > SMALL),
        )
    second = look(z, present, choice, known, 0.0)
    score = [
        library.PRICE * each.df - 2.0 * tail.log_likelihood(y - each.part.estimate, present)
        for each in (first, second)
    ]
    weight = np.exp((min(score) - np.array(score)) / library.SHARP)
    weight /= weight.sum()

    def mean(of: Callable[[Part], dict[str, float]]) -> dict[str, float]:
        own, other = of(before), of(second.part)
        names = [*own, *(name for name in other if name not in own)]
        return {n: float(weight @ [own.get(n, 0.0), other.get(n, 0.0)]) for n in names}

    return Part(
        np.asarray(weight @ np.array([before.estimate, second.part.estimate])),
        before.beginning,
        before.impulses,
        mean(lambda one: one.weights),
        mean(lambda one: one.general),
    )


def believed(
    y: Signal,
    present: Mask,
    judge: library.Judge,
    general: Sequence[library.Member],
    special: Sequence[library.Member],
    varies: bool,
    coarse: float = 0.0,
) -> tuple[Signal, float, dict[str, float], dict[str, float]]:
    """The mean of the members that are not doubted (:mod:`doubts`).

    Args:
        y: samples, shape (n,).
        present: False where a sample is missing.
        judge: of the members.
        general, special: the members; the record as it is is among the special ones.
        varies: whether the noise varies along the record.
        coarse: step of rounding, unit of y, where other noise is below it; else 0.

    Returns:
        The mean, shape (n,), its degrees of freedom, the weights of the last and the first mean.
    """
    doubt = library.DOUBT if varies else 1.0
    if coarse > 0.0:
        special = [
            member
            for member in special
            if member.name not in (library.STEPS, library.POTTS)
            or not doubts.stairs_of_rounding(member.estimate, coarse)
        ]
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
        np.asarray(estimate),
        float(weight @ [member.df for member in last]),
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
