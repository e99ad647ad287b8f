"""What a deformer that does not know the plant says of a gain: as ``fpt gain``, or nothing."""

import numpy as np
import pytest

from fpt_ros.cycle.fpt_deformer import FptDeformer
from fpt_ros.errors import BadInput
from fpt_ros.experiments.experiment import load
from fpt_ros.gain.contraction import bounds
from fpt_ros.gain.in_flight import GainInFlight
from fpt_ros.gain.warning import known, told


def deformer(experiment, **changes):
    return FptDeformer({**experiment.nodes["fpt_deformer"], **changes})


@pytest.mark.parametrize(
    ("name", "variant"), [("tora", "adaptive"), ("mimo_affine", "adaptive"), ("panda", "adaptive")]
)
def test_the_range_is_that_of_fpt_gain_also_with_other_parameters_of_the_transformation(
    name, variant
):
    experiment = load(name, variant)
    experiment = told(experiment, known(experiment))
    changes = {"K": 0.3} if "K" in experiment.nodes["fpt_deformer"] else {}
    limit = bounds(experiment.with_values("fpt_deformer", **changes)).range
    (end,) = [x for x in limit if x]
    for factor, contracts in ((1 - 1e-12, True), (1 + 1e-12, False), (-0.5, False)):
        stage = deformer(experiment, **changes, A=end * factor)
        text = GainInFlight(deformer(experiment)).judge(stage)
        assert (text == "") == contracts, (factor, text)
        if not contracts:
            low, high = limit
            assert f"outside the range ({low:.4g}, {high:.4g})" in text


def test_nothing_is_said_where_nothing_is_known():
    stage = deformer(load("tora"))
    assert "not known here, the nodes were not told" in GainInFlight(stage).judge(stage)
    experiment = told(load("tora"), known(load("tora")))
    stage = deformer(experiment)
    for node, name in (
        ("plant_simulator", "exact.m"),
        ("trajectory_generator", "lambda"),
        ("fpt_deformer", "approximate.m"),
        ("fpt_deformer", "weights"),
    ):
        gain = GainInFlight(stage)
        gain.forget(node, {"stopped", name} if node == "fpt_deformer" else {name})
        assert f"not known here, {node}.{name} has changed" in gain.judge(stage)
    gain.unknown = ""
    gain.forget("plant_simulator", {"noise.position"})
    gain.forget("denoiser", {"states"})
    assert gain.judge(stage) == ""


def test_a_law_that_gives_the_gain_itself_is_not_told():
    for name, variant in (("tora", "guarded"), ("tora", "nonadaptive")):
        loaded = load(name, variant)
        assert told(loaded, known(loaded)).nodes["fpt_deformer"]["gain_scale"] == 0.0


def test_the_scale_that_a_file_gives_is_left_alone():
    given = load("tora", settings=["fpt_deformer.gain_scale=0.5"])
    assert told(given, known(given)).nodes["fpt_deformer"]["gain_scale"] == 0.5
    assert np.isclose(bounds(given).signed_scale, 1.4734774066796035)


def test_a_strict_experiment_does_not_start():
    from fpt_ros.cli.gain import warn_about_gain

    strict = load("tora", settings=["fpt_deformer.A=-5", "fpt_deformer.strict_gain=true"])
    with pytest.raises(BadInput, match=r"strict_gain: fpt_deformer.A = -5 is outside the range"):
        warn_about_gain(strict)
