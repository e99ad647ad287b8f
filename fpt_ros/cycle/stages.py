"""The five stages, in the order of events of a cycle."""

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
