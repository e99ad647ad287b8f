"""The five stages, in the order of events of a cycle."""

from fpt_ros.loop.denoiser import Denoiser
from fpt_ros.loop.fpt_deformer import FptDeformer
from fpt_ros.loop.parameter_tuner import ParameterTuner
from fpt_ros.loop.plant_simulator import PlantSimulator
from fpt_ros.loop.stage import Stage
from fpt_ros.loop.trajectory_generator import TrajectoryGenerator

STAGES: dict[str, type[Stage]] = {
    stage.name: stage
    for stage in (PlantSimulator, Denoiser, TrajectoryGenerator, ParameterTuner, FptDeformer)
}
