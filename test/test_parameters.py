"""Parameters: kinds, ranges, choices, and the one-line reasons."""

import math
from array import array

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fpt_ros.errors import BadInput
from fpt_ros.parameters import (
    Parameter,
    flag,
    group,
    integer,
    number,
    numbers,
    prefixed,
    resolve,
    word,
    words,
)

A = Parameter("A", "gain", -0.1)
ALL = (
    A,
    Parameter("dt", "cycle", unit="s", above=0.0),
    Parameter("seed", "random seed", 0, minimum=0),
    Parameter("guard", "keep it in", True),
    Parameter("form", "form", "norm", choices=("norm", "signed")),
    Parameter("start", "per coordinate", [], minimum=-1.0, maximum=1.0),
    Parameter("controlled", "coordinates", kind="strings"),
)
GIVEN = {"dt": 0.001, "controlled": ["q3", "q2"]}


def refused(parameter, value, where=""):
    with pytest.raises(BadInput) as caught:
        parameter.check(value, where)
    message = str(caught.value)
    assert "\n" not in message
    assert caught.value.exit_status == 2
    return message


@pytest.mark.parametrize(
    ("default", "kind"),
    [
        (True, "bool"),
        (0, "int"),
        (0.0, "float"),
        ("norm", "str"),
        ([], "floats"),
        ([0.0], "floats"),
        (["q1"], "strings"),
        (None, "float"),
    ],
)
def test_the_kind_is_that_of_the_default(default, kind):
    assert Parameter("p", "text", default).kind == kind


@pytest.mark.parametrize(
    ("kind", "value"),
    [("bool", False), ("int", -3), ("float", 2.5), ("str", "no"), ("strings", ["a", "b"])],
)
def test_a_value_of_the_right_kind_passes_unchanged(kind, value):
    checked = Parameter("p", "text", kind=kind).check(value)
    assert checked == value
    assert type(checked) is type(value)


@pytest.mark.parametrize("value", [3, -7])
def test_whole_numbers_are_taken_for_numbers(value):
    checked = A.check(value)
    assert checked == value
    assert type(checked) is float
    assert [type(x) for x in Parameter("p", "t", kind="floats").check([value])] == [float]


@pytest.mark.parametrize(
    "value", [(1, 2.5), array("d", [1.0, 2.5]), np.array([1.0, 2.5]), [np.float64(1.0), 2.5]]
)
def test_any_sequence_of_numbers_is_a_list_of_them(value):
    checked = Parameter("p", "text", kind="floats").check(value)
    assert checked == [1.0, 2.5]
    assert isinstance(checked, list)


@pytest.mark.parametrize(
    ("kind", "value"),
    [
        ("bool", 1),
        ("bool", "true"),
        ("int", 1.0),
        ("int", True),
        ("int", "1"),
        ("int", 2**63),
        ("float", True),
        ("float", "1.0"),
        ("float", [1.0]),
        ("float", {"a": 1.0}),
        ("float", 10**400),
        ("str", 1),
        ("str", False),
        ("str", ["a"]),
        ("floats", 1.0),
        ("floats", "1.0"),
        ("floats", b"12"),
        ("floats", [1.0, "2"]),
        ("floats", [True]),
        ("floats", {1.0: 2.0}),
        ("floats", {1.0, 2.0}),
        ("strings", "q1"),
        ("strings", ["q1", 2]),
        ("strings", {"q1": 1}),
    ],
)
def test_a_value_of_another_kind_is_refused(kind, value):
    message = refused(Parameter("p", "text", kind=kind), value, "node")
    assert message.startswith(f"node.p: {value!r} is not valid, it takes ")


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_numbers_are_finite(value):
    assert refused(A, value) == f"A: {value!r} is not valid, it takes a number"
    refused(Parameter("p", "text", kind="floats"), [0.0, value])


def test_bounds_are_closed_or_open():
    closed = Parameter("p", "text", 0.5, minimum=0.0, maximum=1.0)
    assert closed.check(0.0) == 0.0
    assert closed.check(1) == 1.0
    for value in (-1e-12, 1.0 + 1e-12):
        assert "it takes a number >= 0 and <= 1" in refused(closed, value)
    opened = Parameter("p", "text", 0.5, unit="s", above=0.0)
    assert opened.check(5e-324) == 5e-324
    assert refused(opened, 0.0) == "p: 0.0 is not valid, it takes a number > 0 [s]"
    whole = Parameter("p", "text", 1, minimum=1, maximum=1000)
    assert whole.check(1000) == 1000
    refused(whole, 0)
    refused(whole, 1001)
    each = Parameter("p", "text", [], above=0.0)
    assert each.check([1.0, 2.0]) == [1.0, 2.0]
    assert "it takes a list of numbers > 0" in refused(each, [1.0, 0.0])


def test_choices_are_listed():
    form = ALL[4]
    assert form.check("signed") == "signed"
    expected = "n.form: 'sigmoid' is not valid, it takes one of norm, signed"
    assert refused(form, "sigmoid", "n") == expected


@settings(deadline=None)
@given(st.floats(allow_nan=False, allow_infinity=False))
def test_numbers_keep_all_their_bits(value):
    assert np.float64(A.check(value)).tobytes() == np.float64(value).tobytes()


def test_resolve_completes_and_checks():
    values = resolve(ALL, {**GIVEN, "A": -1, "start": (0, 0.5)}, "node")
    assert values == {
        "A": -1.0,
        "dt": 0.001,
        "seed": 0,
        "guard": True,
        "form": "norm",
        "start": [0.0, 0.5],
        "controlled": ["q3", "q2"],
    }
    assert number(values, "A") == -1.0
    assert number(values, "seed") == 0.0
    assert integer(values, "seed") == 0
    assert flag(values, "guard") is True
    assert word(values, "form") == "norm"
    assert numbers(values, "start") == [0.0, 0.5]
    assert words(values, "controlled") == ["q3", "q2"]


def test_resolve_refuses_unknown_and_missing_names():
    with pytest.raises(BadInput) as caught:
        resolve(ALL, {**GIVEN, "gain": 1.0}, "node")
    assert str(caught.value) == (
        "node has no parameter 'gain': it has A, controlled, dt, form, guard, seed, start"
    )
    with pytest.raises(BadInput) as caught:
        resolve(ALL, {"dt": 0.001}, "node")
    assert str(caught.value) == "node.controlled is missing: it takes a list of words"
    with pytest.raises(BadInput, match=r"^node\.dt is missing: it takes a number > 0 \[s\]$"):
        resolve(ALL, {**GIVEN, "dt": None}, "node")
    with pytest.raises(BadInput, match=r"^node\.dt: -1 is not valid"):
        resolve(ALL, {**GIVEN, "dt": -1}, "node")


def test_groups_of_a_law_have_a_prefix_and_the_order_of_the_law():
    law = (Parameter("m", "mass", unit="kg"), Parameter("L", "length"))
    under = prefixed("exact", law)
    assert [parameter.name for parameter in under] == ["exact.m", "exact.L"]
    assert under[0].unit == "kg"
    values = resolve(under, {"exact.L": 2.0, "exact.m": 20}, "node")
    assert group(values, "exact", law) == (20.0, 2.0)
