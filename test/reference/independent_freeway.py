"""The freeway with an on-ramp a second time: METANET with vectors, in hours."""

from __future__ import annotations

import numpy as np
from independent_report import report
from scipy.interpolate import make_interp_spline

SETTLE = 1200.0
NAMES = ("rho5",)
VARIANTS = {"adaptive": True, "nonadaptive": False}
LAMBDA, A, K = 0.004 * 3600.0, 9e-3, 100.0 * 3600.0
TIMES = np.array([0.0, 1200.0, 3000.0, 4200.0, 7200.0, 8400.0]) / 3600.0
POINTS = np.array([22.0, 26.0, 26.0, 23.0, 23.0, 27.0])
STEP = 10.0 / 3600.0


def curve(rho, free, critical, a):
    return free * np.exp(-((rho / critical) ** a) / a)


def metanet(rho, v, ramp, inflow=3000.0):
    """Densities and speeds after a step of 10 s (Hegyi 2004, chapter 3)."""
    lanes, L, tau, eta, kappa, delta = 2.0, 1.0, 18.0 / 3600.0, 60.0, 40.0, 0.0122
    q = lanes * rho * v
    arriving = np.concatenate(([inflow], q[:-1]))
    arriving[4] += ramp
    v_before = np.concatenate((v[:1], v[:-1]))
    rho_ahead = np.append(rho[1:], min(rho[-1], 33.5))
    v_next = (
        v
        + STEP / tau * (curve(rho, 102.0, 33.5, 1.867) - v)
        + STEP / L * v * (v_before - v)
        - eta * STEP / (tau * L) * (rho_ahead - rho) / (rho + kappa)
    )
    v_next[4] -= delta * STEP * ramp * v[4] / (L * lanes * (rho[4] + kappa))
    return rho + STEP / (L * lanes) * (arriving - q), v_next


def start():
    return np.array([17.5] * 4 + [22.0] * 2), np.array([86.0] * 4 + [80.0] * 2)


def run(variant, duration=None):
    """One run; force is the ramp's flow [veh/h]."""
    adaptive = VARIANTS[variant]
    cycles = round((duration or 10800.0) / 10.0)
    rest = [(1, 0.0), (2, 0.0)]
    spline = make_interp_spline(TIMES, POINTS, k=5, bc_type=(rest, rest))
    rho, v = start()
    record = {k: np.zeros((cycles, 1)) for k in ("e", "r", "response", "desired", "force")}
    record["q"] = np.zeros((cycles, 12))
    integral, r, response = 0.0, 0.0, 0.0
    for n in range(cycles):
        t = min(n * STEP, TIMES[-1])
        e = float(spline(t)) - rho[4]
        desired = float(spline(t, 1)) + 2.0 * LAMBDA * e + LAMBDA**2 * integral
        if n == 0 or not adaptive:
            r = desired
        else:
            x = A / 3600.0 * (response - desired)
            r = (r + K) * (1.0 - x / (1.0 + abs(x))) - K
        guess = rho[3:5] * curve(rho[3:5], 110.0, 30.0, 2.1)
        ramp = 2.0 * (0.8 * r - guess[0] + guess[1])
        record["q"][n] = np.concatenate((rho, v))
        for key, value in zip(
            ("e", "r", "desired", "force"),
            (e, r / 3600.0, desired / 3600.0, ramp),
            strict=True,
        ):
            record[key][n] = value
        before = rho[4]
        rho, v = metanet(rho, v, ramp)
        response = (rho[4] - before) / STEP
        integral += STEP * e
    return {"t": np.arange(cycles) * 10.0, "names": NAMES, "diverged": None, **record}


if __name__ == "__main__":
    report("freeway", run, VARIANTS, SETTLE)
