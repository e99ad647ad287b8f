"""Limits of the effort, anti-windup, take-over and stop, in the stage that gives the command."""

import math
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from engine_runs import frames_of
from faulty_actuators import Faulty, as_sent, cut, late, lost, off
from hypothesis import given
from hypothesis import strategies as st

from fpt_ros.cycle.acting import eliminate
from fpt_ros.cycle.run import Run
from fpt_ros.engine.engine import Engine
from fpt_ros.errors import BadInput, Diverged
from fpt_ros.experiments.experiment import load
from fpt_ros.messages.frames import Command, Desired, StateEstimate

EXAMPLE = Path(__file__).parents[2] / "examples" / "foreign_robot"
BRAKED = range(700, 950)


@pytest.fixture
def arm(monkeypatch):
    """The two-link arm, 4 s, with settings."""
    monkeypatch.chdir(EXAMPLE)

    def make(*settings, duration=4.0):
        words = [f"fpt_deformer.{text}" for text in settings]
        return load("arm.yaml", settings=words, duration=duration)

    return make


@pytest.mark.parametrize("kind", ["acted", "clamp"])
@pytest.mark.parametrize("fault", [off(0, 250), off(700, 950)])
def test_the_loop_recovers_from_actuators_that_were_off(arm, kind, fault):
    without = Faulty(arm("anti_windup=none"), fault)
    with_it = Faulty(arm(f"anti_windup={kind}"), fault)
    plain = Faulty(arm("adaptive_from=1e9"), fault)
    assert without.rms() > 0.5
    assert with_it.rms() < plain.rms()


@pytest.mark.parametrize("kind", ["acted", "clamp"])
def test_actuators_cut_below_what_the_motion_needs(arm, kind):
    without, with_it = (
        Faulty(arm(f"anti_windup={each}", duration=6.0), cut(5.0)) for each in ("none", kind)
    )
    assert with_it.rms() < 0.1 * without.rms()


def test_the_loop_recovers_from_a_brake(arm):
    def brake(cycle):
        return cycle in BRAKED

    healthy = Faulty(arm("anti_windup=acted"), as_sent)
    braked = Faulty(arm("anti_windup=acted"), as_sent, brake)
    without = Faulty(arm("anti_windup=none"), as_sent, brake)
    assert braked.rms(0.2) < 1.1 * healthy.rms(0.2)
    assert without.rms(0.2) > 0.5


@pytest.mark.parametrize(("fault", "size"), [(lost, 0.1), (late, 3), (late, 8)])
def test_single_late_or_lost_commands_leave_the_law_as_it_is(arm, fault, size):
    """The thesis's law goes on from its own last r, which bears them best (robots.md)."""
    plain, with_it = (Faulty(arm(f"anti_windup={kind}"), fault(size)) for kind in ("none", "acted"))
    assert with_it.errors == plain.errors


def test_nothing_limited_changes_no_bit(arm):
    plain, with_it = (
        Faulty(arm(f"anti_windup={kind}", duration=0.5), as_sent) for kind in ("none", "acted")
    )
    assert [each.effort for each in plain.commands] == [each.effort for each in with_it.commands]


def test_a_saturated_van_der_pol_keeps_the_error_of_computed_torque():
    """|u| < 6: the learning of an effort that is cut anyway must not cost anything."""

    def rms(*settings):
        loaded = load("vdp_second_order", settings=settings, duration=10.0)
        engine = Engine(loaded.loop())
        try:
            engine.run()
        except Diverged:
            return math.inf
        topics = engine.topics()
        error = topics["desired"].column("positions", "q1") - topics["joint_states"].column(
            "position", "q1"
        )
        return float(np.sqrt(np.mean(error**2)))

    limit = "fpt_deformer.limit.effort=[6.0]"
    learned = rms(limit, "fpt_deformer.anti_windup=acted")
    assert learned < 1.05 * rms(limit, "fpt_deformer.adaptive_from=1e9")
    assert rms(limit) > 1.5 * learned


@pytest.mark.parametrize("kind", ["none", "clamp", "acted"])
def test_engine_and_stages_have_the_same_bits(kind):
    settings = [
        "fpt_deformer.limit.effort=[150.0, 20.0, 50.0]",
        "fpt_deformer.limit.rate=[4.0e4, 4.0e4, 4.0e4]",
        "fpt_deformer.take_over=0.05",
        f"fpt_deformer.anti_windup={kind}",
    ]
    loaded = load("tora", settings=settings, duration=0.4)
    engine = Engine(loaded.loop())
    engine.run()
    ours = engine.topics()["command"]
    frames = [frame for topic, frame in frames_of(loaded.loop()) if topic.name == "command"]
    assert len(frames) == 400
    for field in ("effort", "accelerations"):
        theirs = np.array([getattr(frame, field) for frame in frames])
        assert np.array_equal(ours.vectors[field], theirs, equal_nan=True), field
    assert (np.abs(ours.vectors["effort"]) <= [150.0, 20.0, 50.0]).all()
    assert (np.abs(ours.vectors["effort"]) == 150.0).any()  # it does limit


def test_rate_limit_and_first_command(arm):
    """The first command is the effort that acts; from there it goes at the rate that is allowed."""
    run = Faulty(arm("limit.rate=[50.0, 20.0]", "anti_windup=acted", duration=1.0), as_sent)
    efforts = np.array([each.effort for each in run.commands])
    assert (efforts[0] == run.measured[0].effort).all()
    steps = np.abs(np.diff(efforts, axis=0))
    assert (steps <= np.array([50.0, 20.0]) * 0.002 * (1 + 1e-12)).all()
    assert run.rms(0.2) < 0.05


@pytest.mark.parametrize(("kind", "largest"), [("none", 0.75), ("acted", 2.0)])
def test_take_over_is_without_a_jump(arm, kind, largest):
    """From 7.5 N m on, which would be gone at once; the steps of the learning are left."""
    loop = arm("take_over=0.2", f"anti_windup={kind}", duration=0.6).loop()
    loop.plant.memory.effort[0] = 7.5  # what another controller exerts
    frames = [frame for _, frame in frames_of(loop)]
    commands = [each.effort for each in frames if isinstance(each, Command)]
    assert list(commands[0]) == [7.5, 0.0]
    assert max(abs(b[0] - a[0]) for a, b in pairwise(commands)) < largest


def test_a_stop_commands_the_safe_effort_and_the_release_begins_anew(arm):
    loop = arm("safe_effort=[1.0, -2.0]", "anti_windup=acted", "take_over=0.1").loop()
    efforts, measured = [], []
    for topic, frame in Run(loop).frames():
        if topic.name == "joint_states":
            measured.append(frame)
            if len(measured) in (600, 700):
                loop.deformer.configure({"stopped": len(measured) == 600})
        if topic.name == "command":
            efforts.append(tuple(frame.effort))
    assert set(efforts[599:699]) == {(1.0, -2.0)}
    assert efforts[598] != (1.0, -2.0)
    assert efforts[699] == pytest.approx((1.0, -2.0), abs=1e-12)
    assert math.dist(efforts[699], efforts[700]) < 2.0
    assert math.isfinite(efforts[-1][0])


HOLD = (
    "when_stopped=hold",
    "hold.stiffness=[400.0, 200.0]",
    "hold.damping=[40.0, 15.0]",
    "safe_effort=[1.0, 0.0]",
    "limit.effort=[8.0, 6.0]",
)


def test_a_stop_that_holds_stands_at_the_position_where_it_began(arm):
    """A spring and a damper: the efforts that the formula gives, and an arm at rest in the end."""
    loaded, stop, release = arm(*HOLD), 500, 1800
    changes = {
        stop: {"fpt_deformer": {"stopped": True}},
        release: {"fpt_deformer": {"stopped": False}},
    }
    engine = Engine(loaded.loop(), changes=changes)
    engine.run()
    topics = engine.topics()
    command, seen = topics["command"].vectors["effort"], topics["state_estimate"].vectors
    q, v = seen["positions"], seen["velocities"]
    spring = np.array([1.0, 0.0]) + np.array([400.0, 200.0]) * (q[stop] - q)
    wanted = np.clip(spring - np.array([40.0, 15.0]) * v, [-8.0, -6.0], [8.0, 6.0])
    assert np.array_equal(command[stop:release], wanted[stop:release])
    assert (np.abs(command[stop:release]) == [8.0, 6.0]).any()  # it does limit
    assert not np.array_equal(command[release], wanted[release])
    assert np.abs(v[stop]).max() > 0.1
    assert np.abs(v[release - 1]).max() < 1e-3
    assert np.abs(q[release - 1] - q[stop]).max() < 0.05  # what weight and safe effort leave
    frames = [f for _, f in Run(loaded.loop(), changes=changes).frames() if isinstance(f, Command)]
    assert np.array_equal(command, [frame.effort for frame in frames])


def test_to_hold_needs_a_stiffness():
    with pytest.raises(BadInput, match=r"fpt_deformer.hold.stiffness: 0 given, 3 needed"):
        load("tora", settings=["fpt_deformer.when_stopped=hold"])


def test_limits_of_another_length_are_refused():
    with pytest.raises(BadInput, match=r"fpt_deformer.limit.effort: 2 given, 3 needed"):
        load("tora", settings=["fpt_deformer.limit.effort=[1.0, 2.0]"])


wild = st.floats(allow_nan=False, allow_infinity=False, width=64)


@given(
    st.lists(st.tuples(*[st.lists(wild, min_size=3, max_size=3)] * 5), min_size=1, max_size=6),
    st.sampled_from(["none", "clamp", "acted"]),
)
def test_no_command_is_beyond_the_limit_whatever_comes(cycles, kind):
    settings = ["fpt_deformer.limit.effort=[3.0, 2.0, 1.0]", f"fpt_deformer.anti_windup={kind}"]
    loop = load("tora", settings=settings).loop()
    deformer, names, controlled = loop.deformer, loop.plant.coordinates, ("q3", "q2")
    for k, (q, v, a, wanted, acted) in enumerate(cycles):
        stamp = k * 1_000_000
        measured = loop.plant.measure(stamp, k)._replace(effort=acted)
        two = wanted[:2]
        estimate = StateEstimate(stamp, names, q, v, a, [math.nan] * 3)
        rest = [] if kind == "none" else [measured]
        try:
            command = deformer.step(estimate, Desired(stamp, controlled, two, two, two, two), *rest)
        except Diverged:
            return
        assert all(
            abs(u) <= limit for u, limit in zip(command.effort, (3.0, 2.0, 1.0), strict=True)
        )


@given(st.lists(st.floats(-1.0, 1.0), min_size=12, max_size=12))
def test_elimination_solves(numbers):
    A = np.array(numbers).reshape(3, 4)
    A[:, :3] += 4.0 * np.eye(3)
    flat = A.ravel().tolist()
    assert eliminate(flat, 3) == 1
    expected = np.linalg.solve(A[:, :3], A[:, 3])
    assert np.allclose([flat[3], flat[7], flat[11]], expected, rtol=1e-9, atol=1e-9)
