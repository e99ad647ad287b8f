"""The bare iteration of section 3.1.1 a second time: r <- F(A h + x*) + r - x*, f(r) = r + 1.

The fixed points come from the closed form, tanh and atanh from the exponential. No guard.
"""

from __future__ import annotations

import math

import numpy as np
from independent_report import report

SETTLE = 0.0
NAMES = ("x1",)
DESIRED, START = -2.0, -4.0
K, D = 0.5, 0.6
VARIANTS = {"adaptive": -0.5, "fast": -2.0, "precursor": -3.12, "chaos": -6.0}

HALF = 0.5 * math.acosh(2.0 * math.sinh(D) / K - math.cosh(D))
STAR = D / 2 + HALF


def sigmoid(x):
    """F; not a number outside its domain."""
    growth = math.exp(2.0 * x) if x < 300.0 else math.inf
    y = 1.0 - 2.0 / (growth + 1.0) - K
    return 0.5 * math.log((1.0 + y) / (1.0 - y)) + D if y > -1.0 else math.nan


def run(variant, duration=None, *, a=None, star=STAR, start=START):
    """`duration` counts iterations, t too; e = desired - f(r)."""
    a = VARIANTS[variant] if a is None else a
    steps = round(duration or 400)
    r, lost = start, None
    orbit = []
    for n in range(steps):
        orbit.append(r)
        r = sigmoid(a * (r + 1.0 - DESIRED) + star) + r - star
        if math.isnan(r):
            lost = float(n + 1)
            break
    r = np.array(orbit)[:, None]
    e = DESIRED - (r + 1.0)
    record = {"e": e, "r": r, "q": r, "response": r + 1.0, "force": r}
    return {"t": np.arange(float(len(r))), "names": NAMES, "diverged": lost, **record}


if __name__ == "__main__":
    report("siso_affine", run, VARIANTS, SETTLE)
