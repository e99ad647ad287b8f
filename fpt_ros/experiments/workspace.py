"""Whether the nominal motion asks for what the plant cannot do."""

from fpt_ros.cycle.stages import Loop
from fpt_ros.errors import BadInput
from fpt_ros.experiments.nominal import sample

SAMPLES = 400

COARSE = 0.05
"""Steps [s] at most in which an integrated motion is looked at, as far as the samples go."""


def check_workspace(loop: Loop) -> None:
    """Raise BadInput where a nominal position leaves the plant's workspace during the run."""
    plant = loop.plant.plant
    if plant.workspace is None:
        return
    limits = plant.workspace(loop.plant.coefficients)
    dt, count, step = loop.plant.dt, loop.plant.cycles, 0.0
    stride = max(1, count // SAMPLES)
    if loop.trajectory.trajectory.coarse:
        stride = min(stride, max(1, int(COARSE / dt)))
        count, step = min(count, stride * SAMPLES), stride * dt
    cycles = list(range(0, count, stride))
    motions = sample(loop.trajectory, [cycle * dt for cycle in cycles], step)
    for cycle, (positions, _, _) in zip(cycles, motions, strict=True):
        for name, position in zip(loop.trajectory.controlled, positions, strict=True):
            at = plant.coordinates.index(name)
            low, high = limits[at]
            if not low < position < high:
                unit = f" {plant.units[at]}" if plant.units[at] else ""
                raise BadInput(
                    f"trajectory_generator.amplitude: the nominal {name} is {position:.4g}{unit} "
                    f"at t = {cycle * loop.plant.dt:g} s (cycle {cycle}), out of the workspace "
                    f"({low:.4g}, {high:.4g}){unit}: lower the amplitude"
                )
