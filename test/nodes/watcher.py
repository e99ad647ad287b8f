"""A real ROS node in the test process, to wait for events of a running graph and to talk to it."""

from contextlib import contextmanager

import pytest
import rclpy
from builtin_interfaces.msg import Time
from command import end_started
from rcl_interfaces.srv import GetParameters, SetParameters
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from trajectory_msgs.msg import JointTrajectory

from fpt_ros.nodes import middleware
from fpt_ros.nodes.qos import loop_qos

PATIENCE = 60.0


class Watcher:
    def __init__(self, context):
        self.node = rclpy.create_node("watcher", context=context)
        self.executor = SingleThreadedExecutor(context=context)
        self.executor.add_node(self.node)

    def wait_for_stamp(self, seconds, namespace=""):
        """Until a command of this cycle or a later one has been seen."""
        seen = rclpy.task.Future(executor=self.executor)

        def on_command(message):
            stamp = message.header.stamp
            if stamp.sec + 1e-9 * stamp.nanosec >= seconds and not seen.done():
                seen.set_result(True)

        subscription = self.node.create_subscription(
            JointTrajectory, f"{namespace}/command", on_command, loop_qos(1)
        )
        self.executor.spin_until_future_complete(seen, timeout_sec=PATIENCE)
        self.node.destroy_subscription(subscription)
        assert seen.done(), f"the graph did not get there: {self.sees()}"

    @contextmanager
    def acknowledgements(self):
        """Stamps [s] up to which the recorder says that it has recorded, as they come."""
        stamps, first = [], rclpy.task.Future(executor=self.executor)

        def on_time(time):
            stamps.append(time.sec + 1e-9 * time.nanosec)
            if not first.done():
                first.set_result(True)

        subscription = self.node.create_subscription(Time, "/recorded_until", on_time, loop_qos())
        self.executor.spin_until_future_complete(first, timeout_sec=PATIENCE)
        yield stamps
        while True:  # those that have come and wait
            before = len(stamps)
            self.executor.spin_once(timeout_sec=0.1)
            if len(stamps) == before:
                break
        self.node.destroy_subscription(subscription)

    def wait_for_next(self):
        """Until a cycle has been completed that began after this call."""
        first = rclpy.task.Future(executor=self.executor)
        stamps = []

        def on_command(message):
            stamps.append((message.header.stamp.sec, message.header.stamp.nanosec))
            if len(set(stamps)) > 2 and not first.done():
                first.set_result(True)

        subscription = self.node.create_subscription(
            JointTrajectory, "/command", on_command, loop_qos(1)
        )
        self.executor.spin_until_future_complete(first, timeout_sec=PATIENCE)
        self.node.destroy_subscription(subscription)
        assert first.done(), f"the graph stands still: {self.sees()}"

    def sees(self):
        """For what to say where it has waited in vain; it ends what the test has started."""
        names, topics = self.node.get_node_names(), self.node.get_topic_names_and_types()
        return f"nodes {names}, topics {[name for name, _ in topics]}; {end_started()}"

    def stamp_after(self, seconds):
        """The stamp [ns] of the first command that is so much younger than one seen now."""
        stamps = []
        subscription = self.node.create_subscription(
            JointTrajectory,
            "/command",
            lambda m: stamps.append(m.header.stamp.sec * 10**9 + m.header.stamp.nanosec),
            loop_qos(),
        )
        while not stamps or max(stamps) - min(stamps) < seconds * 1e9:
            self.executor.spin_once(timeout_sec=PATIENCE)
        self.node.destroy_subscription(subscription)
        return max(stamps)

    def stands_still(self):
        """The stamp [ns] at which a paused graph stands: no other comes for half a second."""
        stamps = []
        subscription = self.node.create_subscription(
            JointTrajectory,
            "/command",
            lambda m: stamps.append(m.header.stamp.sec * 10**9 + m.header.stamp.nanosec),
            loop_qos(1),
        )
        seen, quiet = -1, 0
        while quiet < 5:
            self.executor.spin_once(timeout_sec=0.1)
            quiet = quiet + 1 if stamps and stamps[-1] == seen else 0
            seen = stamps[-1] if stamps else -1
        self.node.destroy_subscription(subscription)
        return seen

    def call(self, kind, name, request):
        client = self.node.create_client(kind, name)
        assert client.wait_for_service(timeout_sec=PATIENCE), name
        future = client.call_async(request)
        self.executor.spin_until_future_complete(future, timeout_sec=PATIENCE)
        assert future.done(), name
        return future.result()

    def set_parameter(self, node, name, value):
        """Result of setting one parameter: (successful, reason)."""
        parameter = rclpy.parameter.Parameter(name, value=value).to_parameter_msg()
        request = SetParameters.Request(parameters=[parameter])
        (result,) = self.call(SetParameters, f"/{node}/set_parameters", request).results
        return result.successful, result.reason

    def get_parameter(self, node, name):
        request = GetParameters.Request(names=[name])
        (value,) = self.call(GetParameters, f"/{node}/get_parameters", request).values
        return rclpy.parameter.parameter_value_to_python(value)


@contextmanager
def watcher():
    context = Context()
    with pytest.MonkeyPatch.context() as found_quickly:  # others may take 3 s to be found
        found_quickly.setenv(middleware.PROFILES, str(middleware.NETWORK))  # read once a process
        rclpy.init(context=context)
        watching = Watcher(context)
    try:
        yield watching
    finally:
        watching.executor.shutdown()
        watching.node.destroy_node()
        context.try_shutdown()
