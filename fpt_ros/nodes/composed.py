"""All five stages in one process, on one wait set: for when latency counts more than isolation."""

from fpt_ros.cycle.denoiser import Denoiser
from fpt_ros.cycle.parameter_tuner import ParameterTuner
from fpt_ros.nodes.fpt_deformer import DeformerNode
from fpt_ros.nodes.plant_node import PlantNode
from fpt_ros.nodes.process import run_process
from fpt_ros.nodes.stage_node import StageNode
from fpt_ros.nodes.trajectory_generator import TrajectoryNode


def main() -> None:
    """Run all nodes until the plant has finished."""
    factories = [
        lambda: DeformerNode(reports=False),
        lambda: StageNode(ParameterTuner, reports=False),
        lambda: TrajectoryNode(reports=False),
        lambda: StageNode(Denoiser, reports=False),
        PlantNode,
    ]
    run_process(factories, "composed", __doc__ or "")


if __name__ == "__main__":
    main()
