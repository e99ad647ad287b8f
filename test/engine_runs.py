"""Runs of the in-process engine: as arrays, as frames, and the same loop stage by stage."""

from fpt_ros.loop import experiment
from fpt_ros.loop.engine import Engine
from fpt_ros.loop.run import Collector
from fpt_ros.messages.topics import COMMAND, DESIRED, JOINT_STATES, STATE_ESTIMATE, TUNING


def topics_of(name, variant="adaptive", settings=(), duration=None, seed=None):
    """A whole run, compiled: topic -> series."""
    loaded = experiment.load(name, variant, settings, duration=duration, seed=seed)
    engine = Engine(loaded.loop())
    engine.run()
    return engine.topics()


def frames_of(loop):
    """What a loop shows, in the order of events: (topic, frame)."""
    seen = []
    engine = Engine(loop)
    engine.run()
    engine.frames(0, lambda topic, frame: seen.append((topic, frame)))
    return seen


def stage_by_stage(loop, observe, cycles=None):
    """The five stages frame by frame, each called as its node calls it: plain Python."""
    plant, command = loop.plant, None
    for cycle in range(plant.cycles if cycles is None else cycles):
        stamp = cycle * plant.cycle_time
        measured = plant.measure(stamp, cycle)
        observe(JOINT_STATES, measured)
        estimate = loop.denoiser.step(measured)
        observe(STATE_ESTIMATE, estimate)
        desired = loop.trajectory.step(estimate)
        observe(DESIRED, desired)
        tuning = ()
        if loop.tuner.active:
            wanted = (desired,) if loop.tuner.law.desired else ()
            tuning = (loop.tuner.step(estimate, *wanted, command),)
            observe(TUNING, *tuning)
        command = loop.deformer.step(estimate, desired, *tuning)
        observe(COMMAND, command)
        plant.advance(command, stamp)


def collected_stage_by_stage(loop, cycles=None):
    """The same as arrays: topic -> series."""
    collector = Collector()
    stage_by_stage(loop, collector, cycles)
    return collector.topics()
