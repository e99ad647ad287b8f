"""The control cycle as one function over rows of numbers: what the in-process engine compiles.

The order of events of the design, section 3, on the same functions that the stages call.
"""

import math
from typing import NamedTuple

from fpt_ros.compensators import Compensate
from fpt_ros.cycle.chains import Spoilt
from fpt_ros.cycle.commanding import command_cycle
from fpt_ros.cycle.deformation import (
    DeformerConstants,
    DeformerMemory,
    DeformerWork,
    apply_tuning,
)
from fpt_ros.cycle.denoiser import (
    DenoiserConstants,
    DenoiserMemory,
    DenoiserWork,
    filter_motion,
    show_first,
)
from fpt_ros.cycle.motion import (
    NONE,
    PlantConstants,
    PlantMemory,
    PlantWork,
    measure,
    move,
)
from fpt_ros.cycle.rows import (
    CommandRow,
    CommandRows,
    DesiredRow,
    DesiredRows,
    JointStatesRow,
    JointStatesRows,
    StateEstimateRow,
    StateEstimateRows,
    TuningRow,
    TuningRows,
)
from fpt_ros.cycle.trajectory_generator import (
    TrajectoryConstants,
    TrajectoryMemory,
    prescribe,
    slot,
)
from fpt_ros.cycle.tuning import (
    TunerConstants,
    TunerMemory,
    TunerWork,
    phase_of,
    tuning_cycle,
)
from fpt_ros.denoising.streaming import Update as Filter
from fpt_ros.disturbances import Force
from fpt_ros.integrators import Integrate
from fpt_ros.laws import Matrix, Switch
from fpt_ros.plants import Advance, Effort, Regressor
from fpt_ros.relaxations import Prescribe
from fpt_ros.trajectories import Nominal
from fpt_ros.transformations import Deform
from fpt_ros.tuning import Update


class CycleConstants(NamedTuple):
    """The constants of all stages; ``cycle_time`` [ns], ``dt`` the same in [s]."""

    cycle_time: int
    dt: float
    has_tuner: Switch
    plant: PlantConstants
    denoiser: DenoiserConstants
    trajectory: TrajectoryConstants
    tuner: TunerConstants
    deformer: DeformerConstants


class CycleMemory(NamedTuple):
    """The memories of all stages, and the last command."""

    plant: PlantMemory
    denoiser: DenoiserMemory
    trajectory: TrajectoryMemory
    tuner: TunerMemory
    deformer: DeformerMemory
    command: CommandRow


class CycleWork(NamedTuple):
    """The work space of the stages."""

    plant: PlantWork
    denoiser: DenoiserWork
    tuner: TunerWork
    deformer: DeformerWork


class CycleRows(NamedTuple):
    """The messages of the cycles from ``first`` up to ``last``, not included.

    ``first`` is in row 0. ``noise`` of each: 2 n numbers, or none.
    """

    first: int
    last: int
    joint_states: JointStatesRows
    state_estimate: StateEstimateRows
    desired: DesiredRows
    tuning: TuningRows
    command: CommandRows
    noise: Matrix


def run(
    filter_update: Filter,
    nominal: Nominal,
    relax: Prescribe,
    regressor: Regressor,
    update: Update,
    deform: Deform,
    effort: Effort,
    compensate: Compensate,
    spoil: Spoilt,
    force: Force,
    integrate: Integrate,
    advance: Advance,
    constants: CycleConstants,
    memory: CycleMemory,
    work: CycleWork,
    rows: CycleRows,
) -> int:
    """Run the cycles of ``rows``.

    Returns:
        ``rows.last``, or the cycle in which something was not finite or beyond its limit; the
        memories are then not those of its start.
    """
    cycle_time, where, before = constants.cycle_time, constants.deformer.where, memory.command
    for k in range(rows.first, rows.last):
        i = k - rows.first
        t = k * cycle_time / 1000000000
        measured = JointStatesRow(
            rows.joint_states.position[i],
            rows.joint_states.velocity[i],
            rows.joint_states.effort[i],
        )
        estimate = StateEstimateRow(
            rows.state_estimate.positions[i],
            rows.state_estimate.velocities[i],
            rows.state_estimate.accelerations[i],
            rows.state_estimate.deformed[i],
        )
        desired = DesiredRow(
            rows.desired.positions[i],
            rows.desired.velocities[i],
            rows.desired.accelerations[i],
            rows.desired.combined_error[i],
        )
        command = CommandRow(rows.command.accelerations[i], rows.command.effort[i])
        measure(spoil, constants.plant, memory.plant, k, rows.noise[i], measured)
        if k == 0:
            show_first(measured, estimate)
        else:
            filter_motion(
                filter_update,
                constants.denoiser,
                memory.denoiser,
                work.denoiser,
                constants.dt,
                measured,
                before,
                estimate,
            )
        elapsed = constants.dt if k > 0 else 0.0
        active = slot(constants.trajectory.slots, float(k * cycle_time))
        prescribe(
            nominal,
            relax,
            constants.trajectory,
            memory.trajectory,
            active,
            t,
            elapsed,
            estimate,
            desired,
        )
        if constants.has_tuner:
            tuning = TuningRow(rows.tuning.values[i])
            tuning_cycle(
                update,
                regressor,
                constants.tuner,
                memory.tuner,
                work.tuner,
                phase_of(k == 0, (k - 1) * cycle_time / 1000000000, constants.tuner.tune_from),
                constants.dt,
                estimate,
                desired,
                before,
                tuning,
            )
            apply_tuning(constants.deformer, tuning)
        command_cycle(
            deform,
            effort,
            compensate,
            constants.deformer,
            memory.deformer,
            work.deformer,
            t,
            elapsed,
            estimate,
            desired,
            measured,
            command,
        )
        for j in range(len(where)):
            asked = not math.isnan(desired.accelerations[j])
            if asked and not math.isfinite(command.accelerations[where[j]]):
                return k
        fault = move(
            spoil,
            force,
            integrate,
            advance,
            constants.plant,
            memory.plant,
            work.plant,
            t,
            command.effort,
        )
        if fault != NONE:
            return k
        for j in range(len(before.effort)):
            before.accelerations[j] = command.accelerations[j]
            before.effort[j] = command.effort[j]
    return rows.last
