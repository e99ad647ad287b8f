"""The two coupled masses of section 2.5 a second time, from the description alone.

Forces and known terms come from the regressor, the fixed points from bisection, the plant from its
equation of motion.
"""

from __future__ import annotations

import math

import numpy as np
from independent_report import report

SETTLE = 5.0
NAMES = ("q1", "q2")
# m1, m1 g, k1, k1 L1, k2, k2 L2, b1, m2, m2 g, b2
M1, M2, K1, K2, L1, L2, B1, B2, G = 2.0, 3.0, 50.0, 40.0, 0.5, 0.5, 1.0, 1.5, 9.81
INITIAL = np.array([1.5, 14.715, 40.0, 24.0, 50.0, 20.0, 2.0, 2.0, 19.62, 1.0])
LAMBDA = 5.0
D = 0.3
ON = 500  # the cycle in which both adaptations start
RATE = 0.3

# deformation, tuning, w kept from cycle to cycle
VARIANTS = {
    "adaptive": (True, True, True),
    "cold": (True, True, False),
    "deform_only": (True, False, True),
    "tune_only": (False, True, True),
    "nonadaptive": (False, False, True),
}


def bisect(function, low, high):
    """Root of a function that is positive at `low` and negative at `high`."""
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if function(middle) > 0.0 else (low, middle)
    return 0.5 * (low + high)


def sigmoid(x):
    return math.atanh(0.5 * math.tanh(x + D))


STAR = bisect(lambda x: sigmoid(x) - x, 0.0, 2.0)


def transformed(r, f, desired, a):
    """G of (2.25)."""
    h = f - desired
    size = math.hypot(*h)
    if size < 1e-12:
        return r
    return r + (sigmoid(a * size + STAR) - STAR) / size * h


def regressor(q, v, acceleration):
    gap = q[1] - q[0]
    return np.array(
        [
            [acceleration[0], -1.0, q[0], -1.0, -gap, 1.0, v[0], 0.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, 0.0, gap, -1.0, 0.0, acceleration[1], -1.0, v[1]],
        ]
    )


def nominal(t):
    """Values at all times: q1 = 0.5 + 0.2 (1 - cos 2t) + 0.1 (1 - cos 5t), q2 likewise."""
    rest, slow, fast = np.array([0.5, 1.5]), np.array([2.0, 3.0]), np.array([5.0, 6.0])
    u, w = np.multiply.outer(t, slow), np.multiply.outer(t, fast)
    return (
        rest + 0.3 - 0.2 * np.cos(u) - 0.1 * np.cos(w),
        0.2 * slow * np.sin(u) + 0.1 * fast * np.sin(w),
        0.2 * slow**2 * np.cos(u) + 0.1 * fast**2 * np.cos(w),
    )


def run(
    variant,
    duration=None,
    *,
    dt=1e-3,
    a1=-1.0,
    a2=-3.0,
    rate=RATE,
    scaled=True,
    exact_inverse=False,
):
    """One run; known is |a|, residual |M w - a| after the last inner iteration."""
    deformed, tuned, warm = VARIANTS[variant]
    cycles = round((duration or 20.0) / dt)
    t = np.arange(cycles) * dt
    qN, vN, aN = nominal(t)
    record = {k: np.zeros((cycles, 2)) for k in ("q", "e", "r", "force", "response", "desired")}
    record |= {"theta": np.zeros((cycles, 10))}
    record |= {"known": np.zeros(cycles), "residual": np.zeros(cycles), "w": np.zeros((cycles, 2))}
    q, v, integral = np.array([0.5, 1.5]), np.zeros(2), np.zeros(2)
    theta = INITIAL.copy()
    r = f = w = np.zeros(2)
    lost = None
    for n in range(cycles):
        e, de = qN[n] - q, vN[n] - v
        desired = aN[n] + 3 * LAMBDA**2 * e + 3 * LAMBDA * de + LAMBDA**3 * integral
        r = transformed(r, f, desired, a1) if deformed and n >= ON else desired
        force = regressor(q, v, r) @ theta
        first = K1 * (q[0] - L1)
        second = K2 * (q[1] - q[0] - L2)
        f = np.array(
            [
                (force[0] + M1 * G - first + second - B1 * v[0]) / M1,
                (force[1] + M2 * G - second - B2 * v[1]) / M2,
            ]
        )
        Y = regressor(q, v, f)
        known = force - Y @ theta
        record["theta"][n] = theta
        if tuned and n >= ON:
            M = Y @ Y.T
            a = a2 / math.sqrt(np.sum(M * M)) if scaled else a2
            w = w if warm else np.zeros(2)
            for _ in range(3):
                w = transformed(w, M @ w, known, a)
            if exact_inverse:
                w = np.linalg.solve(M, known)
            record["residual"][n] = math.hypot(*(M @ w - known))
            theta = theta + dt * rate * (Y.T @ w)
        record["known"][n] = math.hypot(*known)
        for key, value in zip(
            ("q", "e", "r", "force", "response", "desired", "w"),
            (q, e, r, force, f, desired, w),
            strict=True,
        ):
            record[key][n] = value
        if not (np.abs(f).max() <= 1e7 and np.abs(q).max() <= 1e3):
            lost = t[n]
            break
        q, v, integral = q + dt * v, v + dt * f, integral + dt * e
    record = {key: value[: n + 1] for key, value in record.items()}
    return {"t": t[: n + 1], "names": NAMES, "diverged": lost, **record}


if __name__ == "__main__":
    report("coupled_masses", run, VARIANTS, SETTLE)
