"""Whether the nominal motion asks for what the plant cannot do."""

from fpt_ros.cycle.stages import Loop
from fpt_ros.errors import BadInput
from fpt_ros.experiments.nominal import sample

SAMPLES = 400


def check_workspace(loop: Loop) -> None:
    """Raise BadInput where a nominal position leaves the plant's workspace during the run."""
    plant = loop.plant.plant
    if plant.workspace is None:
        return
    limits = plant.workspace(loop.plant.coefficients)
    stride = max(1, loop.plant.cycles // SAMPLES)
    cycles = list(range(0, loop.plant.cycles, stride))
    motions = sample(loop.trajectory, [cycle * loop.plant.dt for cycle in cycles])
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
