"""Stages of shipped experiments, and frames to feed them with."""

import math

import engine_runs
import pytest
from engine_runs import stage_by_stage

from fpt_ros.errors import Diverged
from fpt_ros.experiments import experiment
from fpt_ros.messages.frames import Desired, StateEstimate

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


def diverged(call, *args):
    with pytest.raises(Diverged) as caught:
        call(*args)
    assert "\n" not in str(caught.value)
    assert caught.value.exit_status == 1
    return caught.value
