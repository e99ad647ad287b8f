"""Console script ``denoiser``."""

from fpt_ros.cycle.denoiser import Denoiser
from fpt_ros.nodes.stage_node import run_stage


def main() -> None:
    """Run the node until it is told to stop."""
    run_stage(Denoiser)


if __name__ == "__main__":
    main()
