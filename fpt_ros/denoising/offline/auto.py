"""``auto``: the risk-based choice among a library of smoothers, each made robust by EM.

Beyond the thesis, in the place of its fuzzy supervisor (section 5.1.1). Signals differ in kind, so
all of these are fitted, by the same EM that separates impulses (:mod:`mixture`):

* general smoothers: undecimated wavelets with neighbour shrinkage (:mod:`undecimated`), Whittaker
  smoothers of order 2 and 3 with one penalty and with a local one (:mod:`whittaker`);
* special ones: piecewise constant (:mod:`potts`, :mod:`steps`), sums of sinusoids
  (:mod:`sinusoids`).

Under one mixture for all, the medians of theirs, each has the score::

    score = -2 log likelihood + 3 df

and means have the weights exp(-score / T). First the general ones are averaged, T = 12: their
errors differ, and a mean is better than any. That mean is the pilot of empirical Wiener filters,
averaged with T = 24. Last come the special ones, T = 4: where a signal is of their kind, they
are far better, and should not be diluted. A mean costs the extra degrees of freedom
2 sum var / (T s^2), var being that of its members at each sample. All constants were chosen on
seeds 0-9 of the noise of the figures.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from fpt_ros.denoising.offline import (
    Info,
    Mask,
    Method,
    Signal,
    mixture,
    potts,
    sinusoids,
    steps,
    whittaker,
)
from fpt_ros.denoising.offline import undecimated as wavelets
from fpt_ros.parameters import Values

PRICE = 3.0
"""Of a degree of freedom, in units of -2 log likelihood."""
WIDE, WIDER, SHARP = 12.0, 24.0, 4.0
"""Temperatures T of the three means."""

WAVELETS = ("haar", "sym4", "sym8", "db10")
UNCLEANED = ("sym8", "db10")
"""Wavelets tried without the removal of impulses first, which fast oscillations do not survive."""
WIENER = ("sym4", "sym8", "db10")
WIENER_ROUNDS = 3
WAVELET_DF = 1.5
"""Degrees of freedom for the choice of a neighbourhood and a threshold, per level."""

STEP_DF = 2.5
"""Degrees of freedom per segment of ``steps`` beside those of its derivative."""

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


def _wavelet(z: Signal, sigma: float, name: str) -> tuple[Signal, float]:
    f, df = wavelets.shrink(z, sigma, name)
    return f, df + WAVELET_DF * wavelets.depth(len(z))


def _member(name: str, fit: mixture.Fit) -> Member:
    return Member(name, fit.estimate, fit.df)


def library(y: Signal, present: Mask) -> tuple[Judge, list[Member], list[Member]]:
    """The judge, the general smoothers, and the special ones, all fitted to ``y``."""
    begin = mixture.start(y, present)
    fits: dict[str, mixture.Fit] = {}
    for order in (2, 3):
        core = partial(whittaker.smooth, order=order)
        fits[f"whittaker{order}"] = mixture.fit(y, present, core, begin)
        core = partial(whittaker.smooth_locally, order=order)
        fits[f"local whittaker{order}"] = mixture.fit(y, present, core, begin)
    spline = fits["whittaker2"].z
    for name in WAVELETS:
        fits[name] = mixture.fit(y, present, partial(_wavelet, name=name), begin)
        fits[f"{name} after spline"] = mixture.fit(
            y, present, partial(_wavelet, name=name), begin, spline
        )
    general = [_member(name, fit) for name, fit in fits.items()]
    for name in UNCLEANED:
        fit = mixture.fit(y, present, partial(_wavelet, name=name), begin, y)
        general.append(_member(f"{name} uncleaned", fit))
    fits["potts"] = mixture.fit(y, present, potts.smooth, begin, potts.robust_start(y, begin.sigma))
    fits["sinusoids"] = mixture.fit(y, present, sinusoids.Tones().smooth, begin)
    constant = fits["potts"]
    jumps = int(np.count_nonzero(np.diff(constant.estimate)))
    mean, df = steps.smooth(y, present, constant.noise, jumps)
    special = [
        _member("potts", constant),
        Member("steps", mean, df + STEP_DF * (jumps + 1)),
        _member("sinusoids", fits["sinusoids"]),
    ]
    p, s, t = np.median([(f.noise.p, f.noise.s, f.noise.t) for f in fits.values()], axis=0)
    return Judge(y, present, mixture.Noise(float(p), float(s), float(t))), general, special


def refine(judge: Judge, pilot: Member) -> Member:
    """``pilot`` and its empirical Wiener filters, averaged."""
    first, filters = pilot, [pilot]
    for _ in range(WIENER_ROUNDS):
        r = judge.y - first.estimate
        z = first.estimate + judge.noise.inlier(r, judge.present) * r
        filters = [
            Member(name, *wavelets.wiener(z, judge.noise.s, first.estimate, name))
            for name in WIENER
        ]
        first = judge.mean("wiener", filters, WIDE)
    return judge.mean("general", [pilot, *filters], WIDER)


def supervise(y: Signal, present: Mask, values: Values) -> tuple[Signal, Info]:
    """The weighted mean of the library, and what had which weight."""
    if len(y) > LONGEST:
        return _in_pieces(y, present, values), {"pieces": len(_pieces(len(y)))}
    middle = _middle(y[present])
    y = y - middle
    judge, general, special = library(y, present)
    pilot = judge.mean("general", general, WIDE)
    last = [refine(judge, pilot), *special]
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
