"""The van der Pol with modified tuning of section 2.2.2 a second time.

The left hand side of (2.11) is taken from its other form, Y (Theta - Theta^) - d, which no
controller could know and a simulation does.
"""

from __future__ import annotations

import numpy as np
from independent_report import report
from independent_vdp_aidc import (
    EXACT,
    INITIAL,
    LAMBDA,
    NAMES,
    disturbance,
    nominal,
    response_of,
    terms,
)

SETTLE = 5.0
# alpha, amplitude of the disturbance
VARIANTS = {
    "adaptive": (10.0, 0.0),
    "alpha1": (1.0, 0.0),
    "alpha1_disturbed": (1.0, 50.0),
    "alpha10_disturbed": (10.0, 50.0),
}


def run(variant, duration=None, *, dt=1e-3, eps=1e-6, amplitude=None):
    """One run; theta is what the force of the cycle was formed with."""
    alpha, usual = VARIANTS[variant]
    cycles = round((duration or 60.0) / dt)
    t = np.arange(cycles) * dt
    push = (usual if amplitude is None else amplitude) * disturbance(t)
    qN, vN, aN = nominal(t)
    record = {k: np.zeros((cycles, 1)) for k in ("q", "e", "r", "force", "response")}
    record["theta"] = np.zeros((cycles, 6))
    theta = INITIAL.copy()
    q = v = 0.0
    lost = None
    for n in range(cycles):
        e = qN[n] - q
        r = aN[n] + LAMBDA**2 * e + 2 * LAMBDA * (vN[n] - v)
        force = terms(r, q, v) @ theta
        response = response_of(force, push[n], q, v)
        for key, value in zip(
            ("q", "e", "r", "force", "response", "theta"),
            (q, e, r, force, response, theta),
            strict=True,
        ):
            record[key][n] = value
        if not (abs(response) <= 1e9 and abs(q) <= 100.0):
            lost = t[n]
            break
        y = terms(response, q, v)
        theta = theta + dt * alpha * (y @ (EXACT - theta) - push[n]) / (y @ y + eps) * y
        q, v = q + dt * v, v + dt * response
    record = {key: value[: n + 1] for key, value in record.items()}
    return {"t": t[: n + 1], "names": NAMES, "diverged": lost, **record}


if __name__ == "__main__":
    report("vdp_modified", run, VARIANTS, SETTLE)
