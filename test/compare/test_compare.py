"""``fpt compare``: all controllers under all circumstances, the same for the same seed."""

import json
import signal
from pathlib import Path

import numpy as np
import pytest
from command import TIMEOUT, forked_fpt, forked_fpt_json, start_fpt

from fpt_ros.compare.compare import define
from fpt_ros.compare.field import field, variant
from fpt_ros.compare.measures import Spent, simulate
from fpt_ros.compare.results import results_of
from fpt_ros.compare.task import run_task
from fpt_ros.compare.tuned import tuned_parameters
from fpt_ros.compare.verdicts import front, verdicts
from fpt_ros.engine.engine import Engine
from fpt_ros.errors import BadInput
from fpt_ros.experiments.experiment import load

SHORT = ("--duration", "0.4", "--set", "recorder.settle_time=0.2")
FEW = ("--controllers", "adaptive,nonadaptive", *SHORT)


def test_the_field_of_an_arm():
    pytest.importorskip("mujoco")
    found = field("panda")
    names = [each.name for each in found.controllers]
    assert {"adaptive", "pid", "momentum_observer", "slotine_li"} <= set(names)
    assert [each.name for each in found.controllers if each.family] == [
        "adaptive",
        "printed",
        "rfpt",
    ]
    usual, *graded = found.groups
    assert [each.name for each in usual] == [
        "as it is",
        "fast",
        "no_armature",
        "pickup",
        "saturated",
    ]
    assert [group[0].name for group in graded] == [
        "delayed 1",
        "delayed 2",
        "delayed 3",
        "noisy 1e-06",
        "noisy 1e-05",
        "noisy 0.0001",
    ]
    pid = found.controllers[names.index("pid")]
    loud = found.load(pid, graded[5][0])
    assert variant(pid, graded[5][0]) == loud.variant == "noisy+pid"
    assert loud.nodes["plant_simulator"]["noise.position"] == 1e-4
    assert loud.nodes["denoiser"]["densities"] == pytest.approx([113.9])  # the same bandwidth
    late = found.load(found.controllers[0], graded[2][0])
    assert late.nodes["plant_simulator"]["measurement_delay"] == 3
    assert late.nodes["trajectory_generator"]["nominal_delay"] == 3
    assert late.nodes["fpt_deformer"]["sensor_delay"] == 3


def test_variants_that_change_the_plant_are_no_controllers():
    found = field("vdp_aidc")
    assert [each.name for each in found.controllers] == ["adaptive", "fixed"]
    assert [each.name for each in found.circumstances] == ["as it is", "disturbed"]
    assert found.left_out["fixed_disturbed"] == "it changes the plant"


def test_what_is_measured_is_what_a_whole_run_says():
    experiment = load("tora", duration=0.5)
    spent = Spent()
    kept = Engine(experiment.loop())
    kept.run()
    topics = kept.topics()
    effort = topics["command"].vectors["effort"]
    Engine(experiment.loop(), consumers=[spent]).run()
    found = spent.result(effort.shape[1])
    assert found["step"] == pytest.approx(np.abs(np.diff(effort, axis=0)).mean())
    assert found["effort"] == pytest.approx(np.sqrt(np.mean(effort**2)))
    assert found["cut"] == 0.0
    error = simulate(experiment, experiment.loop())["whole"]["error"]
    assert error is None  # the settle time is later than the run


def test_efforts_that_are_cut_are_counted():
    pytest.importorskip("mujoco")
    experiment = load("panda", "saturated", duration=0.3, settings=["recorder.settle_time=0.1"])
    kept, spent = Engine(experiment.loop()), Spent()
    kept.run()
    asked = kept.topics()["command"].vectors["effort"][:-1]
    acted = kept.topics()["joint_states"].vectors["effort"][1:]
    limits = experiment.nodes["plant_simulator"]["exact.torque_limit"]
    assert np.array_equal(acted, np.clip(asked, np.negative(limits), limits))
    Engine(experiment.loop(), consumers=[spent]).run()
    expected = (acted != asked).any(axis=1).mean()
    assert 0.0 < expected < 1.0
    assert spent.result(7)["cut"] == pytest.approx(expected)


def test_what_is_tuned_of_a_controller():
    pytest.importorskip("mujoco")
    names = {
        word: [str(each.target) for each in tuned_parameters(load("panda", word))]
        for word in ("adaptive", "momentum_observer", "noisy+rfpt", "slotine_li")
    }
    own = "trajectory_generator.lambda"
    assert names["adaptive"] == [own, "fpt_deformer.A", "fpt_deformer.scale"]
    assert names["momentum_observer"] == [own, "fpt_deformer.compensator.gain"]
    assert names["noisy+rfpt"] == [own, "fpt_deformer.A", "denoiser.densities[0]"]
    assert names["slotine_li"] == [own, "parameter_tuner.gamma"]
    assert [str(p.target) for p in tuned_parameters(load("panda"), [own])] == names["adaptive"][1:]


def test_a_tuned_controller_is_better_on_a_seed_that_it_has_not_seen():
    settings = ("recorder.settle_time=1.0",)
    asked = define("noisy_tora", ["adaptive"], [], settings, 2.0, 16, 0, 1e6)
    plain = define("noisy_tora", ["adaptive"], [], settings, 2.0, 0, 0, 1e6)
    tuned, before = run_task(asked.plan, 0), run_task(plain.plan, 0)
    assert "denoiser.densities[0]" in tuned["tuning"]["before"]
    assert tuned["tuning"]["found"] != tuned["tuning"]["before"]
    assert tuned["runs"]["as it is"]["error"] < before["runs"]["as it is"]["error"]


def test_the_front_of_points():
    points = [(1.0, 5.0), (2.0, 3.0), (2.5, 4.0), (3.0, 3.0), (4.0, 1.0), (1.0, 6.0)]
    assert front(points) == [(1.0, 5.0), (2.0, 3.0), (4.0, 1.0)]


def run_of(error, step=0.1, outcome="complete", reason=""):
    numbers = {"max": error, "effort": 1.0, "cut": 0.0, "deviation": 1.0, "cost": 1.0}
    return {"outcome": outcome, "reason": reason, "error": error, "step": step, **numbers}


@pytest.mark.parametrize(
    ("ours", "theirs", "kind", "text"),
    [
        (run_of(0.1), run_of(0.4), "wins", "adaptive 0.1 (effort steps 0.1), 4 times less than"),
        (run_of(0.3), run_of(0.1), "loses", "3 times more than nonadaptive 0.1"),
        (run_of(0.1), run_of(0.11), "equals", "about as much as nonadaptive 0.11"),
        (run_of(0.1), run_of(0.6), "alone", "no controller of the other family follows"),
        (run_of(0.1, outcome="diverged", reason="x"), run_of(0.1), "beaten", "nonadaptive 0.1"),
        (run_of(0.9), run_of(0.6), "nobody", "no controller follows the motion"),
        (run_of(0.1, step=1e9), run_of(0.2), "beaten", "nonadaptive 0.2"),
    ],
)
def test_verdicts_are_those_of_the_numbers(ours, theirs, kind, text):
    asked = define("tora", ["adaptive", "nonadaptive"], [], (), None, 0, 0, 1.0)
    rows = [{"runs": {"as it is": one}, "tuning": None} for one in (ours, theirs)]
    (found,) = verdicts(results_of(asked, rows))
    assert found.kind == kind
    assert text in found.text


def test_a_page_and_the_same_numbers_again(tmp_path):
    command = ("compare", "tora", *FEW, "--tune", "--trials", "3", "--limit", "100")
    found = forked_fpt_json(*command, "--out", tmp_path / "one")
    page = (tmp_path / "one" / "index.html").read_text()
    assert "controllers compared" in page
    assert 'src="data:image/svg+xml' in page
    assert {each["controller"] for each in found["tuning"]} == {"adaptive", "nonadaptive"}
    assert all(len(each["trials"]) >= 3 for each in found["tuning"])
    again = forked_fpt_json(*command, "--out", tmp_path / "two", "--workers", "1")
    for one in (found, again):
        one.pop("cost")
        one.pop("page")
    assert found == again
    one, two = ((tmp_path / name / "results.json") for name in ("one", "two"))
    assert json.loads(one.read_text())["results"] == json.loads(two.read_text())["results"]
    for each in found["results"]:
        run = simulate_again(each, found["tuning"])
        assert run == pytest.approx(each["error"], rel=1e-12)


def simulate_again(each, tunings):
    """What ``fpt simulate`` says with the settings that were found."""
    (tuning,) = [one for one in tunings if one["controller"] == each["controller"]]
    settings = [f"{name}={value!r}" for name, value in tuning["found"].items()]
    settings.append("recorder.settle_time=0.2")
    experiment = load("tora", each["variant"], settings, 0.4)
    return simulate(experiment, experiment.loop())["whole"]["error"]


def test_ctrl_c_and_the_same_command_goes_on(tmp_path):
    command = ("compare", "tora", *SHORT, "--out", tmp_path / "out", "--workers", "1")
    process = start_fpt(*command)
    journal = tmp_path / "out" / "journal.jsonl"
    while process.poll() is None and not (journal.exists() and journal.read_text().count("\n")):
        pass
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=TIMEOUT)
    if process.returncode == 0:
        pytest.skip("it was faster than Ctrl-C")
    assert process.returncode == 130
    assert "the same command goes on" in said.splitlines()[-1]
    done = journal.read_text().splitlines()
    assert not (tmp_path / "out" / "index.html").exists()
    forked_fpt_json(*command)
    assert journal.read_text().splitlines()[: len(done)] == done
    assert (tmp_path / "out" / "index.html").exists()


@pytest.mark.parametrize(
    ("arguments", "wrong"),
    [
        (["nope"], "no experiment 'nope'"),
        (["tora", "--controllers", "nope"], "tora has no variant 'nope'"),
        (["tora", "--variants", "nope"], "tora has no variant 'nope'"),
        (["tora", "--trials", "3"], "--trials is of --tune"),
        (["tora", "--tune", "--trials", "0"], "--trials 0 is not valid"),
        (["tora", "--tune", "--limit", "-1"], "--limit -1 is not valid"),
        (["tora", "--tune", "--hold", "fpt_deformer.Q"], "fpt_deformer has no parameter 'Q'"),
        (["tora", "--workers", "0"], "--workers 0 is not valid"),
    ],
)
def test_wrong_input_is_one_line(arguments, wrong, tmp_path):
    done = forked_fpt("compare", *arguments, cwd=tmp_path)
    assert done.returncode == 2
    assert wrong in done.stderr
    assert done.stderr.count("\n") == 1
    assert not list(Path(tmp_path).iterdir())


def test_a_directory_of_something_else_stays(tmp_path):
    (tmp_path / "mine.txt").write_text("mine")
    done = forked_fpt("compare", "tora", *FEW, "--out", tmp_path)
    assert done.returncode == 2
    assert "holds other files" in done.stderr


def test_variants_over_each_other():
    both = load("vdp_aidc", "disturbed+fixed")
    assert both.variant == "disturbed+fixed"
    assert both.nodes["plant_simulator"] == load("vdp_aidc", "disturbed").nodes["plant_simulator"]
    assert both.nodes["parameter_tuner"] == load("vdp_aidc", "fixed").nodes["parameter_tuner"]
    for wrong in ("disturbed+nope", "+fixed"):
        with pytest.raises(BadInput, match="has no variant"):
            load("vdp_aidc", wrong)
