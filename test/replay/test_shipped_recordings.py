"""The recordings of ``bags/`` were made by the graph, some commits before: the numbers hold.

The last bits of sin and exp are those of the processor: elsewhere the first difference is as small.
"""

from pathlib import Path

import pytest

from fpt_ros.replay.recorded import Recorded
from fpt_ros.replay.replayed import Replay
from fpt_ros.replay.rerun import rerun

BAGS = Path(__file__).parents[2] / "bags"


def assert_same_but_for_the_processor(comparison) -> None:
    first = comparison.first
    if first is not None:
        assert first.now == pytest.approx(first.recorded, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("name", ["tora", "tora_nonadaptive", "noisy_tora", "panda"])
def test_it_is_run_again(name: str) -> None:
    run = Recorded(BAGS / name)
    (whole,) = rerun(run).values()
    assert_same_but_for_the_processor(whole)
    assert whole.notes == ()
    assert whole.cycles == run.total >= 1000
    deformer = Replay(run, "fpt_deformer").run()
    assert_same_but_for_the_processor(deformer)
    assert deformer.cycles == run.total
