"""The claims of the thesis: what they use and cover, and that verdicts follow the numbers."""

import math
import re
import shlex
from itertools import pairwise

import numpy as np
import pytest

from fpt_ros.errors import BadInput
from fpt_ros.experiments.experiment import available, load
from fpt_ros.thesis import measures
from fpt_ros.thesis.claim import (
    NO,
    ONLY_IF,
    STATUSES,
    YES,
    Claim,
    Setup,
    Verdict,
    chapters,
    numbers,
)
from fpt_ros.thesis.commands import commands
from fpt_ros.thesis.page import number_words

CHAPTERS = (2, 3, 4, 5, 6, 7)
CLAIMS = {name: claim for n in CHAPTERS for name, claim in chapters()[n].claims.items()}

DRAWN = numbers("2.1-2.33, 3.1-3.34, 4.3-4.6, 4.9-4.28, 5.2-5.3, 6.1-6.5")
"""The thesis's figures with results; the others are schemes (4.1, 4.2, 4.7, 4.8, 5.1)."""


def judged(name):
    claim = CLAIMS[name]
    return claim.judge(claim.perform())


# --- what there is


def test_every_experiment_and_variant_is_used():
    setups = [s for claim in CLAIMS.values() for s in claim.runs.values() if isinstance(s, Setup)]
    used = {(setup.name, setup.variant) for setup in setups}
    there = {(name, variant) for name, variants in available().items() for variant in variants}
    assert there - used == set()


def test_every_figure_with_results_is_drawn_and_claimed():
    drawn = {n for c in CLAIMS.values() for p in c.pictures for n in numbers(p.thesis)}
    claimed = {n for claim in CLAIMS.values() for n in numbers(claim.figures)}
    assert set(DRAWN) - drawn == set()
    assert set(DRAWN) - claimed == set()
    assert drawn <= set(DRAWN)


def test_a_chapter_is_found_by_its_file():
    assert set(CHAPTERS) <= set(chapters())
    for number, chapter in chapters().items():
        assert chapter.number == number
        assert chapter.title


def test_names_are_the_sections_with_a_letter():
    for name, claim in CLAIMS.items():
        assert name[:-1] == claim.section
        assert re.fullmatch(r"\d(\.\d)*[a-z]", name)
        assert claim.text.endswith(".")


def test_figure_ranges_are_spelt_out():
    assert numbers("2.1-2.3, 3.4") == ["2.1", "2.2", "2.3", "3.4"]
    assert numbers("") == []


@pytest.mark.parametrize("claim", CLAIMS.values(), ids=CLAIMS)
def test_every_run_of_a_claim_is_an_experiment(claim):
    seen = set()
    for setup in claim.runs.values():
        if not isinstance(setup, Setup):
            continue
        if (setup.name, setup.variant, len(setup.settings)) not in seen:  # scans: one of them
            seen.add((setup.name, setup.variant, len(setup.settings)))
            setup.experiment()


# --- commands


def test_a_command_makes_the_run_that_it_is_of():
    setup = Setup("tora", "strong", ("trajectory_generator.amplitude=[0.3, 1.0]",), 2.0)
    words = shlex.split(setup.command())
    assert words[:5] == ["fpt", "simulate", "tora", "--variant", "strong"]
    settings = [after for word, after in pairwise(words) if word == "--set"]
    again = load(words[2], words[4], settings, float(words[words.index("--duration") + 1]))
    assert again.nodes == setup.experiment().nodes


def test_a_scan_is_a_loop_of_the_shell():
    runs = {f"{A}": Setup("tora", settings=(f"fpt_deformer.A={A}",)) for A in range(-6, 0)}
    claim = Claim("1", "", "", {**runs, "none": Setup("tora", "nonadaptive")}, lambda _: None)
    assert commands(claim) == [
        "for x in -6 -5 -4 -3 -2 -1; do fpt simulate tora --set fpt_deformer.A=$x; done",
        "fpt simulate tora --variant nonadaptive",
    ]


# --- measures


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
    verdict = measures.precise("better", "worse", factor)(pair)
    assert verdict.status == status
    assert verdict.measured["q1, rms error, better"] == pytest.approx(0.1)
    assert "10 (q1) times smaller" in verdict.reason


def test_a_lost_run_is_not_precise(pair):
    verdict = measures.precise("lost", "worse", 2.0)(pair)
    assert verdict.status == NO
    assert verdict.measured["q1, rms error, lost"] is None


@pytest.mark.parametrize(
    ("values", "part"),
    [((9.0, 10.0, 10.0), 1.0), ((9.0, 9.5, 10.0), 0.5), ((9.0, 8.0, 10.0), -1.0)],
)
def test_what_is_learned_is_a_part_of_the_first_error(values, part):
    assert measures.learned(*values) == pytest.approx(part)


def test_thinned_keeps_the_first_of_every_stretch(pair):
    thin = measures.thinned(pair["worse"], 5)
    assert thin.topics["command"].time == pytest.approx([0.0, 0.2, 0.4, 0.6, 0.8])


@pytest.mark.parametrize(
    ("value", "words"),
    [(None, "–"), (math.inf, "lost"), (3.0, "3"), (1.23456e-5, "1.235e-5"), ("yes", "yes")],
)
def test_numbers_on_the_page(value, words):
    assert number_words(value) == words


# --- verdicts: quick runs, and numbers of the description of the experiments


@pytest.mark.parametrize(
    ("name", "status", "measured"),
    [
        ("3.1.1b", YES, {"iterations until |h| < 1e-6": 38}),
        ("3.1.1c", NO, {"iterations until |h| < 1e-6": 9}),
        ("3.1.1d", YES, {"iterations until |h| < 1e-3": 147, "iterations until |h| < 1e-6": 411}),
        ("3.2.1a", NO, {}),
        (
            "3.2.1b",
            ONLY_IF,
            {
                "iterations until ||h|| < 1e-6, A = -0.20": 105,
                "iterations until ||h|| < 1e-6, A = -0.27425": 74,
            },
        ),
        (
            "4.3.4a",
            YES,
            {"largest difference from sin over [0, pi]": pytest.approx(0.0739, abs=1e-4)},
        ),
        ("2.2.1b", ONLY_IF, {"least m^ from an offset, R = 5": pytest.approx(8.67, abs=0.01)}),
        ("2.2.2e", ONLY_IF, {"disturbance with a peak of 41.8": "lost at 5.38 s"}),
        ("3.2.2a", YES, {}),
        ("1.1a", YES, {}),
    ],
)
def test_verdicts(name, status, measured):
    verdict = judged(name)
    assert verdict.status == status
    assert {key: verdict.measured[key] for key in measured} == measured


def test_the_onset_lies_where_the_description_has_it():
    """Last quiet A -3.559, first chattering -3.560; the brief's bounds are [-3.9, -3.3]."""
    verdict = judged("3.2.2e")
    assert verdict.status == ONLY_IF
    assert -3.9 <= verdict.measured["first chattering A"] <= -3.3


def test_verdicts_follow_the_runs_and_not_the_claim():
    """The same judges with the runs of other settings come to other verdicts."""
    fast = CLAIMS["3.1.1c"]
    monotone = Setup("siso_affine", settings=("fpt_deformer.A=-1.5",))
    runs = {"A = -0.5": Setup("siso_affine"), "A = -2": monotone}
    assert fast.judge({key: setup.perform(key) for key, setup in runs.items()}).status == YES
    printed = CLAIMS["3.2.1a"]
    assert printed.judge({"A = 0.20": Setup("mimo_affine").perform("")}).status == YES
    guard = CLAIMS["1.1a"]
    loud = Setup("tora", "chatter").perform("")
    assert guard.judge({"A = -4.2": loud, "A = -4.2, guarded": _without_guard()}).status == NO


def _without_guard():
    settings = ("parameter_tuner.precursor_guard=false", "parameter_tuner.precursor=true")
    return Setup("tora", "guarded", settings).perform("")


def test_a_run_that_diverges_is_a_result():
    run = Setup("vdp_modified", "alpha10_disturbed").perform("A = 50")
    assert not measures.complete(run)
    assert measures.end(run) == pytest.approx(5.38, abs=0.01)
    assert run.info["variant"] == "A = 50"


def test_an_unknown_experiment_is_bad_input():
    with pytest.raises(BadInput, match="no experiment 'nothing'"):
        Setup("nothing").experiment()


def test_statuses():
    assert STATUSES == (YES, ONLY_IF, NO)
    assert Verdict(YES, {}, "").table is None
