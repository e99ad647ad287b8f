#!/usr/bin/env python3
"""A robot that fpt_ros knows nothing of: an ordinary rclpy node with an arm of two links and more.

It publishes /joint_states as a joint_state_broadcaster does (five joints, in an order of its own),
takes efforts as a ros2_control effort controller does (std_msgs/Float64MultiArray), and lives in
wall time: where no command comes, the last one acts. On a busy machine its time can go slower, as a
simulator's does (``--speed``). ``--help`` shows what can be made worse.
"""

import argparse
import math
import random
import sys
import time
from contextlib import suppress

import rclpy
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray

JOINTS = ("left_wheel", "elbow", "gripper", "shoulder", "right_wheel")
EFFORTS = ("shoulder", "elbow")
"""The joints of an effort command, in its order."""

LENGTH, CENTRES, MASSES, INERTIAS = 0.5, (0.25, 0.2), (2.0, 1.5), (0.042, 0.02)
ARMATURE, FRICTION, GRAVITY = 0.02, 0.3, 9.81
STEP = 2.5e-4
"""Longest step of the simulation [s]."""


def accelerations(q, v, effort):
    """Two links that hang in a vertical plane, with viscous friction."""
    (l1, l2), (m1, m2), (i1, i2) = CENTRES, MASSES, INERTIAS
    sin2, cos2 = math.sin(q[1]), math.cos(q[1])
    m22 = i2 + m2 * l2 * l2 + ARMATURE
    m12 = i2 + m2 * (l2 * l2 + LENGTH * l2 * cos2)
    m11 = (
        i1 + m1 * l1 * l1 + i2 + ARMATURE
        + m2 * (LENGTH * LENGTH + l2 * l2 + 2.0 * LENGTH * l2 * cos2)
    )  # fmt: skip
    c = m2 * LENGTH * l2 * sin2
    g2 = m2 * GRAVITY * l2 * math.sin(q[0] + q[1])
    g1 = (m1 * l1 + m2 * LENGTH) * GRAVITY * math.sin(q[0]) + g2
    b1 = effort[0] - FRICTION * v[0] + c * v[1] * (2.0 * v[0] + v[1]) - g1
    b2 = effort[1] - FRICTION * v[1] - c * v[0] * v[0] - g2
    determinant = m11 * m22 - m12 * m12
    return (m22 * b1 - m12 * b2) / determinant, (m11 * b2 - m12 * b1) / determinant


class Robot(Node):
    """The arm, its clock, and what it tells."""

    def __init__(self, options):
        super().__init__("robot")
        self.options, self.random = options, random.Random(options.seed)
        self.q, self.v, self.effort = [0.0, 0.0], [0.0, 0.0], [0.0, 0.0]
        self.commands = self.published = 0
        self.began, self.origin = self.get_clock().now(), time.monotonic()
        self.moved_until = 0.0
        kind = ReliabilityPolicy.BEST_EFFORT if options.best_effort else ReliabilityPolicy.RELIABLE
        qos = QoSProfile(depth=10, reliability=kind)
        self.states = self.create_publisher(JointState, "joint_states", qos)
        self.create_subscription(Float64MultiArray, "effort_command", self.on_effort, 10)

    def now(self):
        """The robot's own time [s], from its beginning."""
        return self.options.speed * (time.monotonic() - self.origin)

    def on_effort(self, message):
        """The effort acts from now on."""
        self.move()
        self.effort = list(message.data)
        self.commands += 1

    def move(self):
        """Up to the present, which is what the state is stamped with: the computing takes time."""
        now = self.now()
        steps = max(1, math.ceil((now - self.moved_until) / STEP))
        h = (now - self.moved_until) / steps
        for _ in range(steps):
            a = accelerations(self.q, self.v, self.effort)
            for i in range(2):
                self.v[i] += h * a[i]
                self.q[i] += h * self.v[i]
        self.moved_until = now

    def tell(self):
        """Publish the state, or lose it."""
        self.move()
        if self.random.random() < self.options.lost:
            return
        position = dict(zip(EFFORTS, self.q, strict=True))
        velocity = dict(zip(EFFORTS, self.v, strict=True))
        effort = dict(zip(EFFORTS, self.effort, strict=True))
        message = JointState(name=JOINTS)
        if self.options.stamps:
            stamp = self.began + Duration(nanoseconds=round(1e9 * self.moved_until))
            message.header.stamp = stamp.to_msg()
        message.position = [position.get(name, 0.0) for name in JOINTS]
        if self.options.velocity:
            message.velocity = [velocity.get(name, 0.0) for name in JOINTS]
        if self.options.tell_effort:
            message.effort = [effort.get(name, 0.0) for name in JOINTS]
        if rclpy.ok():
            self.states.publish(message)
            self.published += 1

    def run(self):
        """Until the process is told to end, or time is over.

        States that it is too late for are left out, and it listens before each one: who only
        catches up with what is due hears no command meanwhile.
        """
        period, options = 1.0 / self.options.rate, self.options
        due = self.now()
        while rclpy.ok() and self.now() < options.duration:
            due = max(due + period, self.now())
            late = due + options.jitter * period * self.random.uniform(-0.5, 0.5)
            while (left := late - self.now()) > 0.0:
                rclpy.spin_once(self, timeout_sec=left / options.speed)
            rclpy.spin_once(self, timeout_sec=0.0)
            self.tell()


def main():
    """Parse the options and run."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rate", type=float, default=500.0, help="of joint_states [1/s]")
    parser.add_argument("--duration", type=float, default=math.inf, help="[s]")
    parser.add_argument("--speed", type=float, default=1.0, help="of its time: 0.2 is a fifth")
    parser.add_argument("--jitter", type=float, default=0.0, help="of the period, as a part of it")
    parser.add_argument("--lost", type=float, default=0.0, help="part of the messages that is lost")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--best-effort", action="store_true", help="as sensors often publish")
    parser.add_argument("--no-velocity", dest="velocity", action="store_false")
    parser.add_argument("--no-effort", dest="tell_effort", action="store_false")
    parser.add_argument("--zero-stamps", dest="stamps", action="store_false")
    arguments = rclpy.utilities.remove_ros_args(sys.argv)[1:]
    options = parser.parse_args(arguments)
    if not 0.0 < options.speed < math.inf:
        parser.error(f"--speed {options.speed:g}: it is above 0; 1 is that of the wall clock")
    rclpy.init()
    robot = Robot(options)
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        robot.run()
    print(f"{robot.published} states told, {robot.commands} efforts came, at {robot.q}")


if __name__ == "__main__":
    main()
