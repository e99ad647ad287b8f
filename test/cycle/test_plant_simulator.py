"""The plant: explicit Euler, substeps, disturbance, noise, the safe command."""

import math

import numpy as np
import pytest
from stages_made import MS, NAN, QV, stages

from fpt_ros.messages.frames import Command, JointStates


def test_the_plant_shows_its_start_and_then_explicit_euler():
    plant = stages(
        "tora",
        "adaptive",
        "plant_simulator.initial_position=[0.1, 0.2, 0.3]",
        "plant_simulator.initial_velocity=[1.0, 2.0, 3.0]",
    ).plant
    shown = plant.measure(0, 0)
    assert shown == JointStates(0, QV, shown[2], shown[3], shown[4])
    assert [list(x) for x in shown[2:]] == [[0.1, 0.2, 0.3], [1.0, 2.0, 3.0], [0.0] * 3]
    plant.advance(Command(0, QV, [NAN] * 3, [5.0, 7.0, 0.0]), 0)
    after = plant.measure(MS, 1)
    assert list(after.position) == [0.1 + 0.001, 0.2 + 0.001 * 2.0, 0.3 + 0.001 * 3.0]
    assert list(after.effort) == [5.0, 7.0, 0.0]
    # row 2 of (2.23): theta (q1'' + q2'') = Q2
    accelerations = [(b - a) / 0.001 for a, b in zip([1.0, 2.0, 3.0], after.velocity, strict=True)]
    assert 20.0 * (accelerations[0] + accelerations[1]) == pytest.approx(7.0, abs=1e-9)
    assert shown.position[0] == 0.1  # what was shown does not change any more


def test_substeps_are_as_many_small_cycles_with_the_force_held():
    coarse = stages("tora", "adaptive", "plant_simulator.substeps=4").plant
    fine = stages("tora", "adaptive", "plant_simulator.dt=0.00025").plant
    command = Command(0, QV, [NAN] * 3, [40.0, -7.0, 0.0])
    for cycle in range(50):
        coarse.advance(command, cycle * MS)
    for cycle in range(200):
        fine.advance(command, cycle * MS // 4)
    assert list(coarse.state) == pytest.approx(list(fine.state), rel=1e-12, abs=1e-15)
    assert coarse.state[0] != 0.0


def test_the_disturbance_goes_on_within_a_cycle():
    settings = ("plant_simulator.dt=0.5", "plant_simulator.substeps=2")
    plant = stages("vdp_rfpt", "adaptive", *settings, duration=5.0).plant
    d = [
        100.0 * x
        for x in (180.0 / 420.0, plant.disturbance.force((1.0, 1.0), [], 0.25, 0.25, 0, 0))
    ]
    plant.advance(Command(0, ("q1",), [0.0], [0.0]), 0)
    # the first half from rest at 0, the second at q = 0 with the velocity of the first
    v = 0.25 * d[0] / 10.0
    v += 0.25 * (d[1] + 3.0 * v) / 10.0
    assert plant.state[1] == pytest.approx(v, rel=1e-12)
    assert d[0] != pytest.approx(d[1], rel=1e-3)


def test_the_disturbance_acts_on_its_coordinate_at_the_time_of_the_cycle():
    settings = ("plant_simulator.disturbance.amplitude=70.0",)
    plant = stages("vdp_rfpt", "adaptive", *settings).plant
    plant.advance(Command(0, ("q1",), [0.0], [0.0]), 0)
    at_zero = plant.state[1] / 0.001 * 10.0  # from rest: m q'' = d
    assert at_zero == pytest.approx((0 + 4 * 30 + 60) / 6.0)
    plant = stages("vdp_rfpt", "adaptive", *settings).plant
    plant.advance(Command(0, ("q1",), [0.0], [0.0]), 1000 * MS)
    assert plant.state[1] / 0.001 * 10.0 == pytest.approx((30 + 4 * 60 + 20) / 6.0)
    assert list(plant.measure(0, 0).effort) == [0.0]  # the disturbance is no effort
    tora = stages(
        "tora",
        "adaptive",
        "plant_simulator.disturbance.kind=bspline",
        "plant_simulator.disturbance.amplitude=70.0",
        "plant_simulator.disturbance.coordinate=q3",
    ).plant
    tora.advance(Command(0, QV, [NAN] * 3, [0.0] * 3), 0)
    assert tora.state[5] > 0.0
    assert tora.state[3] < 0.0  # the cart is pushed, the beam swings back


def test_noise_is_reproducible_by_seed():
    settings = ("plant_simulator.noise.position=1e-3", "plant_simulator.noise.velocity=2e-3")

    def measured(seed):
        plant = stages("tora", "adaptive", *settings, duration=2.0, seed=seed).plant
        frames = [plant.measure(0, cycle) for cycle in range(2000)]
        return np.array([[*frame.position, *frame.velocity] for frame in frames])

    one, same, other = measured(1), measured(1), measured(2)
    assert (one == same).all()
    assert not (one == other).any()
    assert one[:, :3].std() == pytest.approx(1e-3, rel=0.05)
    assert one[:, 3:].std() == pytest.approx(2e-3, rel=0.05)
    assert np.abs(np.corrcoef(one.T) - np.eye(6)).max() < 0.1
    assert (measured(1)[::-1] == one[::-1]).all()


def test_noise_is_that_of_the_cycle_whoever_asks_when():
    """A plant that comes back in cycle 7 shows what it would have shown."""
    options = {"duration": 0.02, "seed": 3}
    plant = stages("tora", "adaptive", "plant_simulator.noise.position=1e-3", **options).plant
    again = stages("tora", "adaptive", "plant_simulator.noise.position=1e-3", **options).plant
    sequence = [list(plant.measure(0, cycle).position) for cycle in range(20)]
    assert list(again.measure(0, 7).position) == sequence[7]


def test_noise_is_measured_but_does_not_move_the_plant():
    quiet, noisy = (
        stages("tora", "adaptive", *settings, duration=0.1, seed=1).plant
        for settings in ((), ("plant_simulator.noise.position=0.1",))
    )
    for plant in (quiet, noisy):
        plant.measure(0, 0)
        plant.advance(Command(0, QV, [NAN] * 3, [1.0, 1.0, 0.0]), 0)
    assert list(quiet.state) == list(noisy.state)
    assert list(quiet.measure(MS, 1).velocity) == list(noisy.measure(MS, 1).velocity)


def test_the_safe_command():
    plant = stages("tora", "adaptive", "plant_simulator.safe_effort=-2.5").plant
    command = plant.safe_command(3 * MS)
    assert (command.stamp, command.names, command.effort) == (3 * MS, QV, [-2.5] * 3)
    assert all(map(math.isnan, command.accelerations))
    assert plant.timeout == 100 * MS
