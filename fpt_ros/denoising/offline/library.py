"""The members of ``auto``, and their judge.

All are fitted by the same EM that separates impulses (:mod:`mixture`), under the noise that was
found (:mod:`noise_found`):

* general smoothers: splines and oscillators whose stiffness and frequency vary along the signal
  (:mod:`roughness`), of several orders and widths; wavelets (:mod:`ebayes`);
* special ones: piecewise constant (:mod:`potts`, :mod:`steps`), sums of sinusoids
  (:mod:`sinusoids`) and of sweeps (:mod:`sweeps`), Gaussian processes (:mod:`process_member`),
  and the record as it is.

Under one mixture for all, the medians of theirs, each has the score::

    score = -2 log likelihood + 3 df

and means have the weights exp(-score / T). First the general ones are averaged, T = 8: their
errors differ, and a mean is better than any. Then that mean and the special ones, T = 2, as
posterior probabilities: where a signal is of their kind, they are far better than the mean, else
far worse. Where the noise varies the process is in both means, and T is 4 times as great. A mean
costs the extra degrees of freedom 2 sum var / (T s^2), var being that of its members at each
sample. The constants were chosen on seeds 0-9 of the noise of the figures.

The record as it is has chosen nothing: its df = n cost 2 each, which is Stein's risk. So no model
that explains more than it may by impulses can win against it.

EM ends in the nearest of several optima, so general smoothers begin from several states: the record
without what Hampel calls impulses, which keeps narrow peaks but leaves some impulses in; the same
after a spline of one stiffness, which leaves none in but cuts peaks; the same after stairs, or
after a smoother of narrow peaks, for the wavelet of jumps: a spline is far from the samples beside
a jump, which then pass for impulses; and the record as it is, for oscillations so fast that Hampel
flattens them.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from fpt_ros.denoising.offline import (
    Mask,
    Signal,
    ebayes,
    mixture,
    potts,
    roughness,
    sinusoids,
    steps,
    sweeps,
)
from fpt_ros.denoising.offline.whiteness import is_white

UNCHANGED, PROCESS, STEPS, POTTS = "unchanged", "process", "steps", "potts"
TONES, SWEEPS, ON_CURVE = "sinusoids", "sweeps", "sweeps on a curve"
PRICE = 3.0
"""Of a degree of freedom, in units of -2 log likelihood."""
WIDE, SHARP = 8.0, 2.0
"""Temperatures T of the two means."""
DOUBT = 4.0
"""By which both rise where the noise varies: its profile is an estimate, scores are less sure."""

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
WAVELETS = {"haar": "haar", "sym8": "sym8", "stairs-haar": "haar", "peaks-haar": "haar"}
"""By name: for many jumps, and for what no other describes."""
FROM_STAIRS, FROM_PEAKS, PEAKS = "stairs-haar", "peaks-haar", "hampel-2-3-None"
"""Those that begin from stairs, and from a smoother that lets narrow peaks be; and that smoother's
name."""

QUIETER = 0.8
"""Share of the noise that was found, below which what sweeps leave is the noise: they had hidden
how low it is."""
RARER = 0.5
"""The same of the share of impulses: what no other member explains looks like them."""
STEP_DF = 3.0
"""Least degrees of freedom per segment of ``steps``: those of its derivative vanish where the noise
is finer than its grid of levels."""


@dataclass(frozen=True)
class Member:
    """An estimate of the library, with its degrees of freedom."""

    name: str
    estimate: Signal
    df: float


@dataclass(frozen=True)
class Choice:
    """Which members are fitted, where not all are: those of :func:`names`."""

    general: frozenset[str]
    special: frozenset[str]


@dataclass(frozen=True)
class Judge:
    """Scores members under one mixture.

    ``was_hidden``: that of sweeps, which had hidden it from all others.
    """

    y: Signal
    present: Mask
    noise: mixture.Noise
    was_hidden: bool = False

    def mean(self, name: str, members: Sequence[Member], temperature: float) -> Member:
        """The weighted mean of ``members``."""
        weight = self.weights(members, temperature)
        estimates = np.array([member.estimate for member in members])
        mean = weight @ estimates
        spread = float(np.sum(weight @ ((estimates - mean) / self.noise.sigma) ** 2))
        df = float(weight @ [member.df for member in members])
        return Member(name, mean, df + 2.0 * spread / temperature)

    def weights(self, members: Sequence[Member], temperature: float) -> Signal:
        """Weights exp(-score / T), of sum 1."""
        score = np.array([self.score(member) for member in members])
        weight = np.exp(-(score - score.min()) / temperature)
        return np.asarray(weight / weight.sum())

    def score(self, member: Member) -> float:
        """-2 log likelihood + 3 df; the record as it is has chosen nothing, and sees no impulse."""
        if member.name == UNCHANGED:
            sigma = np.broadcast_to(self.noise.sigma, self.y.shape)[self.present]
            return 2.0 * member.df + float(np.sum(np.log(2.0 * math.pi * sigma**2)))
        r = self.y - member.estimate
        return PRICE * member.df - 2.0 * self.noise.log_likelihood(r, self.present)


def _fits(
    y: Signal,
    present: Mask,
    begin: mixture.Start,
    choice: Choice | None,
    constant: mixture.Fit | None,
) -> dict[str, mixture.Fit]:
    """The fits of the general smoothers by their names, that of the spline first."""
    rounds = mixture.ROUNDS if choice is None else mixture.FEW_ROUNDS

    def fit(shape: Shape, z: Signal) -> mixture.Fit:
        return mixture.fit(y, present, roughness.Roughness(*shape).smooth, begin, z, rounds)

    spline = fit(SPLINE, begin.z)
    found = {"spline": spline}
    starts = (("spline", FROM_SPLINE, spline.z), ("hampel", FROM_HAMPEL, begin.z),
              ("record", FROM_RECORD, y))  # fmt: skip
    for start, shapes, z in starts:
        for order, width, pitch in shapes:
            name = f"{start}-{order}-{width:g}-{pitch}"
            if choice is None or name in choice.general:
                found[name] = fit((order, width, pitch), z)
    begins = {"haar": spline.z, "sym8": spline.z}
    if constant is not None and not begin.sigma < begin.step:  # rounding makes stairs of slopes
        begins[FROM_STAIRS] = constant.z
        begins[FROM_PEAKS] = found[PEAKS].z if PEAKS in found else begin.z
    for name, z in begins.items():
        if choice is None or name in choice.general:
            core = partial(ebayes.shrink, wavelet=WAVELETS[name])
            found[name] = mixture.fit(y, present, core, begin, z, mixture.FEW_ROUNDS)
    return found


def _member(name: str, fit: mixture.Fit) -> Member:
    return Member(name, fit.estimate, fit.df)


def fit_all(
    y: Signal,
    present: Mask,
    begin: mixture.Start,
    process: mixture.Fit,
    white: bool,
    choice: Choice | None = None,
) -> tuple[Judge, list[Member], list[Member]]:
    """The judge, the general smoothers, and the special ones, all fitted to ``y``.

    Args:
        y: samples, shape (n,).
        present: False where a sample is missing.
        begin: the noise that was found.
        process: the fit of the Gaussian processes.
        white: whether its mixture is that of white noise.
        choice: members that are fitted; None: all.
    """
    stairs = choice is None or bool(choice.special & {STEPS, POTTS})
    constant = None
    if choice is None or stairs or choice.general & {FROM_STAIRS, FROM_PEAKS}:
        levels = potts.robust_start(y, begin.sigma)
        constant = mixture.fit(y, present, potts.smooth, begin, levels)
    named = _fits(y, present, begin, choice, constant)
    fits = list(named.values())
    special = [_member(PROCESS, process), Member(UNCHANGED, y, float(present.sum()))]
    if white:
        fits.append(process)
    if stairs and constant is not None:
        fits.append(constant)
    tones = []
    rounded = begin.sigma < begin.step
    if choice is None or TONES in choice.special:
        tones = [
            mixture.fit(y, present, sinusoids.Tones(enough=rounded).smooth, begin, z)
            for z in (begin.z, named["spline"].z)
        ]
        fits += tones
    swept: dict[str, mixture.Fit] = {}
    if choice is None or choice.special & {SWEEPS, ON_CURVE}:
        swept = _swept(y, present, begin)
    noises = [(f.noise.p, f.noise.s, f.noise.t, f.noise.m) for f in fits]
    p, s, t, m = (float(x) for x in np.median(noises, axis=0))
    judge = Judge(y, present, mixture.Noise(p, s, t, m, begin.profile))
    if stairs and constant is not None:
        jumps = int(np.count_nonzero(np.diff(constant.estimate)))
        mean, df = steps.smooth(y, present, constant.noise, jumps)
        special += [_member(POTTS, constant), Member(STEPS, mean, max(df, STEP_DF * (jumps + 1)))]
    if tones:
        special.append(min((_member(TONES, fit) for fit in tones), key=judge.score))
    general = [_member(name, fit) for name, fit in named.items()]
    special += [_member(name, fit) for name, fit in swept.items()]
    if swept:
        name, fit = list(swept.items())[-1]
        judge = _quieter(judge, [*general, *special], name, fit)
    return judge, general, special


def _swept(y: Signal, present: Mask, begin: mixture.Start) -> dict[str, mixture.Fit]:
    """Sweeps and, where they leave more than noise, sweeps on a curve; empty: there are none."""
    found: dict[str, mixture.Fit] = {}
    for name, core in ((SWEEPS, sweeps.Sweeps()), (ON_CURVE, sweeps.OnCurve())):
        fit = mixture.fit(y, present, core.smooth, begin, y)
        if not len(core.phases):
            continue
        own = begin.level(fit.z - fit.estimate, present)
        if own < QUIETER * begin.sigma:
            fit = mixture.fit(y, present, core.smooth, replace(begin, sigma=own), fit.z)
        found[name] = fit
        if is_white((y - fit.estimate) / fit.noise.sigma, present):
            break
    return found


def _quieter(judge: Judge, members: Sequence[Member], name: str, fit: mixture.Fit) -> Judge:
    """The judge of sweeps that had hidden how low the noise is, or looked like impulses.

    Where they are the best by their own noise; else the judge as it is.
    """
    other = replace(judge, noise=fit.noise, was_hidden=True)
    hidden = fit.noise.s < QUIETER * judge.noise.s or fit.noise.p < RARER * judge.noise.p
    return other if hidden and min(members, key=other.score).name == name else judge
