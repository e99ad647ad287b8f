"""The controllers of the field in the loop of cart, beam and hamper, against a second program.

The loop below shares no line with the package: dynamics, regressor and nominal motion are those of
test/reference, each controller is written in the form of its paper (matrices of an observer, states
of a predictor, an inclusion solved by bisection), not as the law is.
"""

import sys
from pathlib import Path

import numpy as np
import pytest
from engine_runs import topics_of
from scipy.linalg import expm
from scipy.optimize import brentq

sys.path.insert(0, str(Path(__file__).parents[1] / "reference"))
from independent_cart_beam_hamper import EXACT, LAMBDA, nominal, regressor

DT, CYCLES = 1e-3, 600
MASS = np.array([60.0, 20.0, 40.0])
MODEL = {"m": 5.0, "M": 15.0, "L": 2.0, "theta": 10.0, "g": 8.0, "K_D": 0.0}
HALF = np.array([10.0, 30.0, 10.0, 20.0, 80.0])  # of these: mL, mL^2 + theta, theta, M + m, mgL


def state_observer(bandwidth):
    """Gains by Ackermann's formula, for the pair (Phi, C Phi)."""
    Phi, Gamma = expm(DT * np.diag([1.0, 1.0], 1)), np.array([DT**2 / 2, DT, 0.0])
    shown = Phi[:1]
    wanted = Phi - np.exp(-bandwidth * DT) * np.eye(3)
    seen = np.vstack([shown, shown @ Phi, shown @ Phi @ Phi])
    L = np.linalg.matrix_power(wanted, 3) @ np.linalg.solve(seen, [0.0, 0.0, 1.0])
    x = None

    def control(now, before):
        nonlocal x
        if x is None:
            x = np.array([now["q"], now["v"], 0.0 * now["q"]])
        else:
            x = Phi @ x + np.outer(Gamma, before["effort"] / MASS)
            x = x + np.outer(L, now["q"] - x[0])
        return MASS * (now["desired"] - x[2])

    return control


def sliding_mode(now, before):
    return now["model"] + MASS * 5.0 * np.clip(now["s"] / 0.2, -1.0, 1.0)


def super_twisting(k1, k2):
    w = np.zeros(3)

    def reached(b):
        """The s+ that solves s+ + dt k1 sqrt|s+| sign s+ + dt^2 k2 sign s+ = b, b > dt^2 k2."""
        return brentq(lambda x: x + DT * k1 * x**0.5 + DT**2 * k2 - b, 0.0, b, xtol=1e-18)

    def control(now, before):
        u = np.zeros(3)
        if before is None:
            return now["model"]
        for i, s in enumerate(now["s"]):
            b = s - DT * w[i]
            plus = reached(abs(b)) * np.sign(b) if abs(b) > DT**2 * k2 else 0.0
            w[i] += (b - plus) / DT - k1 * abs(plus) ** 0.5 * np.sign(plus)
            u[i] = (s - plus) / DT
        return now["model"] + 0.2 * MASS * u

    return control


def l1(a, cutoff):
    error, sigma, low = np.zeros(3), np.zeros(3), np.zeros(3)

    def control(now, before):
        nonlocal error, sigma, low
        if before is not None:
            lacked = now["explained"] - before["effort"]
            error = np.exp(-a * DT) * error + (1 - np.exp(-a * DT)) / a * (sigma - lacked)
            sigma = -a / (np.exp(a * DT) - 1) * error
            low = low + (1 - np.exp(-cutoff * DT)) * (sigma - low)
        return now["model"] - low

    return control


def model_free(window):
    """Weights of the algebraic estimate, by quadrature of x (T - x) in the middle of each cycle."""
    past = []

    def control(now, before):
        if before is None:
            return now["model"]
        past.append(now["response"] - before["effort"] / MASS)
        recent = np.array(past[: -window - 1 : -1])
        x = (np.arange(len(recent)) + 0.5) / window
        return MASS * (now["desired"] - np.average(recent, axis=0, weights=x * (1 - x)))

    return control


def time_delay(now, before):
    if before is None:
        return now["model"]
    return before["effort"] + 0.3 * MASS * (now["desired"] - now["response"])


def incremental(now, before):
    return now["model"] + (before["effort"] - now["explained"] if before else 0.0)


def momentum_observer(gain):
    """The integral of the observer over cycles, as a sum."""
    lacked, d = np.zeros(3), np.zeros(3)

    def control(now, before):
        nonlocal lacked, d
        if before is not None:
            lacked = lacked + DT * (now["explained"] - before["effort"] - d)
            d = gain * lacked
        return now["model"] - d

    return control


CONTROLLERS = {
    "state_observer": (("bandwidth=200.0",), lambda: state_observer(200.0)),
    "sliding_mode": (("K=5.0", "phi=0.2"), lambda: sliding_mode),
    "super_twisting": (("factor=0.2", "k1=20.0", "k2=150.0"), lambda: super_twisting(20.0, 150.0)),
    "l1": (("decay=5.0", "cutoff=150.0"), lambda: l1(5.0, 150.0)),
    "model_free": (("window=4",), lambda: model_free(4)),
    "time_delay": (("factor=0.3",), lambda: time_delay),
    "incremental": ((), lambda: incremental),
    "momentum_observer": (("gain=150.0",), lambda: momentum_observer(150.0)),
}
WITH_INERTIA = {"state_observer", "sliding_mode", "super_twisting", "model_free", "time_delay"}


def simulate(control, relax, limit=np.inf):
    """Positions of all cycles, and efforts."""
    qN, vN, aN = nominal(np.arange(CYCLES) * DT)
    q, v, integral, before = np.zeros(3), np.zeros(3), np.zeros(3), None
    positions, efforts = [], []
    response = explained = np.full(3, np.nan)
    for n in range(CYCLES):
        e, de = qN[n] - q, vN[n] - v
        desired, s = relax(aN[n], e, de, integral), de + 2 * LAMBDA * e + LAMBDA**2 * integral
        cos, sin = np.cos(q[0]), np.sin(q[0])
        if before is not None:
            c0, s0, turning = np.cos(before["q"][0]), np.sin(before["q"][0]), before["v"][0]
            explained = regressor(c0, s0, turning, turning, response) @ HALF
        model = regressor(cos, sin, v[0], v[0] + s[0], desired) @ HALF
        now = {"q": q, "v": v, "response": response, "desired": desired, "s": s, "model": model}
        now["explained"] = explained
        effort = np.clip(control(now, before), -limit, limit)
        before = {**now, "effort": effort}
        positions.append(q)
        efforts.append(effort)
        H = np.array([[EXACT[1], EXACT[2], EXACT[0] * cos], [EXACT[2], EXACT[2], 0.0], [0, 0, 0]])
        H[2] = EXACT[0] * cos, 0.0, EXACT[3]
        push = [EXACT[4] * sin, 0.0, EXACT[0] * sin * v[0] ** 2]
        response = np.linalg.solve(H, effort + push)
        q, v, integral = q + DT * v, v + DT * response, integral + DT * e
    return np.array(positions), np.array(efforts)


def pd(nominal_response, e, de, integral):
    return nominal_response + LAMBDA**2 * e + 2 * LAMBDA * de


def feedback_pid(nominal_response, e, de, integral):
    return 3 * LAMBDA**2 * e + 3 * LAMBDA * de + LAMBDA**3 * integral


def feedback_pd(nominal_response, e, de, integral):
    return LAMBDA**2 * e + 2 * LAMBDA * de


def ours(*settings):
    model = (f"fpt_deformer.approximate.{name}={value}" for name, value in MODEL.items())
    settings = (f"plant_simulator.dt={DT}", *model, *settings)
    topics = topics_of("cart_beam_hamper", "fixed_model", settings, duration=CYCLES * DT)
    return topics["joint_states"].vectors["position"], topics["command"].vectors["effort"]


def agree(ours, theirs):
    for mine, other in zip(ours, theirs, strict=True):
        assert mine == pytest.approx(other, rel=1e-8, abs=1e-8)
    assert np.abs(theirs[0]).max() > 0.1


@pytest.mark.parametrize("kind", CONTROLLERS)
def test_a_compensator_in_the_loop(kind):
    given, controller = CONTROLLERS[kind]
    inertia = (f"inertia={MASS.tolist()}",) if kind in WITH_INERTIA else ()
    own = [f"fpt_deformer.compensator.{each}" for each in (f"kind={kind}", *inertia, *given)]
    agree(ours(*own), simulate(controller(), pd))


@pytest.mark.parametrize("relax", [feedback_pd, feedback_pid])
def test_feedback_alone(relax):
    own = f"trajectory_generator.error_relaxation={relax.__name__}"
    agree(ours(own), simulate(lambda now, before: now["model"], relax))


@pytest.mark.parametrize("kind", ["time_delay", "state_observer"])
def test_what_was_limited_is_known(kind):
    """What acted is what the next cycle starts from: nothing winds up."""
    given, controller = CONTROLLERS[kind]
    own = [f"fpt_deformer.compensator.{each}" for each in (f"kind={kind}", *given)]
    own += [f"fpt_deformer.compensator.inertia={MASS.tolist()}"]
    own += ["fpt_deformer.limit.effort=[150.0, 150.0, 150.0]"]
    theirs = simulate(controller(), pd, 150.0)
    assert (np.abs(theirs[1]) == 150.0).any()
    agree(ours(*own), theirs)
