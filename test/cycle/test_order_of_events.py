"""The five stages together: order of events, cycles, the same bits twice."""

import pytest
from stages_made import MS, frames_of, frames_of_the_engine, stages

from fpt_ros.engine.engine import CHUNK, Engine


@pytest.mark.parametrize("frames_of", [frames_of, frames_of_the_engine])
def test_order_and_stamps_of_the_events_of_a_cycle(frames_of):
    seen = frames_of(stages("vdp_rfpt", duration=0.003))
    cycle = ["joint_states", "state_estimate", "desired", "tuning", "command"]
    assert [name for name, _ in seen] == cycle * 3
    assert [frame.stamp for _, frame in seen] == [k * MS for k in range(3) for _ in cycle]
    seen = frames_of(stages("tora", duration=0.002))
    without_tuner = ["joint_states", "state_estimate", "desired", "command"]
    assert [name for name, _ in seen] == without_tuner * 2


def test_the_inputs_of_the_stages():
    def wants(stage):
        return [(each.topic.name, each.lag) for each in stage.inputs]

    loop = stages("vdp_rfpt")
    assert wants(loop.plant) == [("command", 0)]
    assert wants(loop.denoiser) == [("joint_states", 0)]
    assert wants(loop.trajectory) == [("state_estimate", 0)]
    assert wants(loop.tuner) == [("state_estimate", 0), ("command", 1)]
    assert wants(loop.deformer) == [("state_estimate", 0), ("desired", 0), ("tuning", 0)]
    loop = stages("tora")
    assert wants(loop.tuner) == []
    assert wants(loop.deformer) == [("state_estimate", 0), ("desired", 0)]


def test_number_of_cycles_and_progress():
    told = []
    engine = Engine(stages(duration=10.0))
    assert (engine.cycles, engine.done) == (10000, 0)
    engine.run(told.append)
    assert engine.done == 10000
    assert told == [0, CHUNK, 10000]
    assert stages(duration=0.0106).plant.cycles == 11


def test_two_runs_are_the_same_to_the_last_bit():
    for frames in (frames_of, frames_of_the_engine):
        first, second = (frames(stages("vdp_rfpt", duration=0.5)) for _ in range(2))
        assert repr(first) == repr(second)
