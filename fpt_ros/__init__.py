"""Adaptive control by Fixed Point Transformations as a ROS 2 node graph."""

__version__: str
"""Version of the installed package, as package.xml says it."""


def __getattr__(name: str) -> str:
    if name != "__version__":
        raise AttributeError(f"module 'fpt_ros' has no attribute '{name}'")
    from importlib.metadata import version  # 20 ms that only who asks for it shall wait

    return version("fpt_ros")
