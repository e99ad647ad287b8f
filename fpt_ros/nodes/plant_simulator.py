"""Console script ``plant_simulator``."""

from fpt_ros.nodes.plant_node import main

__all__ = ["main"]

if __name__ == "__main__":
    main()
