"""Runs of the in-process engine: as arrays, as frames, and the same loop stage by stage."""

import numpy as np

from fpt_ros.cycle.run import Run
from fpt_ros.engine.engine import Engine
from fpt_ros.experiments import experiment
from fpt_ros.runs.chunks import frames


def topics_of(name, variant="adaptive", settings=(), duration=None, seed=None):
    """A whole run, compiled: topic -> series."""
    return run(experiment.load(name, variant, settings, duration, seed))


def run(loaded):
    """A whole run of an experiment that is loaded: topic -> series."""
    engine = Engine(loaded.loop())
    engine.run()
    return engine.topics()


def frames_of(loop):
    """What the engine shows, in the order of events: (topic, frame)."""
    engine = Engine(loop)
    engine.run()
    return list(frames(engine.topics()))


def stage_by_stage(loop, observe, cycles=None):
    """The five stages frame by frame, each called as its node calls it: plain Python."""
    for topic, frame in Run(loop).frames(cycles):
        observe(topic, frame)


def tracking_errors(topics):
    """Errors e = q^N - q of every coordinate that is tracked; NaN where it is not its turn."""
    estimate, desired = topics["state_estimate"], topics["desired"]
    return {
        name: desired.column("positions", name) - estimate.column("positions", name)
        for name in desired.names
    }


def settled_rms(topics, settle_time):
    """Root mean square of each tracking error from ``settle_time`` [s] on."""
    late = topics["desired"].time >= settle_time - 1e-9
    return {
        name: float(np.sqrt(np.nanmean(error[late] ** 2)))
        for name, error in tracking_errors(topics).items()
    }


def chatter(topics, settle_time=0.0):
    """Mean size of r_k - r_{k-1} from ``settle_time`` [s] on."""
    command = topics["command"]
    r = command.vectors["accelerations"]
    steps = np.diff(r[command.time >= settle_time - 1e-9], axis=0)
    return float(np.mean(np.sqrt(np.nansum(steps**2, axis=1))))
