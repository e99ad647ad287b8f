"""The bare iteration of section 3.2.1 a second time, in the coordinates of the response error.

h = M r + c - desired moves by h <- (1 + s/|h|  M) h, s the step of F: r is only recovered from h
at the end, by solving.
"""

from __future__ import annotations

import math

import numpy as np
from independent_report import report

SETTLE = 0.0
NAMES = ("x1", "x2")
M = np.array([[3.832, 1.819], [1.819, 2.168]])
C = np.array([1.0, -1.0])
DESIRED = np.array([1.0, -3.0])
K, D = 0.5, 0.6
VARIANTS = {"adaptive": -0.20, "fast": -0.27425, "printed_sign": 0.20}

HALF = 0.5 * math.acosh(2.0 * math.sinh(D) / K - math.cosh(D))
STAR, FLOOR = D / 2 + HALF, D / 2 - HALF


def sigmoid(x):
    return math.atanh(math.tanh(x) - K) + D


def run(variant, duration=None, *, a=None):
    """`duration` counts iterations, t too; e = desired - f(r)."""
    a = VARIANTS[variant] if a is None else a
    steps = round(duration or 400)
    h = C - DESIRED  # r = 0
    errors = np.zeros((steps, 2))
    for n in range(steps):
        errors[n] = -h
        size = math.hypot(*h)
        if size > 1e-12:
            step = sigmoid(max(a * size + STAR, FLOOR)) - STAR
            h = h + step / size * (M @ h)
    r = np.linalg.solve(M, (DESIRED - C - errors).T).T
    record = {"e": errors, "r": r, "q": r, "response": DESIRED - errors, "force": r}
    return {"t": np.arange(float(steps)), "names": NAMES, "diverged": None, **record}


if __name__ == "__main__":
    report("mimo_affine", run, VARIANTS, SETTLE)
