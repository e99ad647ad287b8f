"""Recordings run again: one node on its recorded inputs, or the whole experiment; no ROS."""
