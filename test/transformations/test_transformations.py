"""What all transformations have to be, and the figures of the stretched and of the atanh form."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from fpt_ros.errors import BadInput
from fpt_ros.parameters import resolve
from fpt_ros.transformations import TRANSFORMATIONS, atanh, stretched

NAMES = tuple(name for name in TRANSFORMATIONS.names() if name != "none")
FORMED = tuple(
    name
    for name in NAMES
    if any(parameter.name == "form" for parameter in TRANSFORMATIONS[name].parameters)
)
"""Those with a sigmoid; rotations have a file of their own."""

FORMS = ["norm", "signed"]

vector = st.lists(st.floats(-10.0, 10.0), min_size=3, max_size=3)

SIGMOIDS = {
    "sgfpt": lambda x, K=0.5, D=0.6: math.atanh(math.tanh(x) - K) + D,
    "stretched": lambda x, B=2.0, a=0.5, b=1.0, K=0.0: B * math.tanh(a * (x + b)) + K,
    "atanh": lambda x, D=0.3: math.atanh(0.5 * math.tanh(x + D)),
}
"""F with the default parameters, written down again."""


def made(name, **values):
    transformation = TRANSFORMATIONS[name]
    return transformation, transformation.prepare(
        resolve(transformation.parameters, values, "test")
    )


def deform(name, r, h, **values):
    transformation, constants = made(name, **values)
    out = [math.nan] * len(r)
    transformation.deform(constants, r, h, h, [0.0] * len(r), out)
    return out


def bisect(function, low, high):
    """Where a function that is positive at ``low`` and negative at ``high`` vanishes."""
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if function(middle) > 0.0 else (low, middle)
    return 0.5 * (low + high)


@pytest.mark.parametrize("name", NAMES)
def test_the_gain_is_the_first_constant(name):
    assert made(name, A=-0.375)[1][0] == -0.375


@pytest.mark.parametrize("name", FORMED)
@pytest.mark.parametrize("form", FORMS)
@settings(deadline=None, max_examples=50)
@given(r=vector)
def test_no_response_error_leaves_r_unchanged(name, form, r):
    found = deform(name, r, [0.0] * 3, form=form, A=1e-3)
    exact = name != "rfpt" or form == "norm"
    if exact:
        assert found == pytest.approx(r, rel=0.0, abs=2e-15)
    else:
        assert found == pytest.approx(r, abs=3e-11)  # (r + K) - K with K = -1e5


@pytest.mark.parametrize("name", FORMED)
@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("gain", [1.0, -1.0])
def test_slope_is_the_numeric_derivative_at_no_error(name, form, gain):
    """r' = r + A slope h."""
    A = gain * (1e-6 if name == "rfpt" else 1.0)
    transformation, constants = made(name, form=form, A=A)
    slope, step = transformation.slope(constants), 1e-2 if name == "rfpt" else 1e-5

    def moved(h):
        return deform(name, [0.0], [h], form=form, A=A)[0]

    one_sided = (4.0 * moved(step) - moved(2.0 * step)) / (2.0 * step)
    assert one_sided == pytest.approx(A * slope, rel=1e-6)
    other_side = (4.0 * moved(-step) - moved(-2.0 * step)) / (-2.0 * step)
    assert other_side == pytest.approx(A * slope, rel=1e-6)


@pytest.mark.parametrize("name", sorted(SIGMOIDS))
def test_the_fixed_point_is_exact_and_attractive(name):
    F = SIGMOIDS[name]
    transformation, constants = made(name)
    star = constants[1]
    assert F(star) == pytest.approx(star, rel=0.0, abs=2.0 * np.spacing(star))
    assert star == pytest.approx(bisect(lambda x: F(x) - x, 0.2, 5.0), abs=1e-14)
    numeric = (F(star + 1e-5) - F(star - 1e-5)) / 2e-5
    assert transformation.slope(constants) == pytest.approx(numeric, rel=1e-8)
    assert 0.0 < transformation.slope(constants) < 1.0


@pytest.mark.parametrize("name", sorted(SIGMOIDS))
@settings(deadline=None, max_examples=100)
@given(r=vector, h=vector, A=st.floats(-0.1, 0.1))
def test_the_norm_form_to_the_letter(name, r, h, A):
    """(3.5), (4.10): r' = [F(A ||h|| + x*) - x*] h / ||h|| + r."""
    norm = math.hypot(*h)
    assume(norm > 1e-6)
    assume(name != "sgfpt" or A * norm > -1.2)  # the domain of F
    F, star = SIGMOIDS[name], made(name)[1][1]
    step = F(A * norm + star) - star
    expected = [y + step * x / norm for x, y in zip(h, r, strict=True)]
    values = {"guard": False} if name == "sgfpt" else {}
    assert deform(name, r, h, A=A, **values) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("name", sorted(SIGMOIDS))
@settings(deadline=None, max_examples=100)
@given(r=vector, h=vector, A=st.floats(-0.1, 0.1))
def test_the_signed_form_to_the_letter(name, r, h, A):
    """(3.1): r' = F(A h + x*) - x* + r, each coordinate by itself."""
    F, star = SIGMOIDS[name], made(name)[1][1]
    values = {"guard": False} if name == "sgfpt" else {}
    expected = [F(A * x + star) - star + y for x, y in zip(h, r, strict=True)]
    found = deform(name, r, h, A=A, form="signed", **values)
    assert found == pytest.approx(expected, abs=1e-13)


@pytest.mark.parametrize("name", FORMED)
@pytest.mark.parametrize("form", FORMS)
def test_the_step_limit_is_reached_and_never_passed(name, form):
    """Towards the solution: for A of the sign that converges, h > 0 in the signed form."""
    sign = 1.0 if name == "rfpt" else -1.0
    transformation, constants = made(name, form=form, A=sign * 1.0)
    limit = transformation.step_limit(constants)
    steps = [-deform(name, [0.0], [h], form=form, A=sign * 1.0)[0] for h in np.logspace(-6, 12, 73)]
    assert all(0.0 < step <= limit * (1.0 + 1e-12) for step in steps)
    assert steps[-1] == pytest.approx(limit, rel=1e-6)


@pytest.mark.parametrize(
    ("name", "values", "star", "slope", "limit"),
    [
        ("sgfpt", {}, 0.7130913716914226, 0.6327308229685502, 0.8261827433828452),
        ("atanh", {"D": 0.3}, 0.2594563670316665, 0.3967373249, 0.8087625113655),
        ("atanh", {"D": -0.3}, -0.2594563670316664, 0.3967373248939196, 0.28984978),
        ("stretched", {}, 1.762450721551041, 0.2234418635, 3.76245),
    ],
)
def test_figures_of_the_experiments(name, values, star, slope, limit):
    """Sections 2.5, 3.1.1, 4.1, 4.2 and 4.3."""
    transformation, constants = made(name, **values)
    assert constants[1] == pytest.approx(star, abs=2e-15)
    assert transformation.slope(constants) == pytest.approx(slope, abs=1e-10)
    assert transformation.step_limit(constants) == pytest.approx(limit, abs=1e-5)


def test_the_atanh_form_doubles_its_fixed_point():
    """tanh(x* + D) = 2 tanh x*."""
    for D in (-1.0, -0.3, 0.05, 0.3, 2.0):
        star = atanh.fixed_point(D)
        assert math.tanh(star + D) == pytest.approx(2.0 * math.tanh(star), rel=1e-14)


def test_the_stretched_form_saturates_upwards():
    assert deform("stretched", [0.0], [1e6], A=1.0)[0] == pytest.approx(0.23755, abs=1e-5)
    star = made("stretched")[1][1]
    assert deform("stretched", [0.0], [1e6], A=1.0)[0] == pytest.approx(2.0 - star, abs=1e-14)


def test_a_stretched_sigmoid_with_another_height():
    """B = 4, a = 1, b = 0, K = 1: x = 4 tanh x + 1."""
    constants = made("stretched", B=4.0, a=1.0, b=0.0, K=1.0)[1]
    star = bisect(lambda x: 4.0 * math.tanh(x) + 1.0 - x, 3.0, 7.0)
    assert constants[1] == pytest.approx(star, rel=1e-15)
    assert stretched.generator(constants, star) == pytest.approx(star, rel=1e-15)


def test_a_stretched_sigmoid_without_an_attractive_fixed_point_is_refused():
    """a B = 1 and b = K = 0: F(x) = x at 0 with the slope 1, which attracts nothing in time."""
    with pytest.raises(BadInput, match="no attractive fixed point") as caught:
        made("stretched", B=1.0, a=1.0, b=0.0, K=0.0)
    assert "\n" not in str(caught.value)
    assert "B = 1, a = 1, b = 0, K = 0" in str(caught.value)


@pytest.mark.parametrize("name", sorted(SIGMOIDS))
def test_the_iteration_solves_a_task(name):
    """An unknown monotonic response function: its solution is found to the last digits."""

    def answer(r):
        return 1.5 * r + 0.3 * math.sin(r) - 4.0

    r = 0.0
    for _ in range(400):
        (r,) = deform(name, [r], [answer(r) - 2.0], A=-0.5)
    assert answer(r) == pytest.approx(2.0, abs=1e-11)
    solution = bisect(lambda x: 2.0 - answer(x), -10.0, 10.0)
    assert r == pytest.approx(solution, abs=1e-11)
