"""Mamdani inference in closed form, against scikit-fuzzy on a fine grid."""

import numpy as np
import pytest
import skfuzzy
from hypothesis import given, settings
from hypothesis import strategies as st

from fpt_ros.denoising import experts
from fpt_ros.denoising.mamdani import Rules

UNIT = (0.0, 0.5, 1.0)
ALL = "LL:{0} LM:{0} LH:{0} ML:{0} MM:{0} MH:{0} HL:{0} HM:{0} HH:{0}"
EXPERTS = ("LEVEL", "RULE", "WAVELET", "WINDOW", "WIDTH", "DOUBT")
GRID = np.linspace(0.0, 1.0, 2001)


def corners(sets):
    a, b, c = sets
    return {"L": [a, a, b], "M": [a, b, c], "H": [b, c, c]}


def inferred(rules, first, second):
    """As one writes it with scikit-fuzzy."""

    def degrees(value, sets):
        x = np.array([np.clip(value, sets[0], sets[2])])
        return {name: skfuzzy.trimf(x, each)[0] for name, each in corners(sets).items()}

    one, two = degrees(first, rules.first), degrees(second, rules.second)
    shape = np.zeros(len(GRID))
    for rule in rules.text.split():
        (a, b), output = rule.split(":")
        cut = np.fmin(min(one[a], two[b]), skfuzzy.trimf(GRID, corners(UNIT)[output]))
        shape = np.fmax(shape, cut)
    return skfuzzy.defuzz(GRID, shape, "centroid")


@pytest.mark.parametrize(("output", "centroid"), [("L", 1 / 6), ("M", 1 / 2), ("H", 5 / 6)])
def test_one_full_rule_gives_the_centroid_of_its_triangle(output, centroid):
    rules = Rules(UNIT, UNIT, ALL.format(output))
    assert rules.infer(0.0, 1.0) == pytest.approx(centroid, abs=1e-15)


def test_a_cut_triangle():
    # L cut at c has the centroid of a right trapezoid; both inputs at 0.25: L and M at 1/2
    rules = Rules(UNIT, UNIT, ALL.format("L"))
    c = 0.5
    long, short = 0.5, 0.5 * (1 - c)
    centroid = (long**2 + long * short + short**2) / (3 * (long + short))
    assert rules.infer(0.25, 0.25) == pytest.approx(centroid, abs=1e-15)


def test_where_no_rule_says_anything_it_is_the_middle():
    assert Rules(UNIT, UNIT, "LL:H").infer(1.0, 1.0) == 0.5


@pytest.mark.parametrize("name", EXPERTS)
def test_experts_infer_as_scikit_fuzzy_does(name):
    rules = getattr(experts, name)
    assert len(rules.text.split()) == 9
    chance = np.random.default_rng(len(name))
    for _ in range(40):
        first, second = (
            chance.uniform(1.5 * sets[0] - 0.5 * sets[2], 1.5 * sets[2] - 0.5 * sets[0])
            for sets in (rules.first, rules.second)
        )
        assert rules.infer(first, second) == pytest.approx(inferred(rules, first, second), abs=1e-6)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.sampled_from("LMH"), min_size=9, max_size=9), st.floats(0, 1), st.floats(0, 1))
def test_any_rules_infer_as_scikit_fuzzy_does(outputs, first, second):
    conditions = [a + b for a in "LMH" for b in "LMH"]
    text = " ".join(f"{a}:{b}" for a, b in zip(conditions, outputs, strict=True))
    rules = Rules(UNIT, UNIT, text)
    assert rules.infer(first, second) == pytest.approx(inferred(rules, first, second), abs=1e-6)


@settings(max_examples=25, deadline=None)
@given(st.floats(-100, 100))
def test_inputs_are_clipped(value):
    clipped = float(np.clip(value, -5.0, 20.0))
    assert experts.LEVEL.infer(value, 0.05) == experts.LEVEL.infer(clipped, 0.05)
