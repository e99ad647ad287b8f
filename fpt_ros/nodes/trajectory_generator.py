"""Console script ``trajectory_generator``."""

from fpt_ros.cycle.trajectory_generator import TrajectoryGenerator
from fpt_ros.nodes.stage_node import run_stage


def main() -> None:
    """Run the node until it is told to stop."""
    run_stage(TrajectoryGenerator)


if __name__ == "__main__":
    main()
