"""The robustness protocol: its cases, its scores, and that it tells good loops from bad ones."""

import json
import math

import pytest

from fpt_ros.cli.app import run_command
from fpt_ros.experiments.experiment import load
from fpt_ros.robustness.protocol import CRITERIA, MODEL, Case, cases, changed
from fpt_ros.robustness.scores import Result, perform, scores


def test_the_cases_are_those_of_the_protocol():
    pendubot = load("pendubot")
    found = list(cases(pendubot, 6.0, 21))
    count = {name: sum(each.criterion == name for each in found) for name in CRITERIA}
    assert [count[name] for name in CRITERIA[1:]] == [21] * 5
    parameters = {next(iter(each.changes)) for each in found if each.criterion == MODEL}
    assert len(parameters) * 21 == count[MODEL]
    assert "exact.cf1" not in parameters  # it is zero: a quarter of it is nothing
    late = [each.changes["measurement_delay"] for each in found if each.criterion == "delay"]
    assert late == list(range(21))  # 0 to 40 ms in cycles of 2 ms
    parts = [
        each.changes["actuators.response.part"]
        for each in found
        if each.criterion == "torque response"
    ]
    assert (parts[0], parts[-1]) == (0.1, 2.0)
    assert all("saturation" in each.changes["actuators.kinds"] for each in found[-63:-42])


def test_every_case_can_be_loaded():
    for name in ("pendubot", "cart_beam_hamper", "lorenz"):
        experiment = load(name)
        for case in cases(experiment, 6.0, 2):
            changed(experiment, case).loop()


def test_scores_are_shares_and_their_mean():
    def result(criterion, error):
        return Result(Case(criterion, "", {}), error)

    found = [result("model", 0.01), result("model", 0.06), result("delay", math.inf)]
    assert scores(found, 0.05) == {"model": 0.5, "delay": 0.0, "overall": 0.25}


def test_the_error_is_a_part_of_the_motion():
    """The settled rms of the source over that of a sine."""
    error, largest, reason = perform(load("duffing", "nonadaptive"))
    assert reason == ""
    assert error == pytest.approx(5.13e-3 / (0.4 / math.sqrt(2.0)), rel=0.02)
    assert largest > 0.0


def test_the_command_shows_both_and_draws(tmp_path, capsys):
    arguments = ["robustness", "duffing", "--variant", "adaptive", "--variant", "nonadaptive"]
    arguments += ["--points", "2", "--workers", "1", "--tolerance", "0.01", "--json"]
    picture = tmp_path / "bars.svg"
    assert run_command([*arguments, "--plot", str(picture)]) == 0
    shown = json.loads(capsys.readouterr().out)
    assert shown["scores"]["adaptive"]["model"] > shown["scores"]["nonadaptive"]["model"]
    assert picture.read_text().startswith("<?xml")
    assert run_command(["robustness", "duffing", "--plot", "bars.pdf"]) == 2
    assert "ends with .png or .svg" in capsys.readouterr().err
