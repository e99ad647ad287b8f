import json
import math

import numpy as np
import pytest

from fpt_ros.analysis import motions, signals
from fpt_ros.analysis.comparison import Row, baselines, comparison
from fpt_ros.analysis.metrics import summary
from fpt_ros.analysis.sizes import rms
from fpt_ros.plants import PLANTS
from fpt_ros.runs.run import Run

NAN = float("nan")


def tracked(hand_made, nominal, position, settle=0.0, times=None):
    times = times or [0.0, 1.0, 2.0, 3.0]
    return hand_made(
        {
            "joint_states": (times, ["q1"], {"position": position}),
            "desired": (times, ["q1"], {"positions": nominal}),
        },
        {"recorder": {"settle_time": settle}, "plant_simulator": {"dt": 1.0, "seed": 7}},
    )


@pytest.mark.parametrize(
    ("name", "variant", "expected"),
    [
        ("tora", "adaptive", {"q3": 0.00031688679, "q2": 0.00063307486}),
        ("tora", "nonadaptive", {"q3": 0.0095657199, "q2": 0.020473773}),
        ("vdp_rfpt", "adaptive", {"q1": 0.0009728430684892366}),
    ],
)
def test_settled_errors_are_those_of_the_independent_program(make, name, variant, expected):
    tracking = summary(make(name, variant))["tracking"]
    assert list(tracking) == list(expected)
    for coordinate, value in expected.items():
        assert tracking[coordinate]["rms_settled"] == pytest.approx(value, rel=1e-3)


def test_summary_names_the_run(make):
    one = summary(make("tora", duration=2.0))
    assert one["experiment"] == "tora"
    assert one["variant"] == "adaptive"
    assert one["engine"] == "in_process"
    assert one["adaptive"] is True
    assert one["cycles"] == 2000
    assert one["dt"] == 0.001
    assert one["duration"] == pytest.approx(2.0)
    assert one["settle_time"] == 4.0
    assert one["seed"] == 0
    assert one["complete"] is True
    assert summary(make("tora", "nonadaptive", 2.0))["adaptive"] is False


def test_errors_by_hand(hand_made):
    run = tracked(hand_made, [1, 2, 3, 4], [0, 2, 6, 8], settle=2.0)
    # e = 1, 0, -3, -4; settled: the last two
    assert summary(run)["tracking"]["q1"] == {
        "rms": pytest.approx(math.sqrt(26 / 4)),
        "max": 4.0,
        "rms_settled": pytest.approx(math.sqrt(12.5)),
        "max_settled": 4.0,
    }


def test_nothing_is_settled_in_a_run_that_ended_before(hand_made):
    found = summary(tracked(hand_made, [1, 2, 3, 4], [0, 0, 0, 0], settle=3.5))["tracking"]["q1"]
    assert found["rms_settled"] is None
    assert found["max_settled"] is None
    assert found["max"] == 4.0


def test_settled_counts_from_the_first_stamp_and_includes_the_settle_time(hand_made):
    late = [100.0, 100.1, 100.2, 100.3]
    run = tracked(hand_made, [9, 9, 9, 2], [0, 0, 0, 0], settle=0.3, times=late)
    assert summary(run)["tracking"]["q1"]["rms_settled"] == pytest.approx(2.0)


def test_messages_are_matched_by_stamp(hand_made):
    run = hand_made(
        {
            "joint_states": ([0.0, 1.0, 2.0], ["q0", "q1"], {"position": [[0, 1], [0, 2], [0, 3]]}),
            "desired": ([1.0, 2.0, 3.0], ["q1"], {"positions": [2, 8, 99]}),
        }
    )
    found = summary(run)
    assert found["tracking"] == {
        "q1": {
            "rms": pytest.approx(math.sqrt(25 / 2)),
            "max": 5.0,
            "rms_settled": pytest.approx(math.sqrt(25 / 2)),
            "max_settled": 5.0,
        }
    }
    assert found["cycles"] == 3


def test_cycles_without_control_do_not_count(hand_made):
    run = tracked(hand_made, [NAN, 3, NAN, 3], [50, 0, 50, 0])
    assert summary(run)["tracking"]["q1"]["rms"] == pytest.approx(3.0)


def test_chatter_and_effort_by_hand(hand_made):
    command = {
        "accelerations": [[0, 0, NAN], [3, 4, NAN], [3, NAN, NAN], [4, 9, NAN]],
        "effort": [[1, 0, 0], [-1, 0, 0], [1, 0, 0], [-5, 0, NAN]],
    }
    run = hand_made({"command": ([0, 1, 2, 3], ["q1", "q2", "q3"], command)})
    found = summary(run)
    # steps: |(3, 4)| = 5, |(0, -)| = 0, |(1, -)| = 1
    assert found["chatter"] == pytest.approx(2.0)
    assert found["effort"]["q1"] == {"rms": pytest.approx(math.sqrt(7.0)), "max": 5.0}
    assert found["effort"]["q3"] == {"rms": 0.0, "max": 0.0}


def test_one_cycle_makes_no_chatter(make, shorten):
    assert summary(shorten(make("tora", duration=1.0), 1))["chatter"] is None


def test_final_parameters_are_the_last_tuned_ones(make):
    run = make("vdp_rfpt", duration=1.0)
    last = run.topics["tuning"].vectors["values"][-1]
    names = ("m", "mu", "mu_c", "k", "beta", "lambda", "precursor", "gain_factor")
    assert summary(run)["final_parameters"] == dict(zip(names, last, strict=True))
    assert last[0] != 9.0


def test_final_parameters_without_tuner_are_the_models(make):
    found = summary(make("tora", duration=1.0))["final_parameters"]
    assert found == {"m": 10.0, "M": 20.0, "L": 2.0, "theta": 5.0, "g": 9.81}


@pytest.mark.parametrize("bad", [NAN, float("inf")])
def test_json_has_no_nan_and_no_numpy(hand_made, bad):
    run = hand_made(
        {
            "joint_states": ([0, 1], ["q1"], {"position": [bad, bad]}),
            "desired": ([0, 1], ["q1"], {"positions": [1, 2]}),
            "tuning": ([0, 1], ["A"], {"values": [1, bad]}),
            "command": ([0, 1], ["q1"], {"accelerations": [bad, 1], "effort": [bad, bad]}),
        }
    )
    found = json.loads(json.dumps(summary(run), allow_nan=False))
    assert found["tracking"]["q1"]["rms"] is None
    assert found["effort"]["q1"]["max"] is None
    assert found["chatter"] is None
    assert found["final_parameters"] == {"A": None}


def test_an_empty_run_has_a_summary():
    found = json.loads(json.dumps(summary(Run({}, {}, {})), allow_nan=False))
    assert found["cycles"] == 0
    assert found["tracking"] == {}
    assert found["chatter"] is None
    assert found["complete"] is False


def test_rms_of_numbers_whose_squares_overflow():
    assert rms(np.array([3e200, -4e200, NAN])) == pytest.approx(math.sqrt(12.5) * 1e200)
    assert rms(np.array([NAN])) is None
    assert rms(np.zeros(3)) == 0.0


def test_comparison_is_against_the_first_run_that_does_not_adapt(make):
    runs = [make("tora", v) for v in ("adaptive", "nonadaptive")]
    summaries = [summary(run) for run in runs]
    assert baselines(summaries) == [1, 1]
    row = comparison(summaries)[0]
    assert (row.coordinate, row.quantity) == ("q3", "rms_settled")
    assert row.ratios == (pytest.approx(0.0331273, rel=1e-3), 1.0)


def test_comparison_rows_cover_what_the_runs_have(make):
    summaries = [summary(make("tora")), summary(make("vdp_rfpt"))]
    rows = comparison(summaries)
    assert baselines(summaries) == [0, 1]
    assert [(r.coordinate, r.quantity) for r in rows] == [
        ("q3", "rms_settled"),
        ("q3", "max_settled"),
        ("q3", "rms"),
        ("q2", "rms_settled"),
        ("q2", "max_settled"),
        ("q2", "rms"),
        ("q2", "effort"),
        ("q1", "rms_settled"),
        ("q1", "max_settled"),
        ("q1", "rms"),
        ("q1", "effort"),
        ("", "chatter"),
    ]
    assert rows[0].values[1] is None
    assert rows[0].ratios[1] is None
    assert rows[-1].ratios == (1.0, 1.0)


def test_ratio_against_zero_is_none(hand_made):
    perfect = summary(tracked(hand_made, [1, 1, 1, 1], [1, 1, 1, 1]))
    other = summary(tracked(hand_made, [1, 1, 1, 1], [0, 0, 0, 0]))
    assert comparison([perfect, other])[0] == Row("q1", "rms_settled", (0.0, 1.0), (None, None))


def test_realised_response_stands_beside_the_command_that_caused_it(hand_made):
    estimate = {"accelerations": [NAN, 10, 20]}
    run = hand_made({"state_estimate": ([5.0, 6.0, 7.0], ["q1"], estimate)})
    time, response = signals.realised_response(run, "q1")
    assert time.tolist() == [0.0, 1.0]
    assert response.tolist() == [10.0, 20.0]


def test_realised_response_is_the_exact_plants_answer_to_the_same_cycles_force(make):
    run = make("tora", duration=1.0)
    plant = PLANTS["tora"]
    exact = plant.coefficients([20.0, 30.0, 2.0, 20.0, 9.81])
    state, force = run.topics["joint_states"].vectors, run.topics["command"].vectors["effort"]
    _, realised = signals.realised_response(run, "q2")
    answer = [0.0] * 3
    for k in (0, 1, 40, 998):
        plant.response(exact, state["position"][k], state["velocity"][k], force[k], answer)
        assert realised[k] == pytest.approx(answer[1], abs=1e-9)


@pytest.mark.parametrize(("name", "expected"), [("tora", 4.0), ("vdp_rfpt", math.pi)])
def test_period_of_the_nominal_motion(make, name, expected):
    run = make(name)
    parts = [motions.motion(run, c) for c in signals.controlled(run)]
    assert motions.period(parts) == pytest.approx(expected, rel=1e-2)


def test_exact_coefficients_are_the_models_with_the_plants_parameters(make):
    found = signals.exact_coefficients(make("vdp_rfpt", duration=1.0))
    assert found == {"m": 10.0, "mu": 1.0, "mu_c": 3.0, "k": 100.0, "beta": 1.0, "lambda": 2.0}
    assert signals.exact_coefficients(make("tora", duration=1.0))["mL2_theta"] == 100.0
    assert signals.exact_coefficients(Run({}, {}, {})) == {}
