"""Recordings: rosbag2 directories with MCAP files, written and read without ROS."""
