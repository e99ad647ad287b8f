"""The swing of section 4.1 a second time, from the description alone.

The controller solves for (the free acceleration, Q2) as a linear system of the two rows of the
approximate model; the plant solves its own for both accelerations.
"""

from __future__ import annotations

import math

import numpy as np
from independent_report import report

SETTLE = 5.0
NAMES = ("q1", "q2")
EXACT = (2.0, 1.0, 1.0, 2.0, 9.81)  # m1, m2, L1, L2, g
APPROXIMATE = (2.2, 0.8, 1.0, 2.0, 10.0)
LAMBDA = 6.0
B, STRETCH, SHIFT = 2.0, 0.5, 1.0
FIRST, BOTH = 2.0, 2.5  # q1 is controlled for 2 s of every 2.5 s
VARIANTS = {"adaptive": True, "nonadaptive": False}


def sigmoid(x):
    return B * math.tanh(STRETCH * (x + SHIFT))


def fixed_point():
    """Newton on F(x) - x from the right, where F' < 1."""
    x = 2.0
    for _ in range(50):
        slope = STRETCH * (B - sigmoid(x) ** 2 / B)
        x -= (sigmoid(x) - x) / (slope - 1.0)
    return x


STAR = fixed_point()


def equation(parameters, q1, q2, v1, v2):
    """H11, H12, H22, h1, h2 of (4.2) and (4.3)."""
    m1, m2, l1, l2, g = parameters
    coupling = m2 * l1 * l2
    c, s = math.cos(q2), math.sin(q2)
    own = m2 * l2**2
    weight = m2 * g * l2 * math.sin(q1 + q2)
    return (
        (m1 + m2) * l1**2 + own + 2 * coupling * c,
        own + coupling * c,
        own,
        -coupling * s * v2 * (2 * v1 + v2) + (m1 + m2) * g * l1 * math.sin(q1) + weight,
        coupling * s * v1**2 + weight,
    )


def run(variant, duration=None, *, dt=1e-4, a=-1.0):
    """One run; r, desired and response are NaN for the coordinate that is not controlled."""
    cycles = round((duration or 32.5) / dt)
    t = np.arange(cycles) * dt
    slots, slot1 = round(BOTH / dt), round(FIRST / dt)
    record = {k: np.zeros((cycles, 2)) for k in ("q", "e", "force", "acceleration")}
    record |= {k: np.full((cycles, 2), np.nan) for k in ("r", "desired", "response")}
    q1 = q2 = v2 = 0.0
    v1 = 0.63
    r = response = integral = 0.0
    previous = None
    for n in range(cycles):
        active = 0 if n % slots < slot1 else 1
        wt = 2.1 * t[n]
        e1 = 0.3 * math.sin(wt) - q1
        if active == 0:
            e, de, top = e1, 0.63 * math.cos(wt) - v1, -0.3 * 2.1**2 * math.sin(wt)
        else:
            e, de, top = -q2, -v2, 0.0
        if active != previous:
            integral = 0.0
        desired = top + 3 * LAMBDA**2 * e + 3 * LAMBDA * de + LAMBDA**3 * integral
        h = response - desired
        if not VARIANTS[variant] or active != previous:
            r = desired
        elif abs(h) > 1e-12:
            r += (sigmoid(a * abs(h) + STAR) - STAR) * math.copysign(1.0, h)
        previous = active
        h11, h12, h22, n1, n2 = equation(APPROXIMATE, q1, q2, v1, v2)
        if active == 0:
            free = -(h11 * r + n1) / h12
            drive = h12 * r + h22 * free + n2
        else:
            free = -(h12 * r + n1) / h11
            drive = h12 * free + h22 * r + n2
        h11, h12, h22, n1, n2 = equation(EXACT, q1, q2, v1, v2)
        determinant = h11 * h22 - h12 * h12
        acc1 = (-n1 * h22 - h12 * (drive - n2)) / determinant
        acc2 = (h11 * (drive - n2) + h12 * n1) / determinant
        response = (acc1, acc2)[active]
        record["q"][n] = q1, q2
        record["e"][n] = e1, -q2
        record["force"][n, 1] = drive
        record["acceleration"][n] = acc1, acc2
        record["r"][n, active] = r
        record["desired"][n, active] = desired
        record["response"][n, active] = response
        q1, q2 = q1 + dt * v1, q2 + dt * v2
        v1, v2 = v1 + dt * acc1, v2 + dt * acc2
        integral += dt * e
    return {"t": t, "names": NAMES, "diverged": None, **record}


if __name__ == "__main__":
    report("swing", run, VARIANTS, SETTLE)
