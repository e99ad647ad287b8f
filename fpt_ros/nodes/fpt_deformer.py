"""Console script ``fpt_deformer``: the node that gives the commands, and may have to stop."""

from collections.abc import Mapping
from time import monotonic

from diagnostic_msgs.msg import DiagnosticStatus
from rcl_interfaces.msg import SetParametersResult
from rclpy.parameter import Parameter as RosParameter
from std_msgs.msg import Bool, Float64MultiArray
from std_srvs.srv import Trigger

from fpt_ros.cycle.fpt_deformer import FptDeformer
from fpt_ros.cycle.limits import COMMAND_TIMEOUT, STOPPED
from fpt_ros.errors import BadInput, Diverged
from fpt_ros.messages.frames import Command, Frame, JointStates
from fpt_ros.messages.topics import Topic
from fpt_ros.nodes.gain_node import GainNode
from fpt_ros.nodes.process import run_process
from fpt_ros.nodes.robot import EFFORT_COMMAND
from fpt_ros.nodes.silence import Measured
from fpt_ros.nodes.stage_node import CHANGES, StageNode
from fpt_ros.parameters import Value

E_STOP = "e_stop"
"""A topic (true: stop), and a service of the node; ``RELEASE`` is a service alone."""

RELEASE = "release"

SAFE, HOLDING = "the safe effort is commanded", "the position is held"

AGAIN = 0.02
"""Seconds after which the safe effort is commanded once more while nothing is measured."""


class DeformerNode(StageNode):
    """The deformer; on request its efforts also go to a ros2_control effort controller.

    In real time it commands the safe effort where nothing has been measured for
    ``command_timeout``. An emergency stop is the parameter ``stopped``, set by a service, a topic,
    or as any parameter: so it is recorded with its cycle.
    """

    _gain: GainNode | None = None

    def __init__(self, reports: bool = True) -> None:
        """``reports``: as of any stage's node."""
        super().__init__(FptDeformer, reports)
        self._efforts = self.create_publisher(Float64MultiArray, EFFORT_COMMAND, 1)
        self._commanded = -1
        self._measured = Measured()
        self._gain = GainNode(self, self.stage, CHANGES)
        self.warning = self._gain.warning
        self._laid_down = self._stays_stopped = False
        self.create_service(Trigger, f"~/{E_STOP}", self._on_e_stop)
        self.create_service(Trigger, f"~/{RELEASE}", self._on_release)
        self.create_subscription(Bool, E_STOP, self._on_e_stop_topic, 10)

    def consider(self, tried: FptDeformer, names: set[str]) -> None:
        """A gain that does not contract is warned of, or refused."""
        assert self._gain is not None
        self._gain.consider(tried, names)
        self.warning = self._gain.warning

    def set_parameters(self, parameter_list: list[RosParameter]) -> list[SetParametersResult]:
        """As of any node; what is to be said of a gain goes to who has set it."""
        return [self.set_parameters_atomically([each]) for each in parameter_list]

    def set_parameters_atomically(self, parameter_list: list[RosParameter]) -> SetParametersResult:
        """As of any node; rclpy leaves out the reason of what is accepted."""
        if self._gain is None:  # being set up again, with what was accepted before
            return super().set_parameters_atomically(parameter_list)
        self._gain.remark = ""
        result = super().set_parameters_atomically(parameter_list)
        if result.successful and self._gain.remark:
            result.reason = f"warning: {self._gain.remark}"
        return result

    def send(self, frame: Frame) -> None:
        """Publish the command, and the bare efforts where ``effort_command`` is set."""
        super().send(frame)
        self._commanded = frame.stamp
        if self.stage.values["effort_command"] and isinstance(frame, Command):
            self._efforts.publish(Float64MultiArray(data=list(frame.effort)))

    def _accept(self, changes: Mapping[str, Value]) -> None:
        if self._laid_down and STOPPED.name in changes:
            if not changes[STOPPED.name]:
                raise BadInput(f"{FptDeformer.name} is inactive: activate it (ros2 lifecycle set)")
            self._stays_stopped = True
        super()._accept(changes)

    def _step(self, frames: list[Frame | None]) -> None:
        has_held = self._realtime and self._matcher.acted <= self._commanded
        try:
            if not has_held:  # one command a cycle: the controller takes over in the next one
                super()._step(frames)
        except Diverged as error:
            if not self._robot:
                raise
            self.ignore(f"this cycle, the safe effort is commanded: {error}")  # a robot goes on
            self.stage.forget()
            self._command_safe_effort()  # what it computes now is not to be trusted: no hold
        if self.level != DiagnosticStatus.OK:
            self.level = DiagnosticStatus.OK
            self.get_logger().warning("measured again: the controller takes over")
        timeout = self.stage.limits.timeout
        if self._realtime and timeout > 0.0:
            self.deadline = monotonic() + timeout

    def close(self) -> None:
        """In real time the last command is the safe effort, whatever the reason of the end."""
        if self._realtime and self._matcher.acted >= 0 and self.context.ok():
            self._command_safe_effort()

    def take_up(self) -> None:
        """Active: it controls, unless an emergency stop was asked for."""
        super().take_up()
        if self._laid_down:
            self._laid_down = False
            self._stop(self._stays_stopped)

    def lay_down(self) -> None:
        """Inactive: the safe effort is commanded."""
        self._stays_stopped = self.get_parameter(STOPPED.name).value is True
        self._stop(True)
        self._laid_down = True

    def on_deadline(self) -> None:
        """The loop is silent: nothing is measured any more, or another node does not answer."""
        if self.level == DiagnosticStatus.OK:
            self.level = DiagnosticStatus.ERROR
            self.get_logger().error(
                f"nothing has been measured for {COMMAND_TIMEOUT.name} = "
                f"{self.stage.limits.timeout:g} s: the safe effort is commanded"
                if self._held_by() is None
                else f"the loop is silent for {COMMAND_TIMEOUT.name} = "
                f"{self.stage.limits.timeout:g} s: the position is held"
            )
        self._command_safety()
        self.deadline = monotonic() + AGAIN

    def heard(self, topic: Topic, frame: Frame) -> None:
        """A measurement; where the position has to be held by that alone, it is answered."""
        if isinstance(frame, JointStates) and self.stage.limits.hold.holds:
            self._measured.take(frame)
            if self.level != DiagnosticStatus.OK:
                self._command_safety()
                self.deadline = monotonic() + self.stage.limits.timeout

    def _held_by(self) -> JointStates | None:
        """The measurement that is held by; ``None``: none is young enough, or it is not wanted."""
        return self._measured.newest(self.stage.limits.timeout)

    def _command_safety(self) -> None:
        """What holds the position, where that is wanted and measured; else the safe effort."""
        measured = self._held_by()
        if measured is None:
            self._command_safe_effort()
        else:
            stamp = max(measured.stamp, self._between())  # once an answer to it, then repetitions
            self.send(self.stage.hold_command(measured, stamp))

    def _command_safe_effort(self) -> None:
        self.send(self.stage.safe_command(self._between()))

    def _between(self) -> int:
        """A stamp [ns] behind the last command, and before any measurement that may still come.

        Stamps are of the sender's clock, which may be slow, or behind: with the time that has
        passed here, what is answered next would seem older.
        """
        return max(self._matcher.acted, self._commanded) + 1

    def health(self) -> tuple[str, dict[str, object]]:
        """Whether it controls."""
        holds = self.stage.limits.hold.holds
        if self.stage.limits.stopped:
            return f"stopped: {HOLDING if holds else SAFE}", {}
        if self.level != DiagnosticStatus.OK:
            held = self._held_by() is not None
            return f"the loop is silent: {HOLDING}" if held else f"nothing is measured: {SAFE}", {}
        return super().health()

    def _stop(self, stopped: bool) -> tuple[bool, str]:
        (result,) = self.set_parameters([RosParameter(STOPPED.name, value=stopped)])
        if stopped and self._realtime and self._matcher.acted >= 0:
            self._command_safety()  # now, not at the next measurement
        what = HOLDING if self.stage.limits.hold.holds else SAFE
        done = what if stopped else "released: the next cycle begins anew"
        return bool(result.successful), done if result.successful else str(result.reason)

    def _on_e_stop(self, request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        response.success, response.message = self._stop(True)
        return response

    def _on_release(self, request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        response.success, response.message = self._stop(False)
        return response

    def _on_e_stop_topic(self, message: Bool) -> None:
        if message.data:
            self._stop(True)


def main() -> None:
    """Run the node until it is told to stop."""
    run_process([DeformerNode], FptDeformer.name, FptDeformer.__doc__ or "")


if __name__ == "__main__":
    main()
