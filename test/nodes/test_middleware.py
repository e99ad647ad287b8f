"""The profile for Fast DDS: it is understood, and the user's own counts more."""

import os
import subprocess
import sys

from fpt_ros.nodes import middleware

PARTICIPANT = """
from fpt_ros.nodes import middleware
middleware.configure()
import rclpy
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node("profile")
node.create_publisher(String, "words", 1)
print("up")
node.destroy_node()
rclpy.shutdown()
"""


def output_of_a_participant(**environment):
    ours = {name: x for name, x in os.environ.items() if name != middleware.VARIABLE}
    done = subprocess.run(
        [sys.executable, "-c", PARTICIPANT],
        env={**ours, **environment},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=60,
        check=True,
    )
    assert "up" in done.stdout
    return done.stdout


def test_this_version_of_fast_dds_understands_the_profile():
    assert "XMLPARSER" not in output_of_a_participant()


def test_it_would_be_seen_if_it_did_not_and_the_users_own_counts(tmp_path):
    wrong = tmp_path / "wrong.xml"
    wrong.write_text(middleware.PROFILE.read_text().replace("heartbeatPeriod", "heartbeat"))
    output = output_of_a_participant(**{middleware.VARIABLE: str(wrong)})
    assert "XMLPARSER" in output
    assert str(wrong) in output
