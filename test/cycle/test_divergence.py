"""What a run that diverges says: time, coordinate, remedy."""

import math

import pytest
from stages_made import LOST, MS, NAN, QV, desired, diverged, estimate, stages

from fpt_ros.messages.frames import Command, Tuning


def test_divergence_tells_time_and_coordinate():
    plant = stages("tora", "adaptive", "plant_simulator.limit.acceleration=10").plant
    before = list(plant.state)
    command = Command(0, QV, [NAN] * 3, [0.0, 1e4, 0.0])
    error = diverged(plant.advance, command, 1234 * MS)
    assert str(error).startswith("diverged at t = 1.234 s: the acceleration of q1, ")
    assert str(error).endswith(f" is over its limit of 10 in cycle 1234{LOST}")
    assert (error.time, error.cycle) == (1.234, 1234)
    assert (error.coordinate, error.quantity) == ("q1", "acceleration")
    assert (abs(error.value) > 10.0, error.limit) == (True, 10.0)
    assert list(plant.state) == before


def test_divergence_of_a_position():
    plant = stages("tora", "adaptive", "plant_simulator.initial_velocity=[0, 0, -2000000]").plant
    error = diverged(plant.advance, Command(0, QV, [NAN] * 3, [0.0] * 3), 0)
    assert str(error) == (
        "diverged at t = 0 s: the position of q3, -2000, is over its limit of 1000 in cycle 0"
        + LOST
    )


@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_divergence_of_an_effort(bad):
    plant = stages().plant
    error = diverged(plant.advance, Command(0, QV, [NAN] * 3, [0.0, bad, 0.0]), 5 * MS)
    assert (
        str(error)
        == f"diverged at t = 0.005 s: the effort of q2, {bad}, is not finite in cycle 5{LOST}"
    )


def test_divergence_of_the_transformation_names_a_remedy():
    deformer = stages("tora", "adaptive", "fpt_deformer.guard=false").deformer
    deformer.step(estimate(0, [NAN] * 3), desired(0, ("q3", "q2"), [0.0, 0.0]))
    error = diverged(
        deformer.step,
        estimate(1, [0.0, 0.0, 20.0]),
        desired(1, ("q3", "q2"), [0.0, 0.0]),
    )
    assert str(error) == (
        "diverged at t = 0.001 s: the deformed response of q3, nan, is not finite "
        "in cycle 1 (||h|| = 20 with A = -0.1 is outside the domain of the transformation: "
        "a smaller |fpt_deformer.A|, or guard: true)"
    )


def test_divergence_of_the_model_at_a_division_by_zero():
    deformer = stages().deformer
    lost = Tuning(0, ("mL", "mL2_theta", "theta", "m_M", "mgL"), [0.0] * 5)
    error = diverged(
        deformer.step, estimate(0, [NAN] * 3), desired(0, ("q3", "q2"), [1.0, 1.0]), lost
    )
    assert error.quantity == "model's effort"
    assert "division by zero" in str(error)


def test_divergence_of_the_plant_where_a_function_is_not_defined():
    plant = stages("vdp_rfpt").plant
    plant.state[0] = 1e200
    error = diverged(plant.advance, Command(0, ("q1",), [0.0], [0.0]), 0)
    assert error.quantity == "acceleration"
    assert not math.isfinite(error.value)
    tora = stages().plant
    tora.state[0] = math.inf
    error = diverged(tora.advance, Command(0, QV, [NAN] * 3, [0.0] * 3), 0)
    assert (error.quantity, "is not finite in cycle 0 (" in str(error)) == ("response", True)
