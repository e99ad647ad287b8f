"""Components of a Gaussian process that have few states, and exact transitions over any step.

A component is a row (kind, amplitude, scale, quality), amplitude being its standard deviation and
scale in the unit of time::

    DECAY       Ornstein-Uhlenbeck, exp(-|t| / scale): a random walk that comes back
    MATERN3     Matern 3/2: has a slope
    MATERN5     Matern 5/2: has a curvature
    OSCILLATOR  x'' + (w / Q) x' + w^2 x = white noise, w = 2 pi / scale, Q > 1/2

All have exact transitions over any step of time (Hartikainen and Sarkka, MLSP 2010; Foreman-Mackey
et al., Astron. J. 154, 2017), so the steps need not be equal.
"""

import math

from numba import njit

from fpt_ros.denoising.offline import Signal

DECAY, MATERN3, MATERN5, OSCILLATOR = 0.0, 1.0, 2.0, 3.0
STATES = {DECAY: 1, MATERN3: 2, MATERN5: 3, OSCILLATOR: 2}


@njit(cache=True)
def size(parts: Signal) -> int:
    """States of a sum of components."""
    d = 0
    for c in range(len(parts)):
        kind = parts[c, 0]
        d += 1 if kind == 0.0 else (3 if kind == 2.0 else 2)
    return d


@njit(cache=True)
def stationary(parts: Signal, P: Signal, first: Signal) -> None:
    """The covariance of the states at rest; ``first``: 1 at the states that are a component."""
    P[:] = 0.0
    first[:] = 0.0
    k = 0
    for c in range(len(parts)):
        kind, power, scale = parts[c, 0], parts[c, 1] ** 2, parts[c, 2]
        first[k] = 1.0
        P[k, k] = power
        if kind == 0.0:
            k += 1
        elif kind == 1.0:
            P[k + 1, k + 1] = power * 3.0 / scale**2
            k += 2
        elif kind == 2.0:
            rate = 5.0 / scale**2
            P[k + 1, k + 1] = power * rate / 3.0
            P[k, k + 2] = P[k + 2, k] = -power * rate / 3.0
            P[k + 2, k + 2] = power * rate**2
            k += 3
        else:
            P[k + 1, k + 1] = power * (2.0 * math.pi / scale) ** 2
            k += 2


@njit(cache=True)
def transition(parts: Signal, dt: float, A: Signal) -> None:
    """The states' transition over ``dt``."""
    A[:] = 0.0
    k = 0
    for c in range(len(parts)):
        kind, scale = parts[c, 0], parts[c, 2]
        if kind == 0.0:
            A[k, k] = math.exp(-dt / scale)
            k += 1
        elif kind == 1.0:
            a = math.sqrt(3.0) / scale
            e = math.exp(-a * dt)
            A[k, k] = (1.0 + a * dt) * e
            A[k, k + 1] = dt * e
            A[k + 1, k] = -a * a * dt * e
            A[k + 1, k + 1] = (1.0 - a * dt) * e
            k += 2
        elif kind == 2.0:
            a = math.sqrt(5.0) / scale
            x = a * dt
            e = math.exp(-x)
            A[k, k] = (1.0 + x + 0.5 * x * x) * e
            A[k, k + 1] = (dt + a * dt * dt) * e
            A[k, k + 2] = 0.5 * dt * dt * e
            A[k + 1, k] = -0.5 * a**3 * dt * dt * e
            A[k + 1, k + 1] = (1.0 + x - x * x) * e
            A[k + 1, k + 2] = (dt - 0.5 * a * dt * dt) * e
            A[k + 2, k] = (0.5 * a**4 * dt * dt - a**3 * dt) * e
            A[k + 2, k + 1] = (a**3 * dt * dt - 3.0 * a * a * dt) * e
            A[k + 2, k + 2] = (1.0 - 2.0 * x + 0.5 * x * x) * e
            k += 3
        else:
            w, quality = 2.0 * math.pi / scale, parts[c, 3]
            decay = 0.5 * w / quality
            ring = w * math.sqrt(max(1.0 - 0.25 / quality**2, 1e-12))
            e = math.exp(-decay * dt)
            cos, sin = math.cos(ring * dt), math.sin(ring * dt) / ring
            A[k, k] = e * (cos + decay * sin)
            A[k, k + 1] = e * sin
            A[k + 1, k] = -e * w * w * sin
            A[k + 1, k + 1] = e * (cos - decay * sin)
            k += 2
