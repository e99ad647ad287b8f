"""Integrators against SciPy: the order of convergence, energy, tolerance, first order plants."""

import math

import numpy as np
import pytest
from engine_runs import frames_of, settled_rms, stage_by_stage, topics_of
from scipy.integrate import RK45, solve_ivp
from stages_made import MS, NAN, QV, stages

from fpt_ros.errors import BadInput
from fpt_ros.experiments.experiment import load
from fpt_ros.integrators import INTEGRATORS
from fpt_ros.messages.frames import Command

START = {
    "plant_simulator.initial_position": "[0.4, -0.3, 0.2]",
    "plant_simulator.initial_velocity": "[1.0, 2.0, -1.0]",
}
EFFORT = [40.0, -7.0, 3.0]
CYCLES, DT = 4, 0.1


def tora(kind, substeps):
    settings = [f"{name}={value}" for name, value in START.items()]
    settings += [f"plant_simulator.dt={DT}", f"plant_simulator.substeps={substeps}"]
    plant = stages("tora", "adaptive", *settings, f"plant_simulator.integrator.kind={kind}").plant
    for cycle in range(CYCLES):
        plant.advance(Command(0, QV, [NAN] * 3, EFFORT), cycle * round(DT * 1000) * MS)
    return np.array(plant.state[:6])


def exact():
    plant = stages("tora").plant

    def slope(t, y):
        out = [0.0] * 3
        plant.plant.response(plant.coefficients, y[:3].tolist(), y[3:].tolist(), EFFORT, out)
        return [*y[3:], *out]

    y0 = [0.4, -0.3, 0.2, 1.0, 2.0, -1.0]
    return solve_ivp(slope, (0.0, CYCLES * DT), y0, "DOP853", rtol=1e-13, atol=1e-15).y[:, -1]


@pytest.mark.parametrize(
    ("kind", "order", "substeps"),
    [("explicit_euler", 1, 100), ("semi_implicit_euler", 1, 100), ("rk4", 4, 5)],
)
def test_halving_the_step_divides_the_error_by_two_to_the_order(kind, order, substeps):
    truth = exact()
    coarse, fine = (np.abs(tora(kind, n) - truth).max() for n in (substeps, 2 * substeps))
    assert math.log2(coarse / fine) == pytest.approx(order, abs=0.15)


def test_dopri5_keeps_its_tolerance_with_one_step_a_cycle():
    assert np.abs(tora("dopri5", 1) - exact()).max() < 1e-9


def test_dopri5_is_the_pair_of_scipy():
    """One step that is accepted at once has the same result; the estimated error is the same."""
    from fpt_ros.integrators import dopri5

    def response(c, q, v, effort, out):
        out[0] = -9.0 * math.sin(q[0]) - 0.3 * v[0]

    q, v, a, work = [1.0], [0.5], [0.0], [0.0] * 17
    h = 0.05
    dopri5.over(response)((1.0, 1.0), 2, h, (), (), q, v, a, work)
    found = solve_ivp(
        lambda t, y: [y[1], -9.0 * math.sin(y[0]) - 0.3 * y[1]],
        (0.0, h),
        [1.0, 0.5],
        "RK45",
        first_step=h,
        rtol=1.0,
        atol=1.0,
    ).y[:, -1]
    assert [q[0], v[0]] == pytest.approx(found, rel=1e-14)
    assert np.abs(dopri5.DIFFERENCE) == pytest.approx(np.abs(RK45.E), rel=1e-15)


def test_semi_implicit_euler_keeps_the_energy_of_a_pendulum():
    def response(c, q, v, effort, out):
        out[0] = -math.sin(q[0])

    def drift(kind):
        step = INTEGRATORS[kind].over(response)
        q, v, a = [2.0], [0.0], [0.0]
        energies = []
        for _ in range(20_000):
            step((), 2, 0.01, (), (), q, v, a, [])
            energies.append(0.5 * v[0] ** 2 - math.cos(q[0]))
        return np.abs(np.array(energies) + math.cos(2.0)).max()

    assert drift("semi_implicit_euler") < 0.02
    assert drift("explicit_euler") > 0.3


@pytest.mark.parametrize("kind", ["rk4", "dopri5"])
def test_a_plant_of_order_one(kind):
    """The Lorenz system with its inputs held, against SciPy; v is the mean rate of the cycle."""
    settings = ("plant_simulator.initial_position=[1.0, 2.0, 20.0]", "plant_simulator.dt=0.01")
    own = f"plant_simulator.integrator.kind={kind}"
    plant = stages("lorenz", "nonadaptive", *settings, own, "plant_simulator.substeps=4").plant
    command = Command(0, ("x", "y", "z"), [NAN] * 3, [1.0, -2.0, 3.0])
    plant.advance(command, 0)
    found = solve_ivp(
        lambda t, y: [
            10.0 * (y[1] - y[0]) + 1.0,
            y[0] * (28.0 - y[2]) - y[1] - 2.0,
            y[0] * y[1] - 8.0 / 3.0 * y[2] + 3.0,
        ],
        (0.0, 0.01),
        [1.0, 2.0, 20.0],
        "DOP853",
        rtol=1e-13,
        atol=1e-14,
    ).y
    assert list(plant.state[:3]) == pytest.approx(found[:, -1], rel=1e-8)


@pytest.mark.parametrize("kind", INTEGRATORS.names())
def test_nodes_and_engine_agree_to_the_last_bit(kind):
    loaded = load("duffing", settings=[f"plant_simulator.integrator.kind={kind}"], duration=0.05)
    seen = []
    stage_by_stage(loaded.loop(), lambda topic, frame: seen.append((topic, frame)))
    engine = frames_of(loaded.loop())
    assert len(seen) == len(engine)
    for (topic, frame), (other, same) in zip(seen, engine, strict=True):
        assert topic == other
        for x, y in zip(frame[2:], same[2:], strict=True):
            assert np.array_equal(np.array(x), np.array(y), equal_nan=True)


def test_a_plant_that_integrates_itself_takes_no_integrator():
    with pytest.raises(BadInput, match="integrates itself"):
        load("panda", settings=["plant_simulator.integrator.kind=rk4"])


def test_half_of_the_duffing_oscillators_error_is_that_of_its_explicit_euler():
    """Exact integrators agree with each other, and the same controller does better behind them."""
    rms = {
        kind: settled_rms(
            topics_of("duffing", settings=[f"plant_simulator.integrator.kind={kind}"]), 3.0
        )["q1"]
        for kind in INTEGRATORS.names()
    }
    assert rms["rk4"] == pytest.approx(rms["dopri5"], rel=1e-9)
    assert rms["rk4"] < 0.5 * rms["explicit_euler"]
    assert rms["rk4"] < rms["semi_implicit_euler"] < rms["explicit_euler"]
