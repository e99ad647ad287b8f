"""The five stages: order of events, first cycle, live changes, divergence, noise."""

import math
from dataclasses import replace

import engine_runs
import numpy as np
import pytest
from engine_runs import stage_by_stage

from fpt_ros.cycle.fpt_deformer import FptDeformer
from fpt_ros.cycle.parameter_tuner import ParameterTuner
from fpt_ros.cycle.stage import indices
from fpt_ros.engine.engine import CHUNK, Engine
from fpt_ros.errors import BadInput, Diverged
from fpt_ros.experiments import experiment
from fpt_ros.messages.frames import Command, Desired, JointStates, StateEstimate, Tuning

MS = 1_000_000
QV = ("q1", "q2", "q3")
NAN = math.nan
LOST = " (control is lost: fpt gain shows which fpt_deformer.A converges, and of which sign)"


def stages(name="tora", variant="adaptive", *settings, **options):
    return experiment.load(name, variant, settings, **options).loop()


def frames_of(loop):
    seen = []
    stage_by_stage(loop, lambda topic, frame: seen.append((topic.name, frame)))
    return seen


def frames_of_the_engine(loop):
    return [(topic.name, frame) for topic, frame in engine_runs.frames_of(loop)]


def estimate(cycle, response, q=(0.1, 0.2, -0.1), v=(0.0, 0.0, 0.0)):
    return StateEstimate(cycle * MS, QV, q, v, response, [NAN] * 3)


def desired(cycle, names, response):
    zeros = [0.0] * len(names)
    return Desired(cycle * MS, names, zeros, zeros, response, zeros)


# --- order of events


@pytest.mark.parametrize("frames_of", [frames_of, frames_of_the_engine])
def test_order_and_stamps_of_the_events_of_a_cycle(frames_of):
    seen = frames_of(stages("vdp_rfpt", duration=0.003))
    cycle = ["joint_states", "state_estimate", "desired", "tuning", "command"]
    assert [name for name, _ in seen] == cycle * 3
    assert [frame.stamp for _, frame in seen] == [k * MS for k in range(3) for _ in cycle]
    seen = frames_of(stages("tora", duration=0.002))
    without_tuner = ["joint_states", "state_estimate", "desired", "command"]
    assert [name for name, _ in seen] == without_tuner * 2


def test_the_inputs_of_the_stages():
    def wants(stage):
        return [(each.topic.name, each.lag) for each in stage.inputs]

    loop = stages("vdp_rfpt")
    assert wants(loop.plant) == [("command", 0)]
    assert wants(loop.denoiser) == [("joint_states", 0)]
    assert wants(loop.trajectory) == [("state_estimate", 0)]
    assert wants(loop.tuner) == [("state_estimate", 0), ("command", 1)]
    assert wants(loop.deformer) == [("state_estimate", 0), ("desired", 0), ("tuning", 0)]
    loop = stages("tora")
    assert wants(loop.tuner) == []
    assert wants(loop.deformer) == [("state_estimate", 0), ("desired", 0)]


def test_number_of_cycles_and_progress():
    told = []
    engine = Engine(stages(duration=10.0))
    assert (engine.cycles, engine.done) == (10000, 0)
    engine.run(told.append)
    assert engine.done == 10000
    assert told == [0, CHUNK, 10000]
    assert stages(duration=0.0106).plant.cycles == 11


def test_two_runs_are_the_same_to_the_last_bit():
    for frames in (frames_of, frames_of_the_engine):
        first, second = (frames(stages("vdp_rfpt", duration=0.5)) for _ in range(2))
        assert repr(first) == repr(second)


# --- the plant


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


# --- divergence


def diverged(call, *args):
    with pytest.raises(Diverged) as caught:
        call(*args)
    assert "\n" not in str(caught.value)
    assert caught.value.exit_status == 1
    return caught.value


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


# --- denoiser and trajectory


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


# --- deformer


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


# --- tuner


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


# --- live changes


def test_a_live_change_keeps_what_was_remembered():
    loop = stages("tora", duration=0.02)
    frames_of(loop)
    for stage, change in (
        (loop.deformer, {"A": -0.2, "approximate.m": 11}),
        (loop.trajectory, {"lambda": 5.0}),
        (loop.plant, {"exact.m": 21.0, "noise.position": 1e-3}),
    ):
        state, clock = list(stage.state), list(stage.clock)
        assert any(state)
        stage.configure(change)
        assert list(stage.state) == pytest.approx(state, abs=0.0, nan_ok=True)
        assert list(stage.clock) == clock
        for name, value in change.items():
            assert stage.values[name] == value


def test_a_live_change_takes_effect():
    def next_r(change):
        deformer = stages().deformer
        deformer.step(estimate(0, [NAN] * 3), desired(0, ("q3", "q2"), [0.0, 0.0]))
        deformer.configure(change)
        out = deformer.step(estimate(1, [0.0, 1.0, 1.0]), desired(1, ("q3", "q2"), [0.0, 0.0]))
        return out.accelerations[2], out.effort[0]

    as_it_was, doubled = next_r({}), next_r({"A": -0.2})
    assert doubled[0] == pytest.approx(2.0 * as_it_was[0], rel=0.2)
    heavier = next_r({"approximate.m": 20.0})
    assert heavier[0] == as_it_was[0]
    assert heavier[1] != as_it_was[1]


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"A": "fast"}, "fpt_deformer.A: 'fast' is not valid, it takes a number"),
        ({"gain": 1.0}, "fpt_deformer has no parameter 'gain'"),
        ({"A": -0.2, "K": 1.9}, "K = 1.9 and D = 0.6 give no fixed point"),
        ({"approximate.m": 20.0, "K": 1.9}, "K = 1.9 and D = 0.6 give no fixed point"),
        ({"approximate.m": 0.0}, "fpt_deformer.approximate.m: 0.0 is not valid"),
        ({"transformation": "none"}, "fpt_deformer.transformation cannot change while the loop"),
        ({"A": -0.2, "form": "signed"}, "fpt_deformer.form cannot change while the loop runs"),
    ],
)
def test_a_bad_live_change_is_refused_and_nothing_is_changed(change, reason):
    changed, untouched = stages().deformer, stages().deformer
    for deformer in (changed, untouched):
        deformer.step(estimate(0, [NAN] * 3), desired(0, ("q3", "q2"), [0.0, 0.0]))
    before = dict(changed.values)
    with pytest.raises(BadInput) as caught:
        changed.configure(change)
    assert reason in str(caught.value)
    assert "\n" not in str(caught.value)
    assert changed.values == before
    frames = estimate(1, [0.0, 1.0, 1.0]), desired(1, ("q3", "q2"), [0.0, 0.0])
    assert repr(changed.step(*frames)) == repr(untouched.step(*frames))


def test_what_may_not_change_in_flight_is_refused_with_what_may():
    with pytest.raises(BadInput) as caught:
        stages().plant.configure({"dt": 0.002})
    message = str(caught.value)
    assert message.startswith("plant_simulator.dt cannot change while the loop runs, only ")
    assert "exact.m" in message
    assert "seed" not in message
    stages().plant.configure({"dt": 0.001})  # the value that it has
    with pytest.raises(BadInput, match=r"cannot change while the loop runs, only none$"):
        stages().denoiser.configure({"method": "wavelet"})


def test_a_bad_live_list_is_refused():
    trajectory = stages().trajectory
    with pytest.raises(BadInput, match=r"amplitude: 1 given, 2 needed \(q3, q2\)"):
        trajectory.configure({"amplitude": [1.0]})
    assert trajectory.values["amplitude"] == [0.3, 0.5]
    out = trajectory.step(estimate(0, [NAN] * 3))
    assert len(out.positions) == 2


def test_a_stage_can_be_made_from_its_parameters_alone():
    loaded = experiment.load("tora")
    values = loaded.nodes["fpt_deformer"]
    assert FptDeformer(values).values == values
    with pytest.raises(BadInput, match=r"^fpt_deformer\.model is missing: it takes a word$"):
        FptDeformer({})
