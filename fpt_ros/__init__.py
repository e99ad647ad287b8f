"""Adaptive control by Fixed Point Transformations as a ROS 2 node graph."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from fpt_ros.bags.tables import load

__version__ = "0.1.0"
__all__ = ["__version__", "load"]


def __getattr__(name: str) -> Any:
    """``fpt_ros.load``: imported when it is asked for, as pandas takes its time."""
    if name == "load":
        from fpt_ros.bags.tables import load

        return load
    raise AttributeError(f"module 'fpt_ros' has no attribute '{name}'")
