"""Smoother whose stiffness, and whose own frequency, vary along the signal: a core of ``auto``.

::

    z = f + N(0, sigma^2),    (L f)_i ~ N(0, q_i),    f = (I + L' diag(sigma^2 / q) L)^-1 z

L is a difference of order d (the spline), or such a one of the oscillator f_i-1 - c_i f_i + f_i+1,
that is 0 for a sinusoid of 2 cos(omega) = c: the time-varying autoregression of Kitagawa and Gersch
(IEEE Trans. Automatic Control 30, 1985). Everything is estimated from the same data. The variances
q by MacKay's fixed point of the marginal likelihood (Neural Computation 4, 1992)::

    q = sum (L f)_i^2 / sum g_i,    g_i = 1 - sigma^2 (L A^-1 L')_ii / q_i

g_i being how far the data determine (L f)_i, A the matrix above; and c by least squares of
u_i-1 + u_i+1 on u_i, u = D^d f; both in Gaussian windows. A wide window gives the spline of one
penalty; a narrow one lets a line, a corner or a jump be rough and the rest smooth.
"""

from dataclasses import dataclass, field

import numpy as np
from scipy.ndimage import gaussian_filter1d

from fpt_ros.denoising.offline import Sigma, Signal, scale_and_weight
from fpt_ros.denoising.offline.banded import solve

FIRST, MORE = 8, 2
"""Fixed point steps of the first call, and of the others, which begin where the last ended."""
START = 1e-3
LEAST, MOST = 1e-11, 1e15
"""q in units of sigma^2: at the start, and its bounds. Below the least f has too few digits; the
most is what a jump has in the faintest noise."""
CHOICE, LOCAL = 4.0, 0.03
"""Degrees of freedom for the choice of q: in all, and per window of ``width`` samples."""
PITCH = 0.14
"""The same for the choice of c, per window of ``pitch`` samples. The three were fitted to the true
losses of such estimates in known noise: half a degree of freedom per independent window."""


def _mean(x: Signal, width: float) -> Signal:
    return np.asarray(gaussian_filter1d(x, width, mode="reflect"))


@dataclass
class Roughness:
    """The core with the memory of q and c, so that every round of EM begins with the last's.

    Attributes:
        order: d of the differences.
        width: standard deviation of the window of q [samples].
        pitch: the same of c; None: L has no oscillator.
        ratio: q / sigma^2, shape (n - taps + 1,).
        c: 2 cos(omega), the same shape.
    """

    order: int
    width: float
    pitch: float | None = None
    ratio: Signal = field(default_factory=lambda: np.empty(0))
    c: Signal = field(default_factory=lambda: np.empty(0))

    def smooth(self, z: Signal, sigma: Sigma) -> tuple[Signal, float]:
        """The smooth curve, shape (n,), and its degrees of freedom."""
        n, z = len(z), np.ascontiguousarray(z)
        if np.max(sigma) <= 0.0:
            return z, float(n)
        sigma, weight = scale_and_weight(sigma, n)
        size = n - self.order - (0 if self.pitch is None else 2)
        steps = MORE
        if len(self.ratio) != size:
            self.ratio, self.c, steps = np.full(size, START), np.full(size, 2.0), FIRST
        for _ in range(steps):
            f, rough, doubt, _ = solve(z, 1.0 / self.ratio, self._rows(), weight)
            known = np.maximum(1.0 - doubt / self.ratio, 1e-6)
            square = _mean((rough / sigma) ** 2, self.width)
            self.ratio = np.clip(square / _mean(known, self.width), LEAST, MOST)
            if self.pitch is not None:
                u = np.diff(f, self.order)
                bend = _mean(np.diff(u, 2) * u[1:-1], self.pitch)
                power = _mean(u[1:-1] ** 2, self.pitch)
                self.c = np.clip(2.0 + bend / np.maximum(power, 1e-300), -2.0, 2.0)
        f, _, _, trace = solve(z, 1.0 / self.ratio, self._rows(), weight)
        df = trace + 1.0 + CHOICE + LOCAL * n / self.width
        return f, df if self.pitch is None else df + PITCH * n / self.pitch

    def _rows(self) -> Signal:
        """Taps of L."""
        taps = np.ones((len(self.ratio), 1))
        if self.pitch is not None:
            taps = np.stack((taps[:, 0], -self.c, taps[:, 0]), axis=1)
        for _ in range(self.order):
            wide = np.zeros((len(taps), taps.shape[1] + 1))  # np.pad takes ten times as long
            wide[:, 1:] = taps
            wide[:, :-1] -= taps
            taps = wide
        return np.ascontiguousarray(taps)
