"""The recordings of ``bags/`` were made by the graph, some commits before: the numbers hold."""

from pathlib import Path

import pytest

from fpt_ros.replay.recorded import Recorded
from fpt_ros.replay.replayed import Replay
from fpt_ros.replay.rerun import rerun

BAGS = Path(__file__).parents[2] / "bags"


@pytest.mark.parametrize("name", ["tora", "tora_nonadaptive", "noisy_tora", "panda"])
def test_it_is_run_again(name: str) -> None:
    run = Recorded(BAGS / name)
    (whole,) = rerun(run).values()
    assert (whole.first, whole.notes) == (None, ())
    assert whole.cycles == run.total >= 1000
    deformer = Replay(run, "fpt_deformer").run()
    assert (deformer.first, deformer.cycles) == (None, run.total)
