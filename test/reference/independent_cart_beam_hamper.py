"""Cart, beam and hamper of section 2.4 a second time, from the description alone.

Forces and known terms come from the regressor (Y Theta), never from estimated matrices; the plant
is H q'' = right hand side, solved as it stands.
"""

from __future__ import annotations

import math

import numpy as np
from independent_report import report

SETTLE = 5.0
NAMES = ("q1", "q2", "q3")
EXACT = np.array([20.0, 60.0, 20.0, 40.0, 200.0])  # mL, mL^2 + theta, theta, M + m, mgL
INITIAL = np.array([50.0, 175.0, 50.0, 80.0, 400.0])
LAMBDA, K_D = 10.0, 100.0
ALPHA = 1.0
GAMMA = 0.02
A, B, K = 1e-8, 1.0, -1e7
SIGMA0, SIGMA1, SIGMA2 = 1e5, 300.0, 2.0
F_STATIC, V_STRIBECK = 60.0, 0.05
# nominal: 0.4 (1 - cos slow t) + 0.2 (1 - cos fast t)
SLOW = np.array([1.0, 1.5, 1.2])
FAST = np.array([3.0, 3.5, 2.5])

# (tuning, RFPT)
KINDS = {
    "adaptive": ("gram_schmidt", True),
    "no_rfpt": ("gram_schmidt", False),
    "fixed_model": (None, False),
    "fixed_model_rfpt": (None, True),
    "slotine_li": ("slotine_li", False),
}
VARIANTS = {name: (*kind, False) for name, kind in KINDS.items()}
VARIANTS |= {
    "lugre" if name == "adaptive" else f"{name}_lugre": (*kind, True)
    for name, kind in KINDS.items()
}


def nominal(t):
    """Position, rate and acceleration at all times at once."""
    slow, fast = np.multiply.outer(t, SLOW), np.multiply.outer(t, FAST)
    position = 0.4 * (1.0 - np.cos(slow)) + 0.2 * (1.0 - np.cos(fast))
    rate = 0.4 * SLOW * np.sin(slow) + 0.2 * FAST * np.sin(fast)
    return position, rate, 0.4 * SLOW**2 * np.cos(slow) + 0.2 * FAST**2 * np.cos(fast)


def regressor(c, s, turning, rate1, acceleration):
    """Y with the true rate of q1 `turning`, and the rate that multiplies C, `rate1`."""
    a1, a2, a3 = acceleration
    return np.array(
        [
            [c * a3, a1, a2, 0.0, -s],
            [0.0, 0.0, a1 + a2, 0.0, 0.0],
            [c * a1 - s * turning * rate1, 0.0, 0.0, a3, 0.0],
        ]
    )


def projected(Z, a, eps):
    """Sum of a_i z_i / (|z_i|^2 + eps) over the orthogonalised rows."""
    rows, known = [], []
    total = np.zeros(Z.shape[1])
    for z, value in zip(Z, a, strict=True):
        for other, other_value in zip(rows, known, strict=True):
            f = (z @ other) / (other @ other + eps)
            z, value = z - f * other, value - f * other_value
        rows.append(z)
        known.append(value)
        total += value / (z @ z + eps) * z
    return total


def run(variant, duration=None, *, dt=1e-4, eps=1.0, coulomb=40.0, gain=A, start=(0.0, 0.0, 0.0)):
    """One run; theta is what the force of the cycle was formed with."""
    tuning, deformed, friction = VARIANTS[variant]
    cycles = round((duration or 30.0) / dt)
    t = np.arange(cycles) * dt
    qN, vN, aN = nominal(t)
    record = {k: np.zeros((cycles, 3)) for k in ("q", "e", "r", "force", "response", "desired")}
    record["theta"] = np.zeros((cycles, 5))
    q, dq, xi = np.array(start), np.zeros(3), np.zeros(3)
    theta = INITIAL.copy()
    r = response = np.zeros(3)
    z = 0.0
    lost = None
    for n in range(cycles):
        e = qN[n] - q
        v = vN[n] + 2 * LAMBDA * e + LAMBDA**2 * xi
        desired = aN[n] + 2 * LAMBDA * (vN[n] - dq) + LAMBDA**2 * e
        S = v - dq
        h = response - desired
        size = math.sqrt(h @ h)
        if n == 0 or not deformed:
            r = desired
        elif size >= 1e-12:
            sigma = B * gain * size / (1.0 + gain * size)
            r = r + sigma * (r + K * h / size)
        c, s = math.cos(q[0]), math.sin(q[0])
        turning = dq[0]
        force = regressor(c, s, turning, v[0], r) @ theta + K_D * S
        drag = rate_z = g = 0.0
        if friction:
            g = coulomb + (F_STATIC - coulomb) * math.exp(-((dq[2] / V_STRIBECK) ** 2))
            rate_z = dq[2] - SIGMA0 * abs(dq[2]) * z / g
            drag = SIGMA0 * z + SIGMA1 * rate_z + SIGMA2 * dq[2]
        inertia = np.array(
            [
                [EXACT[1], EXACT[2], EXACT[0] * c],
                [EXACT[2], EXACT[2], 0.0],
                [EXACT[0] * c, 0.0, EXACT[3]],
            ]
        )
        push = [EXACT[4] * s, 0.0, EXACT[0] * s * turning**2 - drag]
        response = np.linalg.solve(inertia, force + push)
        for key, value in zip(
            ("q", "e", "r", "force", "response", "desired", "theta"),
            (q, e, r, force, response, desired, theta),
            strict=True,
        ):
            record[key][n] = value
        if not np.abs(response).max() <= 1e7:
            lost = t[n]
            break
        if tuning == "gram_schmidt":
            Z = regressor(c, s, turning, turning, response)
            theta = theta + dt * ALPHA * projected(Z, force - Z @ theta, eps)
        elif tuning == "slotine_li":
            theta = theta + dt / GAMMA * (regressor(c, s, turning, v[0], desired).T @ S)
        if friction:
            z = (z + dt * dq[2]) / (1.0 + dt * SIGMA0 * abs(dq[2]) / g)
        q, dq, xi = q + dt * dq, dq + dt * response, xi + dt * e
    record = {key: value[: n + 1] for key, value in record.items()}
    return {"t": t[: n + 1], "names": NAMES, "diverged": lost, **record}


if __name__ == "__main__":
    report("cart_beam_hamper", run, VARIANTS, SETTLE)
