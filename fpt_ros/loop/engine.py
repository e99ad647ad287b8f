"""The in-process engine: the control cycle as one loop, without ROS."""

from collections.abc import Callable

from fpt_ros.loop.experiment import Loop
from fpt_ros.messages.frames import Command, Frame
from fpt_ros.messages.topics import COMMAND, DESIRED, JOINT_STATES, STATE_ESTIMATE, TUNING, Topic

Observer = Callable[[Topic, Frame], None]
"""Called with every frame, in the order of events."""


def run(loop: Loop, observe: Observer, progress: Callable[[int], None] | None = None) -> int:
    """Run a loop from cycle 0 to its end.

    Args:
        loop: fresh stages of an experiment.
        observe: is shown every frame; a recording or a :class:`~fpt_ros.loop.run.Collector`.
        progress: is told, now and then, how many cycles are done.

    Returns:
        Number of cycles.

    Raises:
        Diverged: the frames up to there have been shown.
    """
    plant, denoiser, trajectory = loop.plant, loop.denoiser, loop.trajectory
    tuner, deformer = (loop.tuner if loop.tuner.active else None), loop.deformer
    command: Command | None = None
    for cycle in range(plant.cycles):
        stamp = cycle * plant.cycle_time
        measured = plant.measure(stamp, cycle)
        observe(JOINT_STATES, measured)
        estimate = denoiser.step(measured)
        observe(STATE_ESTIMATE, estimate)
        desired = trajectory.step(estimate)
        observe(DESIRED, desired)
        tuning = None
        if tuner is not None:
            tuning = tuner.step(estimate, command)
            observe(TUNING, tuning)
        command = deformer.step(estimate, desired, tuning)
        observe(COMMAND, command)
        plant.advance(command, stamp)
        if progress is not None and cycle % 512 == 0:
            progress(cycle)
    if progress is not None:
        progress(plant.cycles)
    return plant.cycles
