"""Adaptive control by Fixed Point Transformations as a ROS 2 node graph."""

__version__ = "0.1.0"
