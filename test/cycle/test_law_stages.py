"""Denoiser, trajectory, deformer and tuner: the first cycle, and what they refuse."""

import math
from dataclasses import replace

import numpy as np
import pytest
from stages_made import MS, NAN, QV, desired, estimate, frames_of, stages

from fpt_ros.cycle.fpt_deformer import FptDeformer
from fpt_ros.cycle.parameter_tuner import ParameterTuner
from fpt_ros.cycle.stage import indices
from fpt_ros.errors import BadInput
from fpt_ros.experiments import experiment
from fpt_ros.messages.frames import Command, Desired, JointStates, StateEstimate, Tuning


def test_no_response_is_known_in_the_first_cycle():
    denoiser = stages().denoiser
    first = denoiser.step(JointStates(0, QV, [1.0, 2.0, 3.0], [0.5, 0.0, 0.0], [0.0] * 3))
    assert list(first.positions) == [1.0, 2.0, 3.0]
    assert all(map(math.isnan, first.accelerations))
    second = denoiser.step(JointStates(2 * MS, QV, [1.0, 2.0, 3.0], [0.5, 0.1, -0.2], [0.0] * 3))
    assert list(second.accelerations) == pytest.approx([0.0, 50.0, -100.0])


def test_the_integral_is_of_forward_rectangles_over_the_time_that_passed():
    """I_0 = 0; I_n holds the errors before n. Nominal position at rest: amplitude 0."""
    trajectory = stages("tora", "adaptive", "trajectory_generator.amplitude=[0.0, 0.0]").trajectory
    integral, last = 0.0, 0.0
    for stamp, q3 in ((0, -1.0), (1, -0.5), (4, 0.25), (5, 0.0)):
        frame = StateEstimate(stamp * MS, QV, (9.0, 0.0, q3), (9.0, 0.0, 0.0), [NAN] * 3, [NAN] * 3)
        out = trajectory.step(frame)
        integral += {0: 0.0, 1: 1e-3, 4: 3e-3, 5: 1e-3}[stamp] * last
        last = -q3
        assert out.names == ("q3", "q2")
        expected = 3 * 36.0 * -q3 + 216.0 * integral
        assert out.accelerations == pytest.approx([expected, 0.0], rel=1e-12, abs=1e-15)


def test_time_of_the_trajectory_counts_from_its_first_cycle():
    trajectory = stages("vdp_rfpt").trajectory
    start = 1_700_000_000_000_000_000
    for k in (0, 700):
        out = trajectory.step(StateEstimate(start + k * MS, ("q1",), [0.0], [0.0], [NAN], [NAN]))
        assert out.positions[0] == pytest.approx(1.5 * math.sin(2.0 * k * 1e-3), rel=1e-15)
        assert out.stamp == start + k * MS


def test_the_trajectory_names_a_coordinate_that_the_plant_lacks():
    trajectory = stages().trajectory
    frame = StateEstimate(0, ("q1", "q2"), [0.0] * 2, [0.0] * 2, [NAN] * 2, [NAN] * 2)
    with pytest.raises(
        BadInput, match=r"state_estimate: the joint 'q3' is not there, only q1, q2$"
    ):
        trajectory.step(frame)
    assert indices(["b", "a"], ("a", "b", "c"), "x") == (1, 0)


@pytest.mark.parametrize(("name", "variant"), [("tora", "adaptive"), ("vdp_rfpt", "adaptive")])
def test_in_the_first_cycle_r_is_the_desired_response_itself(name, variant):
    seen = dict(frames_of(stages(name, variant, duration=0.001)))
    command, wanted = seen["command"], seen["desired"]
    for coordinate, response in zip(wanted.names, wanted.accelerations, strict=True):
        assert command.accelerations[command.names.index(coordinate)] == response


@pytest.mark.parametrize("variant", ["nonadaptive"])
def test_without_transformation_r_is_always_the_desired_response(variant):
    seen = frames_of(stages("tora", variant, duration=0.05))
    commands = [frame for name, frame in seen if name == "command"]
    wanted = [frame for name, frame in seen if name == "desired"]
    assert len(commands) == 50
    for command, want in zip(commands, wanted, strict=True):
        assert [command.accelerations[2], command.accelerations[1]] == want.accelerations
        assert math.isnan(command.accelerations[0])


RFPT_NORM = (
    "fpt_deformer.transformation=rfpt",
    "fpt_deformer.A=1e-2",
    "fpt_deformer.K=-1e2",
    "fpt_deformer.form=norm",
)
RFPT_SIGNED = (*RFPT_NORM[:3], "fpt_deformer.form=signed")


@pytest.mark.parametrize("settings", [(), RFPT_NORM, RFPT_SIGNED])
def test_a_coordinate_newly_controlled_starts_at_its_desired_response(monkeypatch, settings):
    """Time sharing: the set of names changes; who goes on is deformed, who is new is not."""
    deformer = stages("tora", "adaptive", *settings).deformer
    # TORA's own model needs both; here only r is looked at
    monkeypatch.setattr(deformer, "model", replace(deformer.model, effort=no_effort))
    deformer.step(estimate(0, [NAN] * 3), desired(0, ("q3",), [1.0]))
    only = deformer.step(estimate(1, [0.0, 0.0, 0.5]), desired(1, ("q3",), [1.1]))
    assert math.isnan(only.accelerations[1])
    both = deformer.step(estimate(2, [0.0, 7.0, 0.5]), desired(2, ("q3", "q2"), [1.2, 3.0]))
    assert both.accelerations[1] == 3.0
    assert both.accelerations[2] > only.accelerations[2] > 1.0
    other = deformer.step(estimate(3, [0.0, 7.0, 0.5]), desired(3, ("q2",), [3.5]))
    assert other.accelerations[1] not in (3.0, 3.5)
    assert math.isnan(other.accelerations[2])
    back = deformer.step(estimate(4, [0.0, 7.0, 0.5]), desired(4, ("q2", "q3"), [3.5, -1.0]))
    assert back.accelerations[2] == -1.0


def no_effort(coefficients, q, v, r, s, out):
    out[:] = [0.0] * len(out)


def test_the_deformer_refuses_a_coordinate_that_its_model_cannot_prescribe():
    values = experiment.load("tora").nodes["fpt_deformer"]
    by_hand = FptDeformer({**values, "controlled": []})  # as its first message has them
    with pytest.raises(BadInput, match=r"tora cannot prescribe the response of 'q1', only of q2"):
        by_hand.step(estimate(0, [NAN] * 3), desired(0, ("q1",), [1.0]))
    with pytest.raises(BadInput, match=r"desired: the joint 'q3' is not there, only q1$"):
        stages().deformer.step(estimate(0, [NAN] * 3), desired(0, ("q1",), [1.0]))


def test_deformation_starts_at_its_time_from_the_desired_response():
    seen = frames_of(stages("tora", "adaptive", "fpt_deformer.adaptive_from=0.01", duration=0.012))
    plain = frames_of(stages("tora", "nonadaptive", duration=0.012))
    r, without = (
        [frame.accelerations[1:] for name, frame in each if name == "command"]
        for each in (seen, plain)
    )
    assert r[:10] == without[:10]
    assert r[10] != without[10]
    wanted = [frame for name, frame in seen if name == "desired"][10]
    response = [frame for name, frame in seen if name == "state_estimate"][10].accelerations
    # (3.5) from r_9, which was the desired response of cycle 9
    h = np.array([response[1] - wanted.accelerations[1], response[2] - wanted.accelerations[0]])
    size = np.linalg.norm(h)
    star = 0.7130913716914226
    step = math.atanh(math.tanh(-0.1 * size + star) - 0.5) + 0.6 - star
    assert r[10] == pytest.approx(without[9] + step * h / size, rel=1e-12)


def test_tuning_gives_the_model_its_coefficients():
    deformer = stages("vdp_rfpt").deformer
    frame = StateEstimate(0, ("q1",), [2.0], [0.0], [NAN], [NAN])
    tuning = Tuning(0, ("m", "mu", "mu_c", "k", "beta", "lambda"), [3.0, 0, 0, 10.0, 0, 0])
    command = deformer.step(frame, Desired(0, ("q1",), [0.0], [0.0], [5.0], [0.0]), tuning)
    assert command.effort == [3.0 * 5.0 + 10.0 * 2.0]


def test_the_tuner_starts_with_the_approximate_model_and_then_follows_2_11():
    tuner = stages("vdp_rfpt", "adaptive", "parameter_tuner.alpha=2.0").tuner
    theta = np.array([9.0, 2.0, 7.0, 110.0, 0.9, 1.5])
    first = tuner.step(StateEstimate(0, ("q1",), [0.5], [-1.0], [NAN], [NAN]), None)
    assert first.names[:6] == ("m", "mu", "mu_c", "k", "beta", "lambda")
    assert first.names[6:] == ("precursor", "gain_factor")
    assert first.values == [*theta.tolist(), 0.0, 1.0]
    command = Command(0, ("q1",), [4.0], [60.0])
    second = tuner.step(StateEstimate(MS, ("q1",), [9.9], [9.9], [3.0], [NAN]), command)
    # q and v of cycle 0, where the force acted, and the response to it
    row = np.array([3.0, 0.25 * -1.0, 1.0, 0.5, 0.125, 0.03125])
    expected = theta + 1e-3 * 2.0 * (60.0 - row @ theta) * row / (row @ row + 1e-6)
    assert second.values[:6] == pytest.approx(expected, rel=1e-14)
    assert second.stamp == MS


def test_a_tuner_without_a_law_is_not_in_the_loop():
    tuner = ParameterTuner({})
    assert tuner.active is False
    assert tuner.inputs == ()
    assert list(tuner.state) == []
