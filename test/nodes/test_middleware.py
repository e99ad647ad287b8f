"""The profiles for Fast DDS: they are understood, and the user's own counts more."""

import os
import subprocess
import sys
from xml.etree import ElementTree

import pytest

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
print(open("/proc/self/maps").read())
node.destroy_node()
rclpy.shutdown()
"""

SHARED_MEMORY = "/dev/shm/fastrtps"


def output_of_a_participant(**environment):
    done = subprocess.run(
        [sys.executable, "-c", PARTICIPANT],
        env={**os.environ, **environment},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=60,
        check=True,
    )
    assert "up" in done.stdout
    return done.stdout


@pytest.mark.parametrize("chosen", ["LOCALHOST", "SUBNET", "SYSTEM_DEFAULT", "OFF"])
def test_this_version_of_fast_dds_understands_the_profile_and_takes_no_shared_memory(chosen):
    output = output_of_a_participant(**{middleware.RANGE: chosen})
    assert "XMLPARSER" not in output
    assert SHARED_MEMORY not in output


def test_the_users_own_transport_counts():
    assert SHARED_MEMORY in output_of_a_participant(**{middleware.TRANSPORTS: "DEFAULT"})


def test_static_peers_are_left_to_ros():
    """It alone reads them, and makes its own transports for its range LOCALHOST."""
    chosen = {middleware.RANGE: "LOCALHOST", "ROS_STATIC_PEERS": "127.0.0.1"}
    middleware.configure(chosen)
    assert chosen[middleware.RANGE] == "LOCALHOST"
    assert chosen[middleware.PROFILES] == str(middleware.NETWORK)


def test_it_would_be_seen_if_it_did_not_and_the_users_own_counts(tmp_path):
    wrong = tmp_path / "wrong.xml"
    wrong.write_text(middleware.NETWORK.read_text().replace("heartbeatPeriod", "heartbeat"))
    output = output_of_a_participant(**{middleware.PROFILES: str(wrong)})
    assert "XMLPARSER" in output
    assert str(wrong) in output


def test_both_profiles_say_the_same_of_writers_and_announcements():
    both = [ElementTree.parse(path) for path in (middleware.NETWORK, middleware.LOCALHOST)]
    for name in ("data_writer", "discovery_config"):
        one, other = (tree.find(f".//{{*}}{name}") for tree in both)
        assert ElementTree.canonicalize(ElementTree.tostring(one), strip_text=True) == (
            ElementTree.canonicalize(ElementTree.tostring(other), strip_text=True)
        )
