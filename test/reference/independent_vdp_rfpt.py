"""The fifth order van der Pol of section 2.3 a second time, from the description alone.

Nothing here comes from the package. Everything of cycle n is formed at the values of cycle n and
the tuning uses the acceleration itself, not a difference of measured velocities.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

EXACT = (10.0, 1.0, 3.0, 100.0, 1.0, 2.0)
INITIAL = (9.0, 2.0, 7.0, 110.0, 0.9, 1.5)
CONTROL_POINTS = [c / 70.0 for c in (0, 30, 60, 20, -40, -70, -30, 10, 50, 40, -20, -50)]
LAMBDA = 10.0
A, B, K = 1e-6, 1.0, -1e5


@dataclass
class Record:
    """One row a cycle; theta is the estimate the force of the cycle was formed with."""

    q: Array
    r: Array
    force: Array
    theta: Array
    error: Array


def disturbance(t: float) -> float:
    """Uniform periodic cubic B-spline of unit amplitude."""
    i = int(np.floor(t))
    s = t - i
    c0, c1, c2, c3 = (CONTROL_POINTS[(i + k) % 12] for k in range(4))
    return (
        (1 - s) ** 3 * c0
        + (3 * s**3 - 6 * s**2 + 4) * c1
        + (-3 * s**3 + 3 * s**2 + 3 * s + 1) * c2
        + s**3 * c3
    ) / 6.0


def simulate(
    *,
    rfpt: bool,
    alpha: float | None,
    amplitude: float,
    duration: float,
    dt: float = 1e-3,
) -> Record:
    """Run the loop; alpha None: the model stays as it is."""
    cycles = round(duration / dt)
    record = Record(*(np.zeros((cycles, n)) for n in (1, 1, 1, 6, 1)))
    theta = np.array(INITIAL)
    q = v = r = response = 0.0
    for n in range(cycles):
        t = n * dt
        e = 1.5 * np.sin(2 * t) - q
        de = 3.0 * np.cos(2 * t) - v
        desired = -6.0 * np.sin(2 * t) + LAMBDA**2 * e + 2 * LAMBDA * de
        if n == 0 or not rfpt:
            r = desired
        else:
            x = A * (response - desired)
            r = (r + K) * (1 + B * x / (1 + abs(x))) - K

        def terms(acceleration: float, q: float = q, v: float = v) -> Array:
            return np.array([acceleration, q * q * v, -v, q, q**3, q**5])

        force = float(terms(r) @ theta)
        m, mu, muc, k, beta, lam = EXACT
        inner = mu * q * q * v - muc * v + k * q + beta * q**3 + lam * q**5
        response = (force + amplitude * disturbance(t) - inner) / m
        record.q[n], record.r[n], record.force[n] = q, r, force
        record.theta[n], record.error[n] = theta, e
        if alpha is not None:
            y = terms(response)
            known = theta[0] * (r - response)
            theta = theta + dt * alpha * known * y / (y @ y + 1e-6)
        q, v = q + dt * v, v + dt * response
    return record
