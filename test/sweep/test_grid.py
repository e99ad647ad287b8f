import math
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fpt_ros.errors import BadInput
from fpt_ros.sweep.definition import define
from fpt_ros.sweep.grid import Space, parse, values


def test_linear_range_has_both_ends():
    axis = parse("fpt_deformer.A=-0.1:-4:64")
    found = values(axis)
    assert (found[0], found[-1], len(found)) == (-0.1, -4.0, 64)
    steps = [b - a for a, b in pairwise(found)]
    assert steps == pytest.approx([-3.9 / 63] * 63)


def test_logarithmic_range_of_negative_numbers():
    found = values(parse("fpt_deformer.A=-0.01:-100:5:log"))
    assert found == pytest.approx((-0.01, -0.1, -1.0, -10.0, -100.0))
    assert (found[0], found[-1]) == (-0.01, -100.0)


def test_lists_keep_their_types():
    assert values(parse("a.b=sgfpt,none")) == ("sgfpt", "none")
    assert values(parse("a.b=1,2.5")) == (1, 2.5)
    assert values(parse("a.b=true,false")) == (True, False)
    assert values(parse("a.b=[0,1],[2,3]")) == ((0, 1), (2, 3))


def test_element_of_a_list():
    axis = parse("plant_simulator.initial_position[2]=-1:1:3")
    assert (axis.target.name, axis.target.index) == ("initial_position", 2)
    assert str(axis.target) == "plant_simulator.initial_position[2]"


def test_the_product_has_every_pair_once_and_the_last_axis_is_fastest():
    space = Space((parse("a.b=1,2"), parse("a.c=0:1:3")))
    assert [space.point(i) for i in range(space.size)] == [
        (b, c) for b in (1, 2) for c in (0.0, 0.5, 1.0)
    ]


@given(st.integers(0, 2**31), st.integers(0, 10_000))
def test_random_points_are_within_the_ranges_and_repeatable(seed, number):
    axes = (parse("a.b=-4:-0.05:log", True), parse("a.c=1:3", True), parse("a.d=x,y", True))
    point = Space(axes, 20_000, seed).point(number)
    assert point == Space(axes, 20_000, seed).point(number)
    assert -4.0 <= point[0] <= -0.05
    assert 1.0 <= point[1] <= 3.0
    assert point[2] in ("x", "y")


def test_random_log_is_uniform_in_the_logarithm():
    space = Space((parse("a.b=0.01:100:log", True),), 4000, 1)
    logs = [math.log10(space.point(i)[0]) for i in range(4000)]
    assert sum(logs) / 4000 == pytest.approx(0.0, abs=0.1)  # five standard errors
    assert sum(log < -1.0 for log in logs) / 4000 == pytest.approx(0.25, abs=0.035)


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("fpt_deformer.A", "it takes NODE.PARAM=START:STOP:COUNT"),
        ("A=1:2:3", "it takes NODE.PARAM=START:STOP:COUNT"),
        ("fpt_deformer.A=1:2", "the count is missing"),
        ("fpt_deformer.A=1:2:0", "the count is 0, it takes 1 or more"),
        ("fpt_deformer.A=1:2:-3", "the count is -3"),
        ("fpt_deformer.A=1:x:3", "it takes NODE.PARAM=START:STOP:COUNT"),
        ("fpt_deformer.A=1:inf:3", "it takes NODE.PARAM=START:STOP:COUNT"),
        ("fpt_deformer.A=-1:1:3:log", "ends of one sign"),
        ("fpt_deformer.A=", "it has no values"),
        ("fpt_deformer.A=1,,2", "it takes NODE.PARAM=START:STOP:COUNT"),
        ("fpt_deformer.Q=1:2:3", "fpt_deformer has no parameter 'Q'"),
        ("deformer.A=1:2:3", "there is no node 'deformer'"),
        ("fpt_deformer.K=0.5:-1:4", "it takes a number > 0 and <= 2"),
        ("plant_simulator.substeps=1:2:3", "1.5 is not valid, it takes an integer"),
        ("plant_simulator.initial_position[3]=0:1:2", "has 3 elements"),
        ("fpt_deformer.A[0]=0:1:2", "is no list of numbers"),
        ("fpt_deformer.transformation=none,x", "none, atanh, rfpt, rotation, sgfpt"),
    ],
)
def test_what_is_no_grid(text, complaint):
    with pytest.raises(BadInput) as caught:
        define("tora", "adaptive", (), None, [text], None, 0, ())
    assert complaint in str(caught.value)
    assert "\n" not in str(caught.value)


def test_one_grid_a_parameter():
    for other in (
        "plant_simulator.initial_position[0]=0,1",
        "plant_simulator.initial_position=[0]",
    ):
        with pytest.raises(BadInput, match="there are two"):
            define(
                "tora",
                "adaptive",
                (),
                None,
                ["plant_simulator.initial_position[0]=0:1:2", other],
                None,
                0,
                (),
            )
