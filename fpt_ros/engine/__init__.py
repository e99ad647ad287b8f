"""The in-process engine: the cycle compiled, over a whole run, without ROS."""
