"""``fpt_deformer.weights: auto``: worked out where an experiment is loaded."""

import pytest

from fpt_ros.errors import BadInput
from fpt_ros.experiments.experiment import load
from fpt_ros.experiments.response_map import mean_diagonal

AUTO = "fpt_deformer.weights=auto"


def test_one_over_the_inertia_of_the_model_in_that_of_the_plant():
    """Van der Pol: m = 10 in the plant, 9 in the model, everywhere."""
    loaded = load("vdp_rfpt", settings=[AUTO])
    assert loaded.nodes["fpt_deformer"]["weights"] == pytest.approx([10.0 / 9.0], rel=1e-9)


def test_the_mean_response_of_each_coordinate_is_then_that_asked_for():
    loaded = load("cart_beam_hamper", settings=[AUTO])
    weights = loaded.nodes["fpt_deformer"]["weights"]
    assert len(weights) == 3
    for weight, mean in zip(weights, mean_diagonal(load("cart_beam_hamper").loop()), strict=True):
        assert weight * mean == pytest.approx(1.0)


def test_coordinates_in_turn():
    """Two coordinates, of which one at a time is controlled."""
    weights = load("swing", settings=[AUTO]).nodes["fpt_deformer"]["weights"]
    assert all(weight > 0.0 for weight in weights)


def test_a_response_against_what_is_asked_for_has_no_weight():
    settings = [AUTO, "plant_simulator.exact.m22=-2.0"]
    with pytest.raises(BadInput, match=r"auto needs a response that follows .* of 'x2' does not"):
        load("mimo_affine", settings=settings)


def test_any_other_word_is_refused():
    with pytest.raises(BadInput, match=r"weights: 'automatic' is not valid, it takes .*, or auto"):
        load("tora", settings=["fpt_deformer.weights=automatic"])
