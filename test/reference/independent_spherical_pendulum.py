"""The spherical pendulum of section 4.3 a second time, from the description alone.

The response of ten steps ago comes from the records kept, as does r; the plant's rows are
independent of each other. Fuzzy sine and cosine are linear interpolation, which the weighted mean
over a Ruspini partition is.
"""

from __future__ import annotations

import math

import numpy as np
from independent_report import report

SETTLE = 4.0
NAMES = ("q1", "q2")
M, L, G = 0.5, 1.5, 9.81
G_A = 10.0
LAMBDA, A, D = 4.0, -1.0, 0.3
LAG = 10  # cycles of the learning delay of 1 ms
SINE = (0.0, 0.7, 1.0, 0.7, 0.0)
COSINE = (1.0, 0.7, 0.0, -0.7, -1.0)

# model, weights: None for no deformation
VARIANTS = {
    "adaptive": ("affine", "tuned"),
    "nonadaptive": ("affine", None),
    "fixed_weights": ("affine", "fixed"),
    "fuzzy_sin": ("fuzzy_sin", "tuned"),
    "fully_fuzzy": ("fully_fuzzy", "tuned"),
    "fuzzy_sin_nonadaptive": ("fuzzy_sin", None),
    "fully_fuzzy_nonadaptive": ("fully_fuzzy", None),
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


def fuzzy(x, values):
    place = min(max(x, 0.0), math.pi) / (math.pi / 4.0)
    i = min(int(place), 3)
    return values[i] + (place - i) * (values[i + 1] - values[i])


def torques(model, q1, v1, v2, r1, r2):
    if model == "affine":
        return r1 + 1.0, math.sin(q1) ** 2 * r2 + 1.0
    s = fuzzy(q1, SINE)
    if model == "fuzzy_sin":
        return r1 + 1.0, s * s * r2 + 1.0
    c = fuzzy(q1, COSINE)
    return r1 - s * c * v2 * v2 + G_A * s, s * s * r2 + 2.0 * s * c * v1 * v2


def run(variant, duration=None, *, dt=1e-4, fixed=(1.0, 1.0)):
    """One run; weights is the diagonal that the deformation of the cycle used."""
    model, kind = VARIANTS[variant]
    cycles = round((duration or 10.0) / dt)
    t = np.arange(cycles) * dt
    keys = ("q", "e", "r", "force", "response", "desired", "weights")
    record = {k: np.zeros((cycles, 2)) for k in keys}
    q1, q2, v1, v2 = 1.0, 0.0, 0.0, 0.0
    i1 = i2 = 0.0
    weights = list(fixed)
    buffer = [0.0, 0.0]
    r_all, f_all = [], []
    for n in range(cycles):
        w2, w1 = 2.0 * t[n], t[n]
        e1 = 1.0 + 0.3 * math.sin(w2) - q1
        e2 = 0.5 * math.sin(w1) - q2
        desired = (
            -1.2 * math.sin(w2)
            + 3 * LAMBDA**2 * e1
            + 3 * LAMBDA * (0.6 * math.cos(w2) - v1)
            + LAMBDA**3 * i1,
            -0.5 * math.sin(w1)
            + 3 * LAMBDA**2 * e2
            + 3 * LAMBDA * (0.5 * math.cos(w1) - v2)
            + LAMBDA**3 * i2,
        )
        record["weights"][n] = weights
        r = desired
        if kind and n >= LAG:
            h = [f - d for f, d in zip(f_all[n - LAG], desired, strict=True)]
            x = [w * y for w, y in zip(weights, h, strict=True)]
            size = math.hypot(*x)
            r = r_all[n - LAG]
            if size > 1e-12:
                step = (sigmoid(A * size + STAR) - STAR) / size
                r = (r[0] + step * x[0], r[1] + step * x[1])
        r_all.append(r)
        force = torques(model, q1, v1, v2, *r)
        s, c = math.sin(q1), math.cos(q1)
        f = (
            force[0] / (M * L**2) + s * c * v2**2 - G / L * s,
            (force[1] / (M * L**2) - 2.0 * s * c * v1 * v2) / s**2,
        )
        f_all.append(f)
        for key, value in zip(keys[:-1], ((q1, q2), (e1, e2), r, force, f, desired), strict=True):
            record[key][n] = value
        if kind == "tuned" and n >= 2 * LAG:
            for i in range(2):
                near, far = r_all[n - LAG][i], r_all[n - 2 * LAG][i]
                x = (r[i] - near) * (near - far)
                buffer[i] = 0.99 * buffer[i] + 0.01 * x / (abs(x) + 1e-12)
                if buffer[i] < 0.0:
                    weights[i] = max(0.1, weights[i] * (1.0 - 50.0 * dt))
                else:
                    weights[i] = min(10.0, weights[i] * (1.0 + 0.5 * dt))
        q1, q2 = q1 + dt * v1, q2 + dt * v2
        v1, v2 = v1 + dt * f[0], v2 + dt * f[1]
        i1, i2 = i1 + dt * e1, i2 + dt * e2
    return {"t": t, "names": NAMES, "diverged": None, **record}


if __name__ == "__main__":
    report("spherical_pendulum", run, VARIANTS, SETTLE)
