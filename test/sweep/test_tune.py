import pytest

from fpt_ros.errors import BadInput, RunFailed
from fpt_ros.experiments.experiment import load
from fpt_ros.experiments.locate import config_directory
from fpt_ros.sweep import tune
from fpt_ros.sweep.metric import metric
from fpt_ros.sweep.overlay import check_overlay, write_overlay

QUIET = "chatter=0.02"


def search(task, trials=25, seed=3):
    return tune.search(task, trials, seed, lambda done, best: None)


def task_of(limits=(QUIET,), variant="adaptive", over=("fpt_deformer.A=-8:-0.05",)):
    return tune.define("tora", variant, (), 6.0, over, ("rms_settled",), limits)


def test_it_improves_and_keeps_within_the_limit(tmp_path):
    task = task_of()
    found = search(task)
    for name in task.metrics:
        assert metric(found.after, name) < metric(found.before, name) / 3.0
    assert metric(found.after, "chatter") <= 0.02
    assert search(task).found == found.found


@pytest.mark.parametrize("variant", ["adaptive", "chatter"])
def test_the_overlay_is_an_ordinary_variant(tmp_path, variant):
    """Beside a copy of the base file it gives the run that was found, whatever it began with."""
    task = task_of(variant=variant)
    found = search(task, 12)
    base = tmp_path / "tora.yaml"
    base.write_text((config_directory() / "tora.yaml").read_text())
    write_overlay(task, found, tmp_path / "tora.tuned.yaml")
    again = load(str(base), "tuned")
    for node, values in found.experiment.nodes.items():
        ignored = {"experiment", "variant", "shows"}
        assert {k: v for k, v in again.nodes[node].items() if k not in ignored} == {
            k: v for k, v in values.items() if k not in ignored
        }


def test_a_file_of_somebody_else_is_not_touched(tmp_path):
    path = tmp_path / "mine.yaml"
    path.write_text("a: 1\n")
    with pytest.raises(BadInput, match=r"exists and is not of fpt tune"):
        check_overlay(path)


def test_a_limit_that_nothing_meets():
    with pytest.raises(RunFailed, match=r"none of 3 runs is within chatter <= 1e-09"):
        search(task_of(limits=("chatter=1e-9",)), 3)


@pytest.mark.parametrize(
    ("over", "limits", "complaint"),
    [
        ("fpt_deformer.Q", QUIET, "has no parameter 'Q'"),
        ("fpt_deformer.transformation", QUIET, "is no number"),
        ("fpt_deformer.A=-1", QUIET, "NODE.PARAM=LOW:HIGH"),
        ("fpt_deformer.A=-1:-1", QUIET, "the range is empty"),
        ("fpt_deformer.K=-1:1", QUIET, "it takes a number > 0 and <= 2"),
        ("plant_simulator.safe_effort", QUIET, "is 0, so a range has to be given"),
        ("fpt_deformer.A", "noise=1", "there is no metric 'noise'"),
        ("fpt_deformer.A", "chatter", "METRIC=VALUE"),
        ("", QUIET, "nothing is to be tuned"),
    ],
)
def test_bad_input(over, limits, complaint):
    with pytest.raises(BadInput) as caught:
        task_of(limits=(limits,), over=(over,))
    assert complaint in str(caught.value)
