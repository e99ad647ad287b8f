"""Thin ROS 2 shells around the stages: parameters, topics, waiting, processes."""
