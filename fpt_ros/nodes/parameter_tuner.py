"""Console script ``parameter_tuner``."""

from fpt_ros.cycle.parameter_tuner import ParameterTuner
from fpt_ros.nodes.stage_node import run_stage


def main() -> None:
    """Run the node until it is told to stop."""
    run_stage(ParameterTuner)


if __name__ == "__main__":
    main()
