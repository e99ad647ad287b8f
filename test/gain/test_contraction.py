"""The range of A: against the figures of the chapter files, closed forms, and what runs do."""

import math

import numpy as np
import pytest
from limits_of import bounds

from fpt_ros.engine.engine import Engine
from fpt_ros.errors import BadInput
from fpt_ros.experiments.experiment import load
from fpt_ros.gain import contraction
from fpt_ros.gain import motion as gain_motion
from fpt_ros.gain.map import scalar_map

F_SLOPE = 0.6327308229685502  # F'(x*), chapter3_4.md, 0.1
STEP = 0.7130913716914226 + 0.1130913716914226  # x* - x1


def test_siso_classes_are_those_of_the_chapter_file():
    found = bounds("siso_affine").with_chaos()
    assert found.monotone == pytest.approx(1.5804509022, rel=1e-9)
    assert found.linear_limit == pytest.approx(3.1609018044, rel=1e-9)
    assert found.doubling == pytest.approx(3.98905, abs=5e-6)
    assert found.domain_limit == pytest.approx(6.3633905551, rel=1e-9)
    assert found.chaos == pytest.approx(4.27, abs=1e-4)
    assert found.hard_onset is None
    assert found.reach == pytest.approx(1.2623975160, rel=1e-9)
    assert [band.name for band in found.bands] == [
        "monotone",
        "precursor oscillation",
        "two-cycle",
        "period doubling",
        "chaos",
        "leaves the domain",
    ]


@pytest.mark.parametrize(
    ("name", "variant", "limit", "rel"),
    [
        ("tora", "adaptive", 4.6575, 1e-4),
        ("mimo_affine", "adaptive", 0.6321492, 1e-7),
        ("spherical_pendulum", "adaptive", 5.60, 1e-3),
        ("swing", "adaptive", 8.1, 5e-3),
        ("kapitza", "listing", 5.1, 1e-2),
        ("kapitza", "with_gravity", 5.1, 1e-2),
    ],
)
def test_linear_limits_are_those_of_the_chapter_file(name, variant, limit, rel):
    assert bounds(name, variant).linear_limit == pytest.approx(limit, rel=rel)


def test_without_the_feedback_it_is_the_chapter_files_limit_of_the_neuron():
    found = bounds("fitzhugh_nagumo")
    assert found.bare_limit == pytest.approx(4.7414, rel=1e-4)
    assert found.linear_limit == pytest.approx(2.0 / (F_SLOPE * 2.0 / 3.0 * 1.002), rel=1e-9)


def test_limits_in_closed_form():
    assert bounds("tora").linear_limit == pytest.approx(2 / (F_SLOPE * 2 / 3 * 1.018), rel=1e-9)
    # K B A m^/m (1 + 2 Lambda dt) = 2
    assert bounds("vdp_rfpt").linear_limit == pytest.approx(2 / (1e5 * 0.9 * 1.02), rel=1e-9)
    assert bounds("vdp_rfpt").bare_limit == pytest.approx(2e-6 / (0.1 * 0.9), rel=1e-9)
    # coupled masses: the worse of m^/m; 0.3967... is F' of the atanh transformation
    expected = 2 / (0.3967373248939196 * 0.75 * 1.015)
    assert bounds("coupled_masses").linear_limit == pytest.approx(expected, rel=1e-9)


def test_eigenvalues_of_the_cart_are_those_of_the_inertia_matrices():
    found = bounds("cart_beam_hamper")

    def inertia(m, M, L, theta, q1):
        coupling = m * L * math.cos(q1)
        both = m * L * L + theta
        return np.array([[both, theta, coupling], [theta, theta, 0.0], [coupling, 0.0, m + M]])

    values = [
        np.linalg.eigvals(np.linalg.solve(inertia(10, 30, 2, 20, q), inertia(20, 60, 2.5, 50, q)))
        for q in np.linspace(0.0, 1.2, 600)  # q1 = 0.4 (1 - cos t) + 0.2 (1 - cos 3 t)
    ]
    assert found.eigenvalues[0] == pytest.approx(np.min(values), rel=1e-3)
    assert found.eigenvalues[1] == pytest.approx(np.max(values), rel=1e-3)
    assert found.sign == 1


def test_eigenvalues_of_kapitzas_readings():
    # listing: 0.987 ... and (4.7) as printed: |q2| times that, up to |q2| = 0.3
    def factor(q):
        c = math.cos(q) ** 2
        return 0.8 * (1.5 + 2.2 * c) / (1 + 2 * c)

    literal, listing = bounds("kapitza"), bounds("kapitza", "listing")
    assert listing.eigenvalues[1] == pytest.approx(factor(0.3), rel=1e-4)
    inside = max(abs(q) * factor(q) * math.sin(q) / q for q in np.linspace(0.01, 0.3, 100))
    assert literal.eigenvalues[1] == pytest.approx(inside, rel=0.2)
    assert literal.contracts(-10.0)
    assert not listing.contracts(-10.0)


def test_hard_onset_is_where_the_largest_step_turns_the_error_round():
    found = bounds("tora")
    # at the guard the step is as long as its argument: 2 |h| = lambda |A| |h|
    assert found.hard_onset == pytest.approx(2 / (2 / 3 * 1.018), rel=1e-7)
    assert found.hard_step == pytest.approx(STEP, rel=1e-7)
    assert found.step_limit == pytest.approx(STEP, rel=1e-9)
    assert bounds("mimo_affine").hard_onset == pytest.approx(2 / 5.0002462348422405, rel=1e-7)
    # (4.1): the ratio of step and argument is largest where the tangent goes through the origin
    swing = bounds("swing")
    assert swing.hard_onset < 4.0 < swing.linear_limit  # chatters from somewhere in 4 ... 6
    u = np.linspace(1e-3, 20.0, 200_000)
    attractive = 1.762450721551041
    ratio = (attractive - 2 * np.tanh(0.5 * (attractive - u + 1))) / u
    assert swing.hard_onset == pytest.approx(2 / (ratio.max() * 1.1 * 1.0018), rel=1e-6)


def test_no_hard_onset_where_the_step_only_flattens():
    assert bounds("vdp_rfpt").hard_onset is None
    assert bounds("kapitza").hard_onset is None


def test_norm_form_without_guard_leaves_the_domain_beyond_its_limit():
    found = bounds("tora", fpt_deformer__guard="false")
    assert found.domain_limit == found.linear_limit
    assert found.hard_onset is None
    assert found.bands[-1].name == "leaves the domain"


def test_weights_and_delay_count():
    one = bounds("spherical_pendulum", "fixed_weights")
    two = bounds("spherical_pendulum", "fixed_weights", fpt_deformer__weights="[2.0, 1.0]")
    assert two.linear_limit == pytest.approx(one.linear_limit / 2, rel=1e-9)
    none = bounds("spherical_pendulum", "fixed_weights", fpt_deformer__learning_delay=1)
    assert one.feedback == pytest.approx(10 * none.feedback, rel=1e-12)
    assert one.feedback == pytest.approx(3 * 4 * 1e-3, rel=1e-12)


def test_sign_of_the_gain_follows_the_response():
    assert bounds("siso_affine").sign == -1
    turned = bounds("siso_affine", plant_simulator__exact__alpha=-1.0)
    assert turned.sign == 1
    assert turned.range[0] == 0.0
    assert turned.recommended == 1.2
    both = bounds("mimo_affine", plant_simulator__exact__m22=-2.0)
    assert both.sign == 0
    assert not both.contracts(-0.1)
    assert not both.contracts(0.1)
    nothing = bounds("siso_affine", plant_simulator__exact__alpha=0.0)
    assert nothing.sign == 0


def test_a_model_of_the_wrong_sign_in_the_map():
    deformer = load("siso_affine").loop().deformer
    for eigenvalue in (1.0, -1.0):
        one = scalar_map(deformer.transformation, deformer.constants.transformation, eigenvalue)
        assert one.slope == pytest.approx(F_SLOPE, rel=1e-12)
        assert one.step(1e-6) == pytest.approx(F_SLOPE * 1e-6, rel=1e-4)
        assert one.step(-1e-6) == pytest.approx(-F_SLOPE * 1e-6, rel=1e-4)


def test_two_cycles_return_and_their_multiplier_is_that_of_two_steps():
    deformer = load("siso_affine").loop().deformer
    one = scalar_map(deformer.transformation, deformer.constants.transformation, 1.0)
    for cycle in one.branch[50::40]:
        low = cycle.high - cycle.p * one.step(cycle.high)
        assert low == pytest.approx(cycle.low, rel=1e-9)
        assert low - cycle.p * one.step(low) == pytest.approx(cycle.high, rel=1e-9)
        near = list(zip(one.orbit(cycle.p, cycle.high + 1e-7), range(2), strict=False))
        changed = (near[1][0] - cycle.high) / 1e-7
        assert changed == pytest.approx(cycle.multiplier, rel=1e-3, abs=1e-4)


@pytest.mark.parametrize("name", ["vdp_aidc", "tora"])
def test_without_transformation_there_is_no_gain(name):
    variant = "adaptive" if name == "vdp_aidc" else "nonadaptive"
    with pytest.raises(BadInput, match=f"^{name} {variant} has no fixed point transformation"):
        contraction.bounds(load(name, variant))


def test_nominal_and_driven_motion_agree_and_the_driven_one_knows_q1():
    experiment = load("tora", duration=4.0)
    loop = experiment.loop()
    engine = Engine(loop)
    engine.run()
    points = gain_motion.along(engine, loop)
    course = gain_motion.course(experiment, points)
    # the larger eigenvalue is (M~ + m~ s^2)/(M + m s^2), the smaller Theta~/Theta
    s2 = np.array([math.sin(point.q[0]) ** 2 for point in points])
    assert course.eigenvalues[:, 1] == pytest.approx((20 + 10 * s2) / (30 + 20 * s2), rel=1e-7)
    assert course.eigenvalues[:, 0] == pytest.approx(np.full(len(s2), 0.25), rel=1e-7)
    assert contraction.bounds(experiment, points).linear_limit == pytest.approx(4.6575, rel=1e-3)
