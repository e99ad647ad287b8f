"""The fifth order van der Pol of section 2.2.1 a second time, from the description alone.

P of the Lyapunov equation is solved for, and the disturbance is a spline of scipy's.
"""

from __future__ import annotations

import numpy as np
from independent_report import report
from scipy.interpolate import BSpline

SETTLE = 5.0
NAMES = ("q1",)
EXACT = np.array([10.0, 1.0, 3.0, 100.0, 1.0, 2.0])  # m, mu, mu c, k, beta, lambda
INITIAL = np.array([9.0, 2.0, 7.0, 110.0, 0.9, 1.5])
LAMBDA = 10.0
POINTS = np.array([0, 30, 60, 20, -40, -70, -30, 10, 50, 40, -20, -50]) / 70.0

# tuned, amplitude of the disturbance, initial q and q'
VARIANTS = {
    "adaptive": (True, 0.0, 0.0, 0.0),
    "fixed": (False, 0.0, 0.0, 0.0),
    "disturbed": (True, 50.0, 0.0, 0.0),
    "fixed_disturbed": (False, 50.0, 0.0, 0.0),
    "offset": (True, 0.0, 1.0, 3.0),
}


def disturbance(t):
    """Periodic uniform cubic spline of unit amplitude, at all times at once."""
    spline = BSpline(np.arange(-3.0, 16.0), np.concatenate([POINTS, POINTS[:3]]), 3)
    return spline(np.mod(t, 12.0))


def lyapunov():
    """P of A'P + PA = -100 I, as one linear system for the four elements."""
    a = np.array([[0.0, 1.0], [-(LAMBDA**2), -2.0 * LAMBDA]])
    eye = np.eye(2)
    system = np.kron(a.T, eye) + np.kron(eye, a.T)
    return np.linalg.solve(system, -100.0 * eye.ravel()).reshape(2, 2)


def nominal(t):
    return 1.5 * np.sin(2 * t), 3.0 * np.cos(2 * t), -6.0 * np.sin(2 * t)


def terms(acceleration, q, v):
    return np.array([acceleration, q * q * v, -v, q, q**3, q**5])


def response_of(force, push, q, v):
    """The one unknown of Y Theta = F + d."""
    return (force + push - terms(0.0, q, v) @ EXACT) / EXACT[0]


def run(variant, duration=None, *, dt=1e-3, R=5.0, amplitude=None):
    """One run; theta is what the force of the cycle was formed with."""
    tuned, usual, q, v = VARIANTS[variant]
    cycles = round((duration or 60.0) / dt)
    t = np.arange(cycles) * dt
    push = (usual if amplitude is None else amplitude) * disturbance(t)
    qN, vN, aN = nominal(t)
    weights = lyapunov()[1]
    record = {k: np.zeros((cycles, 1)) for k in ("q", "e", "r", "force", "response")}
    record["theta"] = np.zeros((cycles, 6))
    theta = INITIAL.copy()
    lost = None
    for n in range(cycles):
        x = np.array([qN[n] - q, vN[n] - v])
        r = aN[n] + LAMBDA**2 * x[0] + 2 * LAMBDA * x[1]
        force = terms(r, q, v) @ theta
        response = response_of(force, push[n], q, v)
        for key, value in zip(
            ("q", "e", "r", "force", "response", "theta"),
            (q, x[0], r, force, response, theta),
            strict=True,
        ):
            record[key][n] = value
        if not (abs(response) <= 1e9 and abs(q) <= 100.0):
            lost = t[n]
            break
        if tuned:
            theta = theta + dt * (weights @ x) / (theta[0] * R) * terms(response, q, v)
        q, v = q + dt * v, v + dt * response
    record = {key: value[: n + 1] for key, value in record.items()}
    return {"t": t[: n + 1], "names": NAMES, "diverged": lost, **record}


if __name__ == "__main__":
    report("vdp_aidc", run, VARIANTS, SETTLE)
