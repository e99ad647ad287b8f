"""Kapitza's pendulum of section 4.2 a second time, from the description alone.

q1 is the height of the pivot, q2 the angle from the upright; Q2 = 0. The plant's two rows are
solved as a linear system by Cramer's rule.
"""

from __future__ import annotations

import math

import numpy as np
from independent_report import report

SETTLE = 5.0
NAMES = ("q2",)
M, CART, L, G = 2.0, 1.0, 1.0, 9.81
M_A, CART_A, L_A = 2.2, 1.5, 0.8
LAMBDA, A, D = 3.0, -10.0, -0.3
LIMIT = 0.05

# reading of the law for q1'', offset nominal, deformation
VARIANTS = {
    "adaptive": ("literal", False, True),
    "nonadaptive": ("literal", False, False),
    "listing": ("listing", False, True),
    "with_gravity": ("with_gravity", False, True),
    "offset": ("literal", True, True),
}


def sigmoid(x):
    return math.atanh(math.tanh(x + D) / 2.0)


def fixed_point():
    """x = F(x), repeated until it stays: F' is 0.4 there."""
    x = 0.0
    for _ in range(200):
        x = sigmoid(x)
    return x


STAR = fixed_point()


def pivot(reading, q2, r):
    """Desired acceleration of the pivot for the deformed acceleration r of q2."""
    s = math.sin(q2)
    if reading == "literal":
        return L_A * (abs(q2) / s if abs(s) >= 1e-9 else 1.0) * r - G
    if abs(s) <= LIMIT:
        s = -math.sin(LIMIT) if s <= 0.0 else math.sin(LIMIT)
    return L_A * r / s - (G if reading == "with_gravity" else 0.0)


def run(variant, duration=None, *, dt=1e-4, a=A):
    reading, offset, adaptive = VARIANTS[variant]
    cycles = round((duration or 20.0) / dt)
    t = np.arange(cycles) * dt
    middle, amplitude = (0.5, 0.2) if offset else (0.0, 0.3)
    record = {k: np.zeros((cycles, 1)) for k in ("e", "r", "force", "response", "desired")}
    record["q"] = np.zeros((cycles, 2))
    q1 = v1 = v2 = integral = r = response = 0.0
    q2 = 0.4 if offset else 0.1
    for n in range(cycles):
        swing = amplitude * math.sin(t[n])
        e = middle + swing - q2
        de = amplitude * math.cos(t[n]) - v2
        desired = -swing + 3 * LAMBDA**2 * e + 3 * LAMBDA * de + LAMBDA**3 * integral
        h = response - desired
        if n == 0 or not adaptive:
            r = desired
        elif abs(h) > 1e-12:
            r += (sigmoid(a * abs(h) + STAR) - STAR) * math.copysign(1.0, h)
        s, c = math.sin(q2), math.cos(q2)
        force = (CART_A + M_A) * (pivot(reading, q2, r) + G) - M_A * L_A * (s * r + c * v2**2)
        # rows: total q1'' - mL s q2'' = right1;  -mL s q1'' + mL^2 q2'' = right2
        total, off, own = CART + M, -M * L * s, M * L**2
        right1, right2 = force + M * L * c * v2**2 - total * G, M * G * L * s
        determinant = total * own - off * off
        acc1 = (right1 * own - off * right2) / determinant
        response = (total * right2 - off * right1) / determinant
        record["q"][n] = q1, q2
        for key, value in zip(
            ("e", "r", "force", "response", "desired"),
            (e, r, force, response, desired),
            strict=True,
        ):
            record[key][n] = value
        q1, q2 = q1 + dt * v1, q2 + dt * v2
        v1, v2 = v1 + dt * acc1, v2 + dt * response
        integral += dt * e
    return {"t": t, "names": NAMES, "diverged": None, **record}


if __name__ == "__main__":
    report("kapitza", run, VARIANTS, SETTLE)
