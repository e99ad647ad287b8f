"""Runs change their behaviour where the limits of the gain say so."""

import numpy as np
import pytest
from limits_of import bounds

from fpt_ros.engine.engine import Engine
from fpt_ros.experiments.experiment import load

STEP = 0.7130913716914226 + 0.1130913716914226  # x* - x1, chapter3_4.md, 0.1


def steps_of(name, A, **settings):
    """The deformed responses of the last cycles of a run, its response errors' signs included."""
    changes = [f"{key.replace('__', '.')}={value}" for key, value in settings.items()]
    experiment = load(name, settings=[f"fpt_deformer.A={A}", *changes])
    engine = Engine(experiment.loop(), compile_laws=False)
    engine.run()
    return engine.topics()["command"].vectors["accelerations"]


@pytest.mark.parametrize(("name", "duration"), [("siso_affine", 3000.0), ("mimo_affine", 3000.0)])
def test_runs_change_their_behaviour_at_the_bounds(name, duration):
    found = bounds(name)
    length = {"plant_simulator__duration": duration}
    if name == "siso_affine":
        length["fpt_deformer__initial_response"] = "[-3.001]"
    else:
        length["fpt_deformer__initial_response"] = "[0.7277, -1.5331]"
    monotone = np.diff(steps_of(name, found.sign * 0.97 * found.monotone, **length)[:12, 0])
    assert (monotone[1:-1] * monotone[2:] > -1e-24).all()
    precursor = np.diff(steps_of(name, found.sign * 0.97 * found.linear_limit, **length)[:, 0])
    assert (precursor[10:30] * precursor[11:31] < 0).all()  # it alternates ...
    assert abs(precursor[-1]) < 1e-9  # ... and converges
    chatters = np.diff(steps_of(name, found.sign * 1.03 * found.linear_limit, **length)[:, 0])
    assert abs(chatters[-1]) > 1e-2  # for ever
    assert (chatters[-20:-1] * chatters[-19:] < 0).all()


def test_from_the_hard_onset_on_a_large_error_ends_in_a_two_cycle():
    # M diagonal: along an axis the norm form is the scalar map itself
    found = bounds("mimo_affine", **DIAGONAL)
    assert found.hard_onset == pytest.approx(2.0 / 5.0, rel=1e-7)
    # an error of half of what the largest step changes
    large = {**DIAGONAL, "fpt_deformer__initial_response": f"[{0.5 * STEP}, 0.0]"}
    small = {**DIAGONAL, "fpt_deformer__initial_response": f"[{0.3 * STEP}, 0.0]"}
    below, above = -0.97 * found.hard_onset, -1.03 * found.hard_onset
    for A, start, ends in ((below, large, 0.0), (above, large, STEP), (above, small, 0.0)):
        steps = np.diff(steps_of("mimo_affine", A, **start), axis=0)
        assert np.linalg.norm(steps[-1]) == pytest.approx(ends, abs=1e-6)


DIAGONAL = {
    "plant_simulator__exact__m11": 5.0,
    "plant_simulator__exact__m12": 0.0,
    "plant_simulator__exact__m21": 0.0,
    "plant_simulator__exact__m22": 1.0,
    "plant_simulator__exact__c1": 0.0,
    "plant_simulator__exact__c2": 0.0,
    "plant_simulator__initial_position": "[2.0, 0.0]",
    "trajectory_generator__amplitude": "[0.0, 0.0]",
}
