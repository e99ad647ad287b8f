"""A moderated reader: every message, in order, for a few wake-ups."""

import subprocess
import sys

MESSAGES = 400

READER = f"""
from pathlib import Path
from time import sleep

from fpt_ros.nodes import middleware
middleware.configure()
import rclpy
from std_msgs.msg import Int32
from fpt_ros.nodes import moderation
from fpt_ros.nodes.qos import loop_qos


def wake_ups():
    found = 0
    for task in Path("/proc/self/task").iterdir():
        if (task / "comm").read_text().startswith("dds.udp"):
            words = (task / "status").read_text().split()
            found += int(words[words.index("voluntary_ctxt_switches:") + 1])
    return found


rclpy.init()
node = rclpy.create_node("reader")
subscription = node.create_subscription(Int32, "number", print, loop_qos({MESSAGES}))
# longer than the writer takes on a busy machine
moderation.FALLING_ASLEEP, moderation.ASLEEP, moderation.NAP = 0.5, 0.9, 1.5
moderated = moderation.Moderation([subscription])
while node.count_publishers("number") == 0:
    sleep(0.01)
print("there", flush=True)
before, found = wake_ups(), []
while len(found) < {MESSAGES}:
    taken = subscription.handle.take_message(Int32, False)
    if taken is not None:
        found.append(taken[0].data)
    else:
        moderated.nap()
after = wake_ups()
moderated.close()
node.destroy_node()
rclpy.shutdown()
print(found == list(range({MESSAGES})), after - before)
"""

WRITER = f"""
import sys
from time import sleep

from fpt_ros.nodes import middleware
middleware.configure()
import rclpy
from std_msgs.msg import Int32
from fpt_ros.nodes.qos import loop_qos

rclpy.init()
node = rclpy.create_node("writer")
publisher = node.create_publisher(Int32, "number", loop_qos({MESSAGES}))
sys.stdin.readline()  # until it is heard
while publisher.get_subscription_count() == 0:
    sleep(0.01)
for number in range({MESSAGES}):
    publisher.publish(Int32(data=number))
    sleep(0.0001)
publisher.wait_for_all_acked()
node.destroy_node()
rclpy.shutdown()
"""


def test_messages_and_wake_ups():
    with (
        subprocess.Popen(
            [sys.executable, "-c", WRITER], stdin=subprocess.PIPE, text=True
        ) as writer,
        subprocess.Popen(
            [sys.executable, "-c", READER], stdout=subprocess.PIPE, text=True
        ) as reader,
    ):
        try:
            assert reader.stdout is not None
            assert reader.stdout.readline() == "there\n"
            writer.communicate("go\n", timeout=60)
            in_order, wake_ups = reader.communicate(timeout=60)[0].split()
        finally:
            writer.kill()
            reader.kill()
    assert (writer.returncode, reader.returncode, in_order) == (0, 0, "True")
    assert int(wake_ups) < MESSAGES / 4  # else one a message
