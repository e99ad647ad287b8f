"""A robot that fpt_ros does not simulate, in wall time: the example, as its guide has it."""

import importlib.util
import itertools
import math
import os
import random
import signal
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
import samples
from command import forked_fpt, fpt_json

from fpt_ros.bags.reader import read_run
from fpt_ros.cycle.matcher import Matcher
from fpt_ros.experiments.experiment import load
from fpt_ros.messages.frames import JointStates

EXAMPLE = Path(__file__).parents[2] / "examples" / "foreign_robot"
DURATION = 6.0
SETTINGS = ("denoiser.method=finite_difference",)
ALIKE = itertools.repeat(None)
"""Gaps of one cycle time."""

FAULTS = ("--jitter", "0.2", "--lost", "0.01", "--no-velocity", "--best-effort")
ENOUGH = 450.0
"""Cycles a second: below it the machine is too busy for 500 Hz."""

SPEEDS = (0.2, 1.0)
"""Of the robot's time to the wall's. With the first a machine that runs other tests keeps up."""


@pytest.fixture
def example(monkeypatch):
    monkeypatch.chdir(EXAMPLE)
    spec = importlib.util.spec_from_file_location("robot", EXAMPLE / "robot.py")
    robot = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(robot)
    return robot


@pytest.fixture
def urgent():
    """Robot and loop go before all else, as on the computer of a robot, where that is allowed."""
    before = os.getpriority(os.PRIO_PROCESS, 0)
    with suppress(PermissionError):
        os.setpriority(os.PRIO_PROCESS, 0, -15)  # what is started from here inherits it
    yield
    os.setpriority(os.PRIO_PROCESS, 0, before)


@pytest.fixture
def start_robot():
    started = []

    def start(*options):
        command = [sys.executable, EXAMPLE / "robot.py", *options]
        started.append(subprocess.Popen(command, stdout=subprocess.PIPE, text=True))
        return started[-1]

    yield start
    for process in started:
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=30)


def loop_of(adaptive_from=0.0):
    """The stages that control the arm, and the matcher of the first, in real time."""
    settings = [*SETTINGS, f"fpt_deformer.adaptive_from={adaptive_from}"]
    loop = load("arm.yaml", settings=settings, duration=DURATION).loop()
    for stage in loop.answering():
        stage.clock[0] = stage.clock[1] = -1
    return loop, Matcher(loop.denoiser.inputs, loop.plant.cycle_time, realtime=True)


class Arm:
    """The example's arm in the test's own time."""

    def __init__(self, robot):
        self.robot, self.q, self.v, self.effort = robot, [0.0, 0.0], [0.0, 0.0], [0.0, 0.0]

    def measured(self, stamp):
        nan = [math.nan] * 2
        return JointStates(stamp, self.robot.EFFORTS, list(self.q), nan, list(self.effort))

    def move(self, span):
        steps = math.ceil(span / self.robot.STEP)
        for _ in range(steps):
            a = self.robot.accelerations(self.q, self.v, self.effort)
            for i in range(2):
                self.v[i] += span / steps * a[i]
                self.q[i] += span / steps * self.v[i]


def lockstep_error(robot, adaptive_from, gaps=ALIKE, stamp_error=lambda: 0.0):
    """rms of the tracking errors of the same arm, when it waits for each command.

    ``gaps`` [s] from state to state, ``None``: a cycle time; its stamps are late by
    ``stamp_error()`` [s].
    """
    loop, matcher = loop_of(adaptive_from)
    arm, errors, times, t = Arm(robot), [], [], 0.0
    while t < DURATION:
        measured = arm.measured(round((t + stamp_error()) * 1e9))
        matcher.take(0, measured)
        if matcher.newest():
            estimate = loop.denoiser.step(measured)
            desired = loop.trajectory.step(estimate)
            arm.effort = loop.deformer.step(estimate, desired, measured).effort
            errors.append(np.subtract(desired.positions, arm.q))
            times.append(t)
        span = next(gaps) or loop.plant.dt
        arm.move(span)
        t += span
    return settled(np.array(errors), np.array(times))


def bursts(random):
    """Gaps of a busy machine: a long one now and then, and short ones after it."""
    while True:
        yield random.uniform(0.0016, 0.0024)
        if random.random() < 0.05:
            yield random.uniform(0.01, 0.045)
            for _ in range(random.randint(1, 4)):
                yield random.uniform(1e-4, 5e-4)


def settled(errors, time):
    return math.sqrt(np.mean(errors[time > 2.5] ** 2))


def recorded_error(bag):
    """The same of a recording, each reference against the state that was measured at its time."""
    topics = read_run(bag).topics
    desired, measured = topics["desired"], topics["joint_states"]
    common, mine, theirs = np.intersect1d(desired.stamps, measured.stamps, return_indices=True)
    errors = [
        desired.column("positions", name)[mine] - measured.column("position", name)[theirs]
        for name in ("shoulder", "elbow")
    ]
    return settled(np.transpose(errors), (common - common[0]) * 1e-9)


@pytest.mark.usefixtures("urgent")
@pytest.mark.parametrize("speed", SPEEDS if samples.whole else SPEEDS[:1])
def test_a_robot_of_five_joints_with_jitter_losses_and_no_velocity(
    tmp_path, example, start_robot, speed
):
    start_robot(*FAULTS, "--speed", str(speed))
    bag = tmp_path / "bag"
    settings = [word for text in SETTINGS for word in ("--set", text)]
    result = fpt_json(
        "run", "arm.yaml", "--no-plant", "--duration", DURATION / speed, "--record", bag, *settings,
        cwd=EXAMPLE,
    )  # fmt: skip
    assert result["complete"] is True
    error = recorded_error(bag)
    assert error < 0.3 * lockstep_error(example, 1e9)  # what it is without the adaptation
    if not samples.whole:
        return  # how near it comes depends on what else the machine does
    assert result["cycles_per_second"] > ENOUGH * speed
    assert error < 2.0 * lockstep_error(example, 0.0)


@pytest.mark.parametrize(("late_by", "error"), [(0.0, 0.005), (3e-4, 0.1)])
def test_states_in_bursts_do_not_lose_the_arm(example, late_by, error):
    """Where stamps are inexact, states that are too close show false velocities: 5 to 7 rad."""
    for seed in range(5):
        chance = random.Random(seed)
        of_seed = lockstep_error(
            example, 0.0, bursts(chance), lambda chance=chance: chance.uniform(0.0, late_by)
        )
        assert of_seed < error


def test_options_of_a_robot_without_one():
    done = forked_fpt("run", "tora", "--efforts", "/commands")
    assert done.returncode == 2
    assert "they go with --no-plant" in done.stderr
    done = forked_fpt("run", "tora", "--no-plant", "--composed")
    assert done.returncode == 2
    assert "--composed" in done.stderr
