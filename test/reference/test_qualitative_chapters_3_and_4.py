"""Where chattering begins, what guards and calculated gains do: bounds, not digits."""

import math

import numpy as np
import pytest
from engine_runs import chatter, settled_rms, topics_of
from run_measures import rms_of

from fpt_ros.errors import Diverged


def realised_errors(topics):
    """f(r_k) - r_k^Des: the response beside the wish that caused it."""
    desired, estimate = topics["desired"], topics["state_estimate"]
    return np.column_stack(
        [
            estimate.column("accelerations", name)[1:] - desired.column("accelerations", name)[:-1]
            for name in desired.names
        ]
    )


def tora_chatter(A):
    return chatter(topics_of("tora", settings=[f"fpt_deformer.A={A}"], duration=10.0), 4.0)


def test_chattering_begins_between_3_3_and_3_9():
    """Where exactly, a perturbation of 1e-12 decides: the onset is hard."""
    found = {A: tora_chatter(-A) for A in np.arange(3.0, 4.25, 0.1).round(1)}
    onset = min(A for A, indicator in found.items() if indicator > 0.1)
    assert 3.3 <= onset <= 3.9
    assert all(indicator < 0.01 for A, indicator in found.items() if onset > A)
    assert found[4.2] > 0.5


def test_chatter_hardly_harms_the_tracking_but_shakes_the_command():
    quiet, loud = topics_of("tora", "strong"), topics_of("tora", "chatter")
    assert chatter(loud, 4.0) > 50.0 * chatter(quiet, 4.0)
    assert all(each < 0.01 for each in settled_rms(loud, 4.0).values())


def test_the_precursor_guard_makes_the_chattering_gain_quiet():
    loud, guarded = topics_of("tora", "chatter"), topics_of("tora", "guarded")
    assert chatter(guarded, 8.0) < 0.1 * chatter(loud, 8.0)
    factor = guarded["tuning"].column("values", "gain_factor")
    assert factor[0] == 1.0
    assert (np.diff(factor) <= 0.0).all()
    assert factor[-1] < 1.0
    assert guarded["tuning"].column("values", "precursor")[-1] > 0.0


def test_the_calculated_gain_stays_in_its_bounds_and_is_quiet():
    topics = topics_of("tora_auto")
    tuning = topics["tuning"]
    A = tuning.column("values", "A")[tuning.time >= 4.0]
    assert -3.12 < A.min() < A.max() < -2.88
    assert chatter(topics, 4.0) < 0.01


def test_a_small_epsilon_lets_the_calculated_gain_burst():
    topics = topics_of("tora_auto", "small_epsilon")
    tuning = topics["tuning"]
    A = tuning.column("values", "A")[tuning.time >= 4.0]
    assert -12.0 < A.min() < -4.66
    assert -4.0 < A.max() < -2.0
    quiet = chatter(topics_of("tora_auto"), 4.0)
    assert 5.0 * quiet < chatter(topics, 4.0) < 100.0 * quiet
    assert all(each < 1e-4 for each in settled_rms(topics, 4.0).values())


def test_the_calculated_gain_is_too_slow_for_a_large_first_error():
    """a3 = 0.3, a2 = 1: lost at 1.93 s, where the fixed A = -0.1 works."""
    settings = ["trajectory_generator.amplitude=[0.3, 1.0]"]
    with pytest.raises(Diverged) as caught:
        topics_of("tora_auto", settings=settings)
    assert (caught.value.coordinate, caught.value.quantity) == ("q1", "position")
    assert caught.value.time == pytest.approx(1.93, abs=0.05)
    assert rms_of("tora", settings=settings)["q2"] < 0.01


def test_swing_chatters_from_somewhere_between_4_and_6():
    quiet, loud = (
        chatter(topics_of("swing", settings=[f"fpt_deformer.A={A}"], duration=6.9), 5.0)
        for A in (-4.0, -6.0)
    )
    assert quiet < 0.01
    assert loud > 20.0 * quiet


@pytest.mark.parametrize("variant", ["listing", "with_gravity"])
def test_kapitza_alternates_regularly_in_the_readings_of_4_6(variant):
    """A = -10 is beyond their bound of 5.1: period 2, tracking unharmed."""
    topics = topics_of("kapitza", variant)
    late = realised_errors(topics)[50_000:, 0]
    assert 0.12 < np.sqrt(np.mean(late**2)) < 0.13
    # it alternates: neighbours differ, cycles two apart hardly do
    assert np.abs(late[1:] - late[:-1]).mean() > 50.0 * np.abs(late[2:] - late[:-2]).mean()
    assert settled_rms(topics, 5.0)["q2"] < 1e-3


def test_kapitza_is_quiet_with_4_7_as_printed():
    topics = topics_of("kapitza")
    assert np.sqrt(np.mean(realised_errors(topics)[50_000:, 0] ** 2)) < 0.01


def test_large_fixed_weights_of_the_spherical_pendulum_chatter():
    """Diagonal 8, above the linear limit of 5.60 of the first row."""
    loud, quiet = (
        chatter(
            topics_of("spherical_pendulum", "fixed_weights", [f"fpt_deformer.weights=[{w}, {w}]"]),
            4.0,
        )
        for w in (8.0, 3.0)
    )
    assert 0.08 < loud < 0.15
    assert quiet < 0.01


def test_tuned_weights_saw_around_the_linear_limit():
    """Row 1 between 3.1 and 6.3 around 5.60, without persistent chatter."""
    topics = topics_of("spherical_pendulum")
    tuning = topics["tuning"]
    weight = tuning.column("values", "weight.q1")[tuning.time >= 6.0]
    assert 2.5 < weight.min() < 5.6 < weight.max() < 7.0
    loud = topics_of("spherical_pendulum", "fixed_weights", ["fpt_deformer.weights=[8, 8]"])
    assert chatter(topics, 4.0) < 0.3 * chatter(loud, 4.0)
    assert math.isfinite(chatter(topics, 4.0))
