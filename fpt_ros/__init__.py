"""Adaptive control by Fixed Point Transformations as a ROS 2 node graph."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from fpt_ros.bags.tables import load

__version__: str
"""Version of the installed package, as package.xml says it."""

__all__ = ["__version__", "load"]


def __getattr__(name: str) -> Any:
    """What takes its time is imported when it is asked for."""
    if name == "__version__":
        from importlib.metadata import version

        return version("fpt_ros")
    if name == "load":
        from fpt_ros.bags.tables import load

        return load
    raise AttributeError(f"module 'fpt_ros' has no attribute '{name}'")
