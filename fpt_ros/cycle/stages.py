"""The five stages, in the order of events of a cycle."""

from dataclasses import dataclass

from fpt_ros.cycle.denoiser import Denoiser
from fpt_ros.cycle.fpt_deformer import FptDeformer
from fpt_ros.cycle.parameter_tuner import ParameterTuner
from fpt_ros.cycle.plant_simulator import PlantSimulator
from fpt_ros.cycle.stage import Stage
from fpt_ros.cycle.trajectory_generator import TrajectoryGenerator

STAGES: dict[str, type[Stage]] = {
    stage.name: stage
    for stage in (PlantSimulator, Denoiser, TrajectoryGenerator, ParameterTuner, FptDeformer)
}


@dataclass(frozen=True)
class Loop:
    """The five stages of one run, ready for cycle 0."""

    plant: PlantSimulator
    denoiser: Denoiser
    trajectory: TrajectoryGenerator
    tuner: ParameterTuner
    deformer: FptDeformer

    def stages(self) -> tuple[Stage, ...]:
        """All of them, in the order of events."""
        return self.plant, *self.answering()

    def answering(self) -> tuple[Denoiser, TrajectoryGenerator, ParameterTuner, FptDeformer]:
        """Those that answer the plant, in the order of events."""
        return self.denoiser, self.trajectory, self.tuner, self.deformer
