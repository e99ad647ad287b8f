"""Where rclpy's wait set is not what is known: the plain executor, the same numbers, a warning."""

import os
import subprocess
import sys

from fpt_ros.experiments.experiment import load

OTHER_RCLPY = """
import sys
from fpt_ros.nodes import composed, spin

def unknown(nodes, context):
    raise AttributeError("WaitSet")

spin._LoopWaitSet = unknown
composed.main()
"""


def test_the_loop_runs_on_the_plain_executor(tmp_path):
    experiment = load("tora", duration=0.05).for_graph(realtime=False)
    parameters = tmp_path / "parameters.yaml"
    experiment.write(parameters)
    done = subprocess.run(
        [sys.executable, "-c", OTHER_RCLPY, "--ros-args", "--params-file", str(parameters)],
        env={**os.environ, "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert "the loop runs on the plain executor" in done.stderr + done.stdout
