"""Sigmoid Generated Fixed Point Transformation: (3.1), (3.5) and figures of section 3."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from fpt_ros.errors import BadInput
from fpt_ros.parameters import resolve
from fpt_ros.transformations import sigmoid
from fpt_ros.transformations.sgfpt import SGFPT, fixed_points
from fpt_ros.transformations.sgfpt import generator as generator_of

K, D = 0.5, 0.6
ATTRACTIVE, REPULSIVE = 0.7130913716914226, -0.1130913716914226
SLOPE = 0.6327308229685502

number = st.floats(-20.0, 20.0)
vector = st.lists(number, min_size=2, max_size=2)


def generator(k, d, x):
    return generator_of((*[math.nan] * sigmoid.FIRST, k, d), x)


def transformation(**given_values):
    constants = SGFPT.prepare(resolve(SGFPT.parameters, given_values, "test"))

    def deform(r, h):
        out = [math.nan] * len(r)
        SGFPT.deform(constants, r, h, h, [0.0] * len(r), out)
        return out

    return deform


def slope(x):
    """F'(x) = sech^2 x / (1 - (tanh x - K)^2)."""
    y = math.tanh(x) - K
    return (1.0 - math.tanh(x) ** 2) / (1.0 - y * y)


def test_fixed_points_of_the_thesis_generator():
    attractive, repulsive = fixed_points(K, D)
    assert attractive == pytest.approx(ATTRACTIVE, abs=2e-15)
    assert repulsive == pytest.approx(REPULSIVE, abs=2e-15)
    assert generator(K, D, attractive) == pytest.approx(attractive, abs=4e-16)
    assert generator(K, D, repulsive) == pytest.approx(repulsive, abs=4e-16)
    assert slope(attractive) == pytest.approx(SLOPE, abs=1e-14)
    assert slope(repulsive) == pytest.approx(1.0 / SLOPE, rel=1e-13)


def test_the_printed_fixed_point_is_the_eighteenth_iterate_from_zero():
    x = 0.0
    for _ in range(18):
        x = generator(K, D, x)
    assert x == pytest.approx(0.7114269142, abs=5e-11)
    assert generator(K, D, 0.7114269142) == pytest.approx(0.7120372689, abs=5e-11)


@settings(deadline=None)
@given(st.floats(0.05, 1.9), st.floats(0.05, 8.0))
def test_fixed_points_of_any_generator(k, d):
    assume(math.tanh(d / 2) > k / 2 * 1.01)
    attractive, repulsive = fixed_points(k, d)
    assert attractive > repulsive
    assert attractive + repulsive == pytest.approx(d, abs=1e-12)
    for x in (attractive, repulsive):
        condition = 1.0 / (1.0 - abs(math.tanh(x) - k)) + 1.0 / (1.0 - abs(math.tanh(x)))
        assert generator(k, d, x) == pytest.approx(x, abs=1e-14 * condition)
    middle = 0.5 * (attractive + repulsive)
    assert generator(k, d, middle) > middle  # towards the attractive one, from between the two


@settings(deadline=None)
@given(st.floats(0.01, 2.0), st.floats(0.01, 10.0))
def test_two_fixed_points_or_a_reason(k, d):
    crosses = 2.0 * math.sinh(d) / k - math.cosh(d) > 1.0
    if crosses:
        assert fixed_points(k, d)[0] > fixed_points(k, d)[1]
    else:
        with pytest.raises(BadInput, match="give no fixed point"):
            fixed_points(k, d)


def test_parameters_without_a_fixed_point_are_refused():
    with pytest.raises(BadInput, match=r"K = 1 and D = 0\.6 .* \(lower K or raise D\)") as caught:
        transformation(K=1.0)
    assert "\n" not in str(caught.value)
    with pytest.raises(BadInput, match=r"D: 1000\.0 is not valid"):  # sinh would overflow
        transformation(D=1000.0)
    with pytest.raises(BadInput, match="form: 'sigmoid' is not valid, it takes one of norm, sig"):
        transformation(form="sigmoid")


@pytest.mark.parametrize("form", ["norm", "signed"])
def test_limit_of_the_domain_without_guard(form):
    """tanh x > K - 1: A h > -1.2623975160."""
    deform = transformation(A=-1.0, guard=False, form=form)
    inside, outside = deform([0.0], [1.2623975159]), deform([0.0], [1.2623975161])
    assert inside[0] < -8.0
    assert math.isnan(outside[0])


@pytest.mark.parametrize("form", ["norm", "signed"])
def test_the_guard_limits_the_step(form):
    deform = transformation(A=-1.0, form=form)
    widest = ATTRACTIVE - REPULSIVE
    assert widest == pytest.approx(0.82618, abs=5e-6)
    for h in (widest, 1.2624, 5.0, 1e6):
        assert deform([1.0], [h])[0] == pytest.approx(1.0 - widest, abs=1e-12)
    assert deform([1.0], [0.5])[0] > 1.0 - widest


def test_saturation_above():
    deform = transformation(A=1.0, guard=False)
    assert deform([0.0], [1e3])[0] == pytest.approx(0.4362147726, abs=1e-10)
    assert deform([0.0], [-1e3])[0] == pytest.approx(-0.4362147726, abs=1e-10)
    assert deform([0.0], [1.0])[0] < 0.4362147726


@settings(deadline=None)
@given(vector, st.sampled_from(["norm", "signed"]), st.booleans())
def test_no_response_error_leaves_r_unchanged(r, form, guard):
    unchanged = transformation(form=form, guard=guard)(r, [0.0, 0.0])
    assert unchanged == pytest.approx(r, abs=4e-16)


def test_tiny_response_errors_leave_r_unchanged():
    deform = transformation(A=-1.0)
    assert deform([1.0, 2.0], [1e-12, 0.0]) == [1.0, 2.0]
    assert deform([0.0], [2e-12])[0] == pytest.approx(-SLOPE * 2e-12, rel=1e-3)


@settings(deadline=None)
@given(vector, vector, st.floats(-math.pi, math.pi), st.floats(-2.0, -0.01))
def test_the_norm_form_does_not_care_about_the_axes(r, h, turn, a):
    """Rotating r and h rotates the result."""
    deform = transformation(A=a)
    R = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    turned = deform((R @ r).tolist(), (R @ h).tolist())
    assert turned == pytest.approx(R @ deform(r, h), abs=1e-12)


@settings(deadline=None)
@given(vector, vector, st.floats(-2.0, 2.0))
def test_the_norm_form_is_3_5_to_the_letter(r, h, a):
    norm = math.hypot(*h)
    assume(norm > 1e-6)
    x = max(a * norm + ATTRACTIVE, REPULSIVE)
    step = math.atanh(math.tanh(x) - K) + D - ATTRACTIVE
    expected = [y + step * z / norm for y, z in zip(r, h, strict=True)]
    assert transformation(A=a)(r, h) == pytest.approx(expected, abs=1e-12)


def test_the_signed_form_takes_each_coordinate_by_itself_and_is_not_odd():
    deform = transformation(A=-0.5, form="signed")
    together = deform([1.0, 2.0, 3.0], [0.5, -0.5, 0.0])
    alone = [deform([r], [h])[0] for r, h in ((1.0, 0.5), (2.0, -0.5), (3.0, 0.0))]
    assert together == alone
    down, up = together[0] - 1.0, together[1] - 2.0
    assert down < 0.0 < up
    assert abs(down + up) > 1e-2
    assert transformation(A=-0.5)([2.0], [-0.5])[0] - 2.0 == pytest.approx(-down, abs=1e-15)


# --- the bare iteration of one coordinate, section 3.1.1: f(r) = r + 1, r^Des = -2, r_0 = -4


def siso(a, iterations):
    """Response errors h_0, h_1, ... and the r of each."""
    deform = transformation(A=a, form="signed", guard=False)
    r, errors, responses = -4.0, [], []
    for _ in range(iterations):
        h = r + 1.0 + 2.0
        errors.append(h)
        responses.append(r)
        (r,) = deform([r], [h])
    return errors, responses


def first_below(errors, limit):
    return next(i for i, h in enumerate(errors) if abs(h) < limit)


@pytest.mark.parametrize(
    ("a", "limit", "iterations"),
    [(-0.5, 1e-6, 38), (-2.0, 1e-2, 3), (-2.0, 1e-6, 9), (-3.12, 1e-3, 147), (-3.12, 1e-6, 411)],
)
def test_iterations_until_the_scalar_map_has_converged(a, limit, iterations):
    errors, responses = siso(a, 500)
    assert first_below(errors, limit) == iterations
    assert responses[-1] == pytest.approx(-3.0, abs=1e-6)


@pytest.mark.parametrize(("a", "multiplier"), [(-0.5, 0.6836), (-2.0, -0.2655), (-3.12, -0.9741)])
def test_multiplier_of_the_scalar_map(a, multiplier):
    """Late in the convergence each error is 1 + A F'(x*) times the one before."""
    errors, _ = siso(a, 500)
    at = first_below(errors, 1e-5)
    assert errors[at + 1] / errors[at] == pytest.approx(multiplier, abs=2e-4)
    assert 1.0 + a * SLOPE == pytest.approx(multiplier, abs=5e-5)


def test_fast_convergence_is_not_monotonic():
    errors, _ = siso(-2.0, 5)
    assert errors == pytest.approx([-1, -0.575, -0.200, 0.0021, -0.00056], abs=6e-4)


def test_chaos_is_bounded():
    errors, responses = siso(-6.0, 4000)
    assert errors[:6] == pytest.approx(
        [-1.0, -0.563789, -0.128312, 0.184655, -1.2847, -0.848484], abs=6e-5
    )
    last = responses[-1000:]
    assert min(last) == pytest.approx(-4.391, abs=2e-2)
    assert max(last) == pytest.approx(-2.811, abs=2e-2)
    assert np.std(last) > 0.3


def test_period_two_between_2_over_the_slope_and_3_98905():
    errors, _ = siso(-3.5, 2000)
    assert errors[-1] == pytest.approx(errors[-3], abs=1e-12)
    assert abs(errors[-1] - errors[-2]) > 0.1


@pytest.mark.parametrize(("p", "leaves"), [(6.36, False), (6.3634, True), (6.5, True)])
def test_border_beyond_which_the_orbit_leaves_the_domain(p, leaves):
    errors, _ = siso(-p, 20000)
    assert math.isnan(errors[-1]) is leaves


# --- the bare iteration of two coordinates, section 3.2.1


def mimo(a, iterations=400):
    M, c, desired = np.array([[3.832, 1.819], [1.819, 2.168]]), np.array([1, -1]), [1, -3]
    deform = transformation(A=a)
    r, norms = [0.0, 0.0], []
    for _ in range(iterations):
        h = M @ r + c - desired
        norms.append(float(np.linalg.norm(h)))
        r = deform(r, h)
    return norms, r


@pytest.mark.parametrize(
    ("a", "limit", "iterations"),
    [(-0.20, 1e-6, 105), (-0.20, 1e-3, 54), (-0.27425, 1e-6, 74), (-0.27425, 1e-3, 38)],
)
def test_iterations_until_the_map_of_two_coordinates_has_converged(a, limit, iterations):
    norms, r = mimo(a)
    assert first_below(norms, limit) == iterations
    assert r == pytest.approx([0.7277434, -1.5331020], abs=1e-7)


def test_the_printed_sign_of_a_diverges():
    norms, _ = mimo(0.20)
    assert norms[-1] > norms[200] > norms[100] > 10.0


@given(h=vector, S=st.sampled_from([0.5, 1.0, 8.0, 64.0]), form=st.sampled_from(["norm", "signed"]))
def test_the_scale_widens_the_map_without_another_shape(h, S, form):
    """A step of the map of scale S for h is S times that of scale 1 for h / S."""
    own = {"A": -0.7, "form": form}
    zero = [0.0, 0.0]
    wide = transformation(scale=S, **own)(zero, h)
    narrow = transformation(**own)(zero, [x / S for x in h])
    assert wide == pytest.approx([S * x for x in narrow], rel=1e-12, abs=1e-12)


def test_the_scale_makes_long_steps_possible():
    reach = REPULSIVE - ATTRACTIVE
    for S in (1.0, 10.0):
        (r,) = transformation(A=-3.0, scale=S)([0.0], [1e6])
        assert r == pytest.approx(S * reach)
    constants = SGFPT.prepare(resolve(SGFPT.parameters, {"scale": 10.0}, "test"))
    assert SGFPT.step_limit(constants) == pytest.approx(-10.0 * reach)
