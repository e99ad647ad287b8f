"""Sums of few sweeps, on a constant or on a smooth curve: a core of ``auto``.

Sweeps are what motors are identified with; a tone is one, and so is a chirp over the whole band
(:mod:`sweep_phase`). Greedy: the strongest sweep of the residual is added, and all are fitted again
(:mod:`sweep_fit`), while one lowers n ln(RSS) by 9 ln n and explains a quarter of what is left
above the noise: its phase was chosen among some n^3 / 10.
"""

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d

from fpt_ros.denoising.offline import Sigma, Signal, scale_and_weight
from fpt_ros.denoising.offline.roughness import Roughness
from fpt_ros.denoising.offline.spectral_floor import level
from fpt_ros.denoising.offline.sweep_fit import FEW, STEPS, fit, move, rss_of, slip
from fpt_ros.denoising.offline.sweep_phase import strongest, turns

MOST = 4
"""Sweeps at most: what needs more is no sum of few sweeps."""
BIC = 9.0
"""Least gain of a sweep in units of ln n; in noise alone the strongest has 5 to 6.6."""
HINT = 4.0
"""The same, of its first fit: less is not worth a closer look."""
LEAST = 0.25
"""Least share of the residual's power above the noise that a sweep explains."""
ENOUGH = 1.2
"""Times the noise's power: a residual below has no further sweep."""
SLOWEST = 3.0
"""Turns in the record, below which it is a curve and no sweep."""
FAR = 2.0
"""Median of a residual's size, in units of the noise, beyond which there is no sum of few sweeps:
of normal noise it is 0.67."""
DF = 10.0
"""Degrees of freedom of a sweep: 5, and 5 for the choice of its phase."""
CURVE = (2, 5.0)
"""Order and width of the curve."""
BROAD, SLOW = 16.0, 2
"""Standard deviation of the window of the first curve [samples], and cells that are the curve's."""
TURNS = 2
"""Times that sweeps and curve are fitted in turn in a round."""


def _floor(residual: Signal, sigma: float) -> float:
    """Power of the noise: sweeps that are still in the residual may have hidden how low it is."""
    return float(len(residual) * min(sigma, level(residual)) ** 2)


def find(
    z: Signal,
    phases: NDArray[np.float64],
    most: int,
    weight: Signal,
    sigma: float,
    slow: int = 0,
) -> tuple[Signal, NDArray[np.float64]]:
    """The sum of sweeps, shape (n,), and their phases, shape (k, 3).

    Args:
        z: samples, shape (n,).
        phases: of sweeps to begin with, shape (k, 3).
        most: sweeps up to which more are looked for.
        weight: of each squared residual, shape (n,).
        sigma: of the noise where the weight is 1.
        slow: cells that hold a curve (:func:`sweep_phase.strongest`).
    """
    n, root = len(z), np.sqrt(weight)
    size = 2.0 ** math.frexp(float(np.std(z)))[1]
    z = np.ascontiguousarray(z) / size
    found = phases.copy()
    f = fit(z, root, found, FEW) if len(found) else np.full(n, np.average(z, weights=weight))
    rss = rss_of(z, root, f)
    while len(found) < most and rss > ENOUGH * (floor := _floor(root * (z - f), sigma / size)):
        new = strongest(root * (z - f), slow)
        if turns(new) < SLOWEST:
            break
        more = np.vstack([found, new])
        g = fit(z, root, more, STEPS)
        if n * math.log(rss / max(rss_of(z, root, g), 1e-300)) < HINT * math.log(n):
            break
        if rss_of(z, root, g) > ENOUGH * floor:
            g = move(z, root, more, g)
        if len(more) > 1 and rss_of(z, root, g) > ENOUGH * floor:
            g = slip(z, root, more, g)
        lower = rss_of(z, root, g)
        if lower <= 0.0 or n * math.log(rss / lower) < BIC * math.log(n):
            break
        is_last = rss - lower < LEAST * (rss - floor)
        found, f, rss = more, g, lower
        if is_last:
            break
    return size * f, found


@dataclass
class Sweeps:
    """The core with the memory of its phases: sweeps are looked for in the first round of EM.

    Attributes:
        phases: shape (k, 3).
        is_first: whether the next round is the first.
    """

    phases: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 3)))
    is_first: bool = True

    def smooth(self, z: Signal, sigma: Sigma) -> tuple[Signal, float]:
        """The sum, shape (n,), and its degrees of freedom."""
        typical, weight = scale_and_weight(sigma, len(z))
        f, self.phases = find(z, self.phases, self._most(), weight, typical)
        rest = np.sqrt(weight) * (z - f)
        if self.is_first and float(np.median(np.abs(rest))) > FAR * min(typical, level(rest)):
            self.phases = np.empty((0, 3))
            f = np.full(len(z), np.average(z, weights=weight))
        self.is_first = False
        return f, 1.0 + DF * len(self.phases)

    def _most(self) -> int:
        return MOST if self.is_first else 0


@dataclass
class OnCurve(Sweeps):
    """Sweeps on a smooth curve, which are fitted in turn.

    Attributes:
        curve: the smoother.
        last: its latest curve, shape (n,).
    """

    curve: Roughness = field(default_factory=lambda: Roughness(*CURVE))
    last: Signal = field(default_factory=lambda: np.empty(0))

    def smooth(self, z: Signal, sigma: Sigma) -> tuple[Signal, float]:
        """The sum of both, shape (n,), and its degrees of freedom."""
        typical, weight = scale_and_weight(sigma, len(z))
        root, df = np.sqrt(weight), 0.0
        if self.is_first:
            self.last = gaussian_filter1d(z, BROAD, mode="reflect")
        for _ in range(TURNS):
            f, self.phases = find(z - self.last, self.phases, self._most(), weight, typical, SLOW)
            if not len(self.phases):
                break
            noise = min(typical, level(root * (z - f)))
            self.last, df = self.curve.smooth(z - f, noise / root)
        self.is_first = False
        return f + self.last, df + DF * len(self.phases)
