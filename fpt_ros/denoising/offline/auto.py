"""``auto``: the risk-based choice among a library of smoothers, each made robust by EM.

Beyond the thesis, in the place of its fuzzy supervisor (section 5.1.1). Signals differ in kind, so
all of these are fitted, by the same EM that separates impulses (:mod:`mixture`):

* general smoothers: splines and oscillators whose stiffness and frequency vary along the signal
  (:mod:`roughness`), of several orders and widths;
* special ones: piecewise constant (:mod:`potts`, :mod:`steps`), sums of sinusoids
  (:mod:`sinusoids`).

Under one mixture for all, the medians of theirs, each has the score::

    score = -2 log likelihood + 3 df

and means have the weights exp(-score / T). First the general ones are averaged, T = 8: their
errors differ, and a mean is better than any. Then that mean and the special ones, T = 2, as
posterior probabilities: where a signal is of their kind, they are far better than the mean, else
far worse. A mean costs the extra degrees of freedom 2 sum var / (T s^2), var being that of its
members at each sample. All constants were chosen on seeds 0-9 of the noise of the figures.

EM ends in the nearest of several optima, so general smoothers begin from several states: the record
without what Hampel calls impulses, which keeps narrow peaks but leaves some impulses in; the same
after a spline of one stiffness, which leaves none in but cuts peaks; and the record as it is, for
oscillations so fast that Hampel flattens them.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from fpt_ros.denoising.offline import (
    Info,
    Mask,
    Method,
    Signal,
    mixture,
    potts,
    process_member,
    quantisation,
    roughness,
    sinusoids,
    spectral_floor,
    steps,
)
from fpt_ros.parameters import Values

PRICE = 3.0
"""Of a degree of freedom, in units of -2 log likelihood."""
WIDE, SHARP = 8.0, 2.0
"""Temperatures T of the two means."""

Shape = tuple[int, float, float | None]
"""Order, width and pitch of a general smoother (:class:`roughness.Roughness`)."""

SPLINE: Shape = (3, 40.0, None)
"""The robust one that others begin from: in so wide a window no impulse makes a rough spot."""
FROM_HAMPEL: tuple[Shape, ...] = ((2, 3.0, None), (3, 3.0, None), (0, 10.0, 10.0))
"""For narrow peaks."""
FROM_SPLINE: tuple[Shape, ...] = (
    (2, 10.0, None),
    (3, 3.0, None),
    (3, 10.0, None),
    (4, 5.0, None),
    (0, 10.0, 10.0),
    (0, 20.0, 20.0),
    (0, 20.0, 40.0),
    (1, 10.0, 10.0),
)
"""Splines for trends, lines, corners and jumps; oscillators for one local frequency, about 0 or
about a level that wanders."""
FROM_RECORD: tuple[Shape, ...] = ((0, 10.0, 10.0),)
"""For fast oscillations."""

STEP_DF = 3.0
"""Least degrees of freedom per segment of ``steps``: those of its derivative vanish where the noise
is finer than its grid of levels."""

SHORTEST = 16
LONGEST, PIECE, OVERLAP = 16384, 8192, 1024
"""Records above ``LONGEST`` are done in pieces, whose overlaps are cross-faded [samples]."""


@dataclass(frozen=True)
class Member:
    """An estimate of the library, with its degrees of freedom."""

    name: str
    estimate: Signal
    df: float


@dataclass(frozen=True)
class Judge:
    """Scores members under one mixture."""

    y: Signal
    present: Mask
    noise: mixture.Noise

    def mean(self, name: str, members: Sequence[Member], temperature: float) -> Member:
        """The weighted mean of ``members``."""
        weight = self.weights(members, temperature)
        estimates = np.array([member.estimate for member in members])
        mean = weight @ estimates
        spread = float(np.sum(weight @ (estimates - mean) ** 2))
        df = float(weight @ [member.df for member in members])
        return Member(name, mean, df + 2.0 * spread / (temperature * self.noise.s**2))

    def weights(self, members: Sequence[Member], temperature: float) -> Signal:
        """Weights exp(-score / T), of sum 1."""
        score = np.array([self.score(member) for member in members])
        weight = np.exp(-(score - score.min()) / temperature)
        return np.asarray(weight / weight.sum())

    def score(self, member: Member) -> float:
        """-2 log likelihood + 3 df."""
        r = self.y - member.estimate
        return PRICE * member.df - 2.0 * self.noise.log_likelihood(r, self.present)


def _general(y: Signal, present: Mask, begin: mixture.Start) -> list[mixture.Fit]:
    """The fits of the general smoothers, that of the spline first."""

    def fit(shape: Shape, z: Signal) -> mixture.Fit:
        return mixture.fit(y, present, roughness.Roughness(*shape).smooth, begin, z)

    spline = fit(SPLINE, begin.z)
    return [
        spline,
        *(fit(shape, spline.z) for shape in FROM_SPLINE),
        *(fit(shape, begin.z) for shape in FROM_HAMPEL),
        *(fit(shape, y) for shape in FROM_RECORD),
    ]


def _member(name: str, fit: mixture.Fit) -> Member:
    return Member(name, fit.estimate, fit.df)


def library(y: Signal, present: Mask) -> tuple[Judge, list[Member], list[Member]]:
    """The judge, the general smoothers, and the special ones, all fitted to ``y``."""
    step = quantisation.least_step(y, present)
    begin = mixture.start(y, present, quantisation.floor(step))
    shape = spectral_floor.profile(begin.z, present, begin.least)
    if shape.max() > shape.min():
        begin = mixture.varying(y, present, begin, shape)
    coarse = begin.sigma < 2.0 * step
    process = process_member.smooth(y, present, begin, np.ones(len(y)), not coarse)
    if process.colour is not None:
        c, sigma = process.colour.coefficient, process.colour.sigma
        low = math.hypot(process.fit.noise.s, sigma * math.sqrt((1.0 + c) / (1.0 - c)))
        inflation = max(1.0, low / begin.sigma)
        begin = replace(begin, sigma=begin.sigma * inflation, inflation=inflation)
    general = _general(y, present, begin)
    levels = potts.robust_start(y, begin.sigma)
    constant = mixture.fit(y, present, potts.smooth, begin, levels)
    tones = [
        mixture.fit(y, present, sinusoids.Tones().smooth, begin, z) for z in (begin.z, general[0].z)
    ]
    fits = [*general, constant, *tones, *([] if process.colour else [process.fit])]
    noises = [(f.noise.p, f.noise.s, f.noise.t, f.noise.m) for f in fits]
    p, s, t, m = (float(x) for x in np.median(noises, axis=0))
    judge = Judge(y, present, mixture.Noise(p, s, t, m, begin.profile))
    jumps = int(np.count_nonzero(np.diff(constant.estimate)))
    mean, df = steps.smooth(y, present, constant.noise, jumps)
    special = [
        _member("potts", constant),
        Member("steps", mean, max(df, STEP_DF * (jumps + 1))),
        min((_member("sinusoids", fit) for fit in tones), key=judge.score),
        _member("process", process.fit),
        Member("unchanged", y, float(present.sum())),
    ]
    return judge, [_member("general", fit) for fit in general], special


def supervise(y: Signal, present: Mask, values: Values) -> tuple[Signal, Info]:
    """The weighted mean of the library, and what had which weight."""
    if len(y) > LONGEST:
        return _in_pieces(y, present, values), {"pieces": len(_pieces(len(y)))}
    middle = _middle(y[present])
    y = y - middle
    judge, general, special = library(y, present)
    last = [judge.mean("general", general, WIDE), *special]
    weight = judge.weights(last, SHARP)
    estimate = weight @ np.array([member.estimate for member in last])
    shares = {m.name: round(float(w), 3) for m, w in zip(last, weight, strict=True) if w > 5e-4}
    noise = {"impulses": round(judge.noise.p, 4)}
    return np.asarray(estimate + middle), {**shares, **noise}


def _middle(y: Signal) -> float:
    """The median where it is far from 0, so that a large offset costs no digits; else 0.

    A mean that is not significantly different from 0 is no parameter for the sinusoids.
    """
    middle = float(np.median(y))
    return middle if abs(middle) > 3.0 * float(np.std(y)) else 0.0


def _pieces(n: int) -> list[tuple[int, int]]:
    """First and last + 1 index of pieces of equal length, ``OVERLAP`` samples in common."""
    count = -(-(n - OVERLAP) // (PIECE - OVERLAP))
    first = np.linspace(0, n - PIECE, count).round().astype(int)
    return [(int(a), int(a) + PIECE) for a in first]


def _in_pieces(y: Signal, present: Mask, values: Values) -> Signal:
    total, weight = np.zeros(len(y)), np.zeros(len(y))
    for a, b in _pieces(len(y)):
        ramp = np.minimum(np.arange(1, b - a + 1), np.arange(b - a, 0, -1))
        fade = np.minimum(ramp / OVERLAP, 1.0)
        here = present[a:b]
        estimate = supervise(y[a:b], here, values)[0] if here.sum() >= SHORTEST else y[a:b]
        total[a:b] += fade * estimate
        weight[a:b] += fade
    return np.asarray(total / weight)


def _estimate(y: Signal, present: Mask, values: Values) -> Signal:
    return supervise(y, present, values)[0]


AUTO = Method((), _estimate, lambda _: SHORTEST, supervise)
