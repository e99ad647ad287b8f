"""TORA with calculated A of section 3.3 a second time, from the description alone.

Inverse dynamics instead of the eliminated (3.18): row 3 of the approximate model gives q1'' for the
demanded q3'' and q2'', rows 1 and 2 then give the torques. The plant is H q'' = right hand side.
"""

from __future__ import annotations

import math

import numpy as np
from independent_report import report
from scipy.interpolate import CubicSpline

SETTLE = 4.0
NAMES = ("q3", "q2")
G = 9.81
EXACT = (20.0, 30.0, 2.0, 20.0)  # m, M, L, theta
APPROXIMATE = (10.0, 20.0, 2.0, 5.0)
LAMBDA, K, D = 6.0, 0.5, 0.6
WIDTH, BETA = 0.2 * (0.7 + 0.1), 0.99
VARIANTS = {"adaptive": 0.05, "small_epsilon": 1e-3}


def sigmoid(x):
    return math.atanh(math.tanh(x) - K) + D


def bisect(low, high):
    """Attractive fixed point: F(x) - x falls through zero."""
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if sigmoid(middle) > middle else (low, middle)
    return 0.5 * (low + high)


STAR = bisect(0.3, 3.0)
FLOOR = D - STAR  # the repulsive one


def model(parameters, q1, v1):
    """H and the rest h of H q'' + h = Q."""
    m, cart, length, theta = parameters
    c, s, ml = math.cos(q1), math.sin(q1), m * length
    H = np.array(
        [
            [ml * length + theta, theta, ml * c],
            [theta, theta, 0.0],
            [ml * c, 0.0, m + cart],
        ]
    )
    return H, np.array([-ml * G * s, 0.0, -ml * s * v1**2])


def run(variant, duration=None, *, dt=1e-3, amplitudes=(0.3, 0.5), epsilon=None, fixed=None):
    """One run; A is what the deformation of the cycle used. `fixed`: that A instead."""
    epsilon = VARIANTS[variant] if epsilon is None else epsilon
    cycles = round((duration or 16.0) / dt)
    t = np.arange(cycles) * dt
    shape = np.array([0.0, 0.7, 1.0, 0.7, 0.0, -0.7, -1.0, -0.7, 0.0])
    spline = CubicSpline(
        0.5 * np.arange(9), np.multiply.outer(shape, amplitudes), bc_type="periodic"
    )
    qN, vN, aN = (spline(t % 4.0, order) for order in range(3))
    record = {k: np.zeros((cycles, 2)) for k in ("e", "r", "force", "response", "desired")}
    record |= {"q": np.zeros((cycles, 3)), "A": np.full(cycles, np.nan)}
    q, v, integral = np.zeros(3), np.zeros(3), np.zeros(2)
    order = [2, 1]  # (q3, q2) out of (q1, q2, q3)
    r = response = np.zeros(2)
    buffer = 0.0
    lost = None
    for n in range(cycles):
        e = qN[n] - q[order]
        desired = aN[n] + 3 * LAMBDA**2 * e + 3 * LAMBDA * (vN[n] - v[order]) + LAMBDA**3 * integral
        h = response - desired
        size = math.hypot(*h)
        if n == 0:
            r = desired
        else:
            buffer = size / (1.0 - BETA) if n == 1 else BETA * buffer + size
            a = -WIDTH / (epsilon + (1.0 - BETA) * buffer) if fixed is None else fixed
            record["A"][n] = a
            if size > 1e-12:
                r = r + (sigmoid(max(a * size + STAR, FLOOR)) - STAR) / size * h
        H, rest = model(APPROXIMATE, q[0], v[0])
        swing = (-rest[2] - H[2, 2] * r[0]) / H[2, 0]
        force = (H @ np.array([swing, r[1], r[0]]) + rest)[:2]
        H, rest = model(EXACT, q[0], v[0])
        acceleration = np.linalg.solve(H, np.append(force, 0.0) - rest)
        response = acceleration[order]
        for key, value in zip(
            ("q", "e", "r", "force", "response", "desired"),
            (q, e, r, force, response, desired),
            strict=True,
        ):
            record[key][n] = value
        if not abs(q[0]) < 1.5:
            lost = t[n]
            break
        q, v, integral = q + dt * v, v + dt * acceleration, integral + dt * e
    record = {key: value[: n + 1] for key, value in record.items()}
    return {"t": t[: n + 1], "names": NAMES, "diverged": lost, **record}


if __name__ == "__main__":
    report("tora_auto", run, VARIANTS, SETTLE)
