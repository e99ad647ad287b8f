"""Hypnosis by propofol a second time: amounts [mg] instead of concentrations, minutes for seconds.

Volumes and clearances are those of Schnider's formulas for the patient's age, height and weight;
the configuration has them rounded.
"""

from __future__ import annotations

import numpy as np
from independent_report import report
from scipy.interpolate import make_interp_spline

SETTLE = 900.0
NAMES = ("wav",)
VARIANTS = {"adaptive": True, "nonadaptive": False}
LAMBDA, A, K = 0.01 * 60.0, 1e-2, 100.0 * 3600.0
TIMES = np.array([0.0, 600.0, 1800.0, 3300.0, 4200.0, 4800.0])
POINTS = np.array([80.0, 50.0, 50.0, 56.0, 56.0, 48.0])


def schnider(age, height, weight):
    """Rates [1/min] and the central volume [l] of a woman (1998, table 2)."""
    lean = 1.07 * weight - 148.0 * (weight / height) ** 2
    V1, V2, V3 = 4.27, 18.9 - 0.391 * (age - 53), 238.0
    Cl1 = 1.89 + 0.0456 * (weight - 77) - 0.0681 * (lean - 59) + 0.0264 * (height - 177)
    Cl2, Cl3 = 1.29 - 0.024 * (age - 53), 0.836
    return V1, Cl1 / V1, Cl2 / V1, Cl2 / V2, Cl3 / V1, Cl3 / V3


class Curve:
    """Hill curve: index of a concentration and back, with derivatives."""

    def __init__(self, E0, EC50, gamma):
        self.E0, self.EC50, self.gamma = E0, EC50, gamma

    def index(self, c):
        return self.E0 / (1.0 + (c / self.EC50) ** self.gamma)

    def concentration(self, index):
        return self.EC50 * (self.E0 / index - 1.0) ** (1.0 / self.gamma)

    def derivatives(self, c):
        """First and second of the index."""
        y, g = (c / self.EC50) ** self.gamma, self.gamma
        first = -self.E0 * g * y / (c * (1.0 + y) ** 2)
        return first, first * ((g - 1.0) / c - 2.0 * g * y / (c * (1.0 + y)))


def run(variant, duration=None):
    """One run; force is the infusion [mg/min]."""
    adaptive = VARIANTS[variant]
    dt = 1.0 / 60.0
    cycles = round(duration or 5400.0)
    rest = [(1, 0.0), (2, 0.0)]
    spline = make_interp_spline(TIMES / 60.0, POINTS, k=5, bc_type=(rest, rest))
    V, k10, k12, k21, k13, k31 = 4.27, 0.3888, 0.2852, 0.06871, 0.1958, 0.003513
    ke0, patient = 0.3154, Curve(92.591, 3.752, 1.572)
    average, V_a, ke0_a, out_a = Curve(100.0, 1.668, 1.43), 4.27, 0.456, 0.4426 + 0.3021 + 0.1958
    site = patient.concentration(80.0)
    a1, a2, a3 = V * site, V * site * k12 / k21, V * site * k13 / k31
    record = {k: np.zeros((cycles, 1)) for k in ("e", "r", "response", "desired", "q", "force")}
    integral, r, response = 0.0, 0.0, 0.0
    for n in range(cycles):
        t = min(n * dt, TIMES[-1] / 60.0)
        nominal, rate, acceleration = (float(spline(t, each)) for each in (0, 1, 2))
        index = patient.index(site)
        speed = patient.derivatives(site)[0] * ke0 * (a1 / V - site)
        e, e_dot = nominal - index, rate - speed
        desired = acceleration + 3 * LAMBDA * e_dot + 3 * LAMBDA**2 * e + LAMBDA**3 * integral
        if n == 0 or not adaptive:
            r = desired
        else:
            x = A / 3600.0 * (response - desired)
            r = (r + K) * (1.0 - x / (1.0 + abs(x))) - K
        c = average.concentration(index)
        first, second = average.derivatives(c)
        c_dot = speed / first
        c_second = (r - second * c_dot**2) / first
        central, central_dot = c + c_dot / ke0_a, c_dot + c_second / ke0_a
        u = V_a * (central_dot + out_a * central)
        for key, value in zip(
            ("e", "r", "desired", "q", "force"),
            (e, r / 3600.0, desired / 3600.0, index, u),
            strict=True,
        ):
            record[key][n] = value
        flows = k12 * a1 - k21 * a2, k13 * a1 - k31 * a3
        before = a1
        a1 += dt * (max(u, 0.0) - k10 * a1 - sum(flows))
        a2, a3 = a2 + dt * flows[0], a3 + dt * flows[1]
        site += dt * ke0 * (before / V - site)
        response = (patient.derivatives(site)[0] * ke0 * (a1 / V - site) - speed) / dt
        integral += dt * e
    return {"t": np.arange(cycles, dtype=float), "names": NAMES, "diverged": None, **record}


if __name__ == "__main__":
    report("hypnosis", run, VARIANTS, SETTLE)
