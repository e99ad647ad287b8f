"""The FitzHugh-Nagumo neuron of section 3.1.2 a second time, from the description alone.

The nominal is a neuron of its own, computed before the loop; the signed form of the transformation.
"""

from __future__ import annotations

import math

import numpy as np
from independent_report import report

SETTLE = 50.0
NAMES = ("v",)
LAMBDA, K, D = 0.1, 0.5, 0.6
# observer, disturbed, deformation
VARIANTS = {
    "adaptive": (False, False, True),
    "nonadaptive": (False, False, False),
    "disturbed": (False, True, True),
    "nonadaptive_disturbed": (False, True, False),
    "observer": (True, False, True),
    "observer_disturbed": (True, True, True),
}


def sigmoid(x):
    return math.atanh(math.tanh(x) - K) + D


def bisect(low, high):
    """Attractive fixed point: F(x) - x falls through zero."""
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if sigmoid(middle) > middle else (low, middle)
    return 0.5 * (low + high)


STAR = bisect(0.3, 3.0)


def membrane(v, w, current):
    return v - v**3 / 3.0 - w + current


def recovery(v, w, a, tau, b):
    return (v + a - b * w) / tau


def ideal(cycles, dt):
    """Nominal v and its rate, of the ideal neuron left alone."""
    v = w = 0.0
    states, rates = [], []
    for _ in range(cycles):
        rate = membrane(v, w, 0.3)
        states.append(v)
        rates.append(rate)
        v, w = v + dt * rate, w + dt * recovery(v, w, 0.6, 11.0, 0.4)
    return states, rates


def run(variant, duration=None, *, dt=0.01, a=-0.75, seed=12345, amplitude=0.15):
    """One run; the columns of force are the control and the disturbance added to it."""
    observed, disturbed, adaptive = VARIANTS[variant]
    cycles = round((duration or 200.0) / dt)
    t = np.arange(cycles) * dt
    nominal, nominal_rate = ideal(cycles, dt)
    noise = np.zeros(cycles)
    if disturbed:
        noise = amplitude * np.sin(4.0 * t)
        noise += np.random.default_rng(seed).uniform(-amplitude, amplitude, cycles)
    record = {k: np.zeros((cycles, 1)) for k in ("e", "r", "response", "desired")}
    record |= {k: np.zeros((cycles, 2)) for k in ("q", "force")}
    v, w, estimate, integral = 0.5, 0.0, 0.0, 0.0
    r = response = 0.0
    lost = None
    for n in range(cycles):
        e = nominal[n] - v
        desired = nominal_rate[n] + 2.0 * LAMBDA * e + LAMBDA**2 * integral
        if n == 0 or not adaptive:
            r = desired
        else:
            argument = math.tanh(a * (response - desired) + STAR) - K
            if argument <= -1.0:
                lost = t[n]
                break
            r += math.atanh(argument) + D - STAR
        control = (r - membrane(v, estimate if observed else w, 0.4)) / 3.0
        response = membrane(v, w, 0.5) + 2.0 * (control + noise[n])
        record["q"][n] = v, w
        record["force"][n] = control, noise[n]
        for key, value in zip(
            ("e", "r", "response", "desired"), (e, r, response, desired), strict=True
        ):
            record[key][n] = value
        estimate += dt * recovery(v, estimate, 0.8, 10.0, 0.6)
        w, v = w + dt * recovery(v, w, 0.7, 12.5, 0.5), v + dt * response
        integral += dt * e
    used = n if lost else cycles
    record = {key: value[:used] for key, value in record.items()}
    return {"t": t[:used], "names": NAMES, "diverged": lost, **record}


if __name__ == "__main__":
    report("fitzhugh_nagumo", run, VARIANTS, SETTLE)
