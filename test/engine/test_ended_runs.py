"""A run that ends early, by whoever watches it or by what goes wrong in a cycle."""

import numpy as np
import pytest
from engine_runs import stage_by_stage
from frames_collected import Collector
from whole_loops import assert_identical, finished, load

from fpt_ros.engine.engine import Engine
from fpt_ros.errors import Diverged
from fpt_ros.experiments import experiment


def test_what_ends_a_run_leaves_the_cycles_before_it():
    class Stop(Exception):
        pass

    engine = Engine(load("vdp_rfpt", "adaptive", cycles=20_000).loop())

    def progress(cycle):
        if cycle:
            raise Stop

    with pytest.raises(Stop):
        engine.run(progress)
    done = engine.done
    assert 0 < done < engine.cycles
    assert len(engine.topics()["command"].stamps) == done
    whole, _ = finished(load("vdp_rfpt", "adaptive", cycles=20_000).loop())
    kept = engine.topics()["command"].vectors["effort"]
    assert np.array_equal(kept, whole.topics()["command"].vectors["effort"][:done])


def test_a_run_ended_by_progress_goes_on_where_it_was():
    loaded = load("tora_auto", "adaptive", cycles=20_000)
    engine = Engine(loaded.loop())
    told = []

    def progress(cycle):
        told.append(cycle)
        if len(told) == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        engine.run(progress)
    engine.run()
    assert_identical(engine.topics(), finished(loaded.loop())[0].topics())


@pytest.mark.parametrize(
    ("name", "settings", "cycle"),
    [
        ("tora", ("plant_simulator.limit.acceleration=1e-3",), 0),
        ("tora", ("fpt_deformer.guard=false", "fpt_deformer.A=-4"), 1),
        ("tora", ("fpt_deformer.A=0.1",), 411),
        ("vdp_modified", ("plant_simulator.initial_position=[100.0]",), None),
    ],
)
def test_a_cycle_that_fails_is_told_as_the_stages_tell_it(name, settings, cycle):
    """In the first cycle, in the second, and late; only the remedy in brackets may differ."""
    loaded = experiment.load(name, settings=settings)
    engine = Engine(loaded.loop())
    with pytest.raises(Diverged) as ours:
        engine.run()
    collector = Collector()
    with pytest.raises(Diverged) as theirs:
        stage_by_stage(loaded.loop(), collector)
    assert str(ours.value).split(" (")[0] == str(theirs.value).split(" (")[0]
    assert ours.value.cycle == theirs.value.cycle
    if cycle is not None:
        assert ours.value.cycle == cycle
    # a command that was given is in the arrays, also where the plant did not survive it
    expected = collector.topics().get("command")
    found = engine.topics()["command"]
    if expected is None:
        assert len(found.stamps) == 0
    else:
        assert_identical({"command": found}, {"command": expected})
