"""What judges measure, and the verdicts they have in common, on runs made by hand."""

import math

import numpy as np
import pytest

from fpt_ros.thesis import judges, learning, measures
from fpt_ros.thesis.claim import NO, YES
from fpt_ros.thesis.page import number_words


@pytest.fixture
def pair(hand_made):
    """Two runs of 10 cycles: errors of 1 and 0.1, settled from 0.5 s on."""

    def made(size, steps, complete="true"):
        times = np.arange(10) * 0.1
        ones = np.ones((10, 1))
        r = np.cumsum(steps * ones, axis=0)
        wild = np.where(times[:, None] < 0.45, 100.0, size)
        topics = {
            "joint_states": (times, ["q1"], {"position": -wild}),
            "state_estimate": (times, ["q1"], {"accelerations": 3.0 * ones}),
            "desired": (times, ["q1"], {"accelerations": ones}),
            "command": (times, ["q1"], {"accelerations": r}),
        }
        parameters = {"recorder": {"settle_time": 0.5}}
        return hand_made(topics, parameters, complete=complete)

    return {"worse": made(1.0, 0.5), "better": made(0.1, 2.0), "lost": made(0.1, 1.0, "false")}


def test_settled_errors_leave_out_what_is_before(pair):
    assert measures.settled_rms(pair["worse"], "q1") == pytest.approx(1.0)
    assert measures.settled_rms(pair["lost"], "q1") == math.inf


def test_chatter_is_the_mean_step(pair):
    assert measures.chatter(pair["better"]) == pytest.approx(2.0)
    assert measures.chatter(pair["lost"]) == math.inf


def test_the_response_belongs_to_the_cycle_that_asked_for_it(pair):
    assert measures.response_errors(pair["worse"]) == pytest.approx([2.0] * 4)


@pytest.mark.parametrize(("factor", "status"), [(9.9, YES), (10.1, NO)])
def test_precision_is_judged_by_the_ratio(pair, factor, status):
    verdict = judges.precise("better", "worse", factor)(pair)
    assert verdict.status == status
    assert verdict.measured["q1, rms error, better"] == pytest.approx(0.1)
    assert "10 (q1) times smaller" in verdict.reason


def test_a_lost_run_is_not_precise(pair):
    verdict = judges.precise("lost", "worse", 2.0)(pair)
    assert verdict.status == NO
    assert verdict.measured["q1, rms error, lost"] is None


@pytest.mark.parametrize(
    ("values", "part"),
    [((9.0, 10.0, 10.0), 1.0), ((9.0, 9.5, 10.0), 0.5), ((9.0, 8.0, 10.0), -1.0)],
)
def test_what_is_learned_is_a_part_of_the_first_error(values, part):
    assert learning.learned(*values) == pytest.approx(part)


def test_thinned_keeps_the_first_of_every_stretch(pair):
    thin = measures.thinned(pair["worse"], 5)
    assert thin.topics["command"].time == pytest.approx([0.0, 0.2, 0.4, 0.6, 0.8])


@pytest.mark.parametrize(
    ("value", "words"),
    [(None, "–"), (math.inf, "lost"), (3.0, "3"), (1.23456e-5, "1.235e-5"), ("yes", "yes")],
)
def test_numbers_on_the_page(value, words):
    assert number_words(value) == words
