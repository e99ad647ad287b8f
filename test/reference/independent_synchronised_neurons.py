"""Two neurons under electrical stimulation again: first the chaotic drive, then the loop."""

from __future__ import annotations

import math

import numpy as np
from independent_report import report

SETTLE = 50.0
NAMES = ("x",)
LAMBDA, K, D, A = 0.5, 0.5, 0.6, -0.75
VARIANTS = {"adaptive": True, "nonadaptive": False}
OMEGA = 2.0 * math.pi * 0.129

STAR = D / 2 + 0.5 * math.acosh(2.0 * math.sinh(D) / K - math.cosh(D))


def cubic(r, x):
    return -r * x**3 + (r + 1.0) * x**2 - x


def drive(cycles, dt):
    """Activation and its rate: r = 10, b = 1, stimulus 0.1 / omega cos(omega t), from rest."""
    x = y = 0.0
    states, rates = [], []
    for n in range(cycles):
        rate = cubic(10.0, x) - y + 0.1 / OMEGA * math.cos(OMEGA * n * dt)
        states.append(x)
        rates.append(rate)
        x, y = x + dt * rate, y + dt * x
    return states, rates


def exponent(cycles, dt):
    """Largest Lyapunov exponent of the drive: how fast two neighbours part [1/s]."""
    u, v, grown = 1.0, 0.0, 0.0
    for x in drive(cycles, dt)[0]:
        slope = -30.0 * x**2 + 22.0 * x - 1.0
        u, v = u + dt * (slope * u - v), v + dt * u
        size = math.hypot(u, v)
        grown += math.log(size)
        u, v = u / size, v / size
    return grown / (cycles * dt)


def run(variant, duration=None, *, dt=0.01):
    """One run; the column of force is the control."""
    adaptive = VARIANTS[variant]
    cycles = round((duration or 200.0) / dt)
    nominal, nominal_rate = drive(cycles, dt)
    record = {k: np.zeros((cycles, 1)) for k in ("e", "r", "response", "desired", "force")}
    record["q"] = np.zeros((cycles, 2))
    x, y, integral, r, response = 0.3, 0.3, 0.0, 0.0, 0.0
    for n in range(cycles):
        e = nominal[n] - x
        desired = nominal_rate[n] + 2.0 * LAMBDA * e + LAMBDA**2 * integral
        if n == 0 or not adaptive:
            r = desired
        else:
            step = math.atanh(math.tanh(A * (response - desired) + STAR) - K) + D
            r += step - STAR
        control = (r - cubic(8.0, x) + y) / 3.0
        stimulus = 0.0617 * math.sin(0.8105309046261666 * n * dt)
        response = cubic(9.0, x) - y + 2.0 * (control + stimulus)
        record["q"][n] = x, y
        for key, value in zip(
            ("e", "r", "response", "desired", "force"),
            (e, r, response, desired, control),
            strict=True,
        ):
            record[key][n] = value
        x, y = x + dt * response, y + dt * 0.9 * x
        integral += dt * e
    return {"t": np.arange(cycles) * dt, "names": NAMES, "diverged": None, **record}


if __name__ == "__main__":
    report("synchronised_neurons", run, VARIANTS, SETTLE)
