"""The plant simulator's node: it owns the clock of the loop.

Lockstep: the next cycle begins when the command of this one has come, so the outcome does not
depend on the machine's speed. Real time: the cycle ends when the wall clock says so, and the newest
command acts, or the safe effort where it is older than ``command_timeout``.
"""

import sys
from time import monotonic, time_ns
from typing import Any

from rclpy.duration import Duration

from fpt_ros.cycle.plant_simulator import PlantSimulator
from fpt_ros.errors import BadInput, RunFailed
from fpt_ros.messages.cdr import Codec, MalformedMessage
from fpt_ros.messages.frames import SECOND, Command
from fpt_ros.messages.topics import COMMAND, JOINT_STATES
from fpt_ros.nodes.process import report_progress
from fpt_ros.nodes.qos import heard_qos
from fpt_ros.nodes.recorded_until import RECORDED_UNTIL, TIME, WINDOW, decode_time
from fpt_ros.nodes.reset import Reset
from fpt_ros.nodes.run_control import RunControl
from fpt_ros.nodes.run_over import announce, announcer
from fpt_ros.nodes.stage_node import ParameterisedNode
from fpt_ros.nodes.timing import Timing

AGAIN = 0.5
"""Seconds without a command after which the measurement is published once more, in lockstep."""

PAUSED = "paused"

LAST_REPORT = Duration(seconds=2)
"""How long the last report waits for those who hear it, the recorder among them."""


class PlantNode(ParameterisedNode):
    """Plant simulator in lockstep or in real time."""

    def __init__(self) -> None:
        super().__init__(PlantSimulator)
        stage: PlantSimulator = self.stage
        self._realtime = stage.values["realtime"] is True
        self._awaits_recorder = stage.values["await_recorder"] is True
        self._decode = Codec(COMMAND).decode
        self._cycle = 0
        self._origin = 0
        self._recorded = -1
        self._stamp = -1
        self._command: Command | None = None
        self._held_back = self._over = self._clock_runs = False
        self._timing = Timing()
        self._sent_again = 0.0
        self._next_tick = 0.0
        self._control = RunControl(self, self._step_cycles, self._end_pause, self._want_reset)
        self._reset = Reset(self, self._kept)
        self._stands_still = self._laid_down = self._is_recorded = False
        self._run_over = announcer(self)
        qos = heard_qos(self._realtime)
        self.subscribe_raw(COMMAND.name, COMMAND.type, qos, self._on_command)
        if self._awaits_recorder:
            self.subscribe_raw(RECORDED_UNTIL, TIME, qos, self._on_recorded)
        if self._kept.cycles:
            self._go_on()

    @property
    def stamp(self) -> int:
        """Of the cycle under way [ns]."""
        return self._stamp

    def _goes_on_at(self) -> int:
        """Of the cycle that is under way again: its changes take effect behind the measurement."""
        return self._kept.cycles[-1].stamp if self._kept.cycles else 0

    def _go_on(self) -> None:
        """In the place of a plant that was killed: the cycle is under way again, as in a pause."""
        self._cycle = self.cycles_done - 1
        self._stamp = self._timing.timed = self._kept.cycles[-1].stamp
        self._origin = self._stamp - self._cycle * self.stage.cycle_time
        self._timing.sent()
        self._control.paused = self._kept.aside.get(PAUSED) is True
        self._reset.go_on(self._cycle)
        if self._realtime:  # until a command comes in time
            self._command = self.stage.safe_command(self._stamp - self.stage.timeout)

    def take_up(self) -> None:
        """Publish cycle 0, where a recorder is awaited as soon as it says that it has begun."""
        if self._laid_down:
            self._control.resume()
        elif self._stamp < 0 and (self._is_recorded or not self._awaits_recorder):
            self._start()  # it waits, latched, for whoever is not there yet

    def lay_down(self) -> None:
        """A pause."""
        self._laid_down = True
        self._control.pause()

    def retire(self) -> None:
        """The run ends with this cycle."""
        self.finished = self._stamp < 0
        self._control.stop()

    def _start(self) -> None:
        self._origin = time_ns() if self._realtime else 0
        self._publish_cycle()

    def _publish_cycle(self) -> None:
        self._stamp = self._origin + self._cycle * self.stage.cycle_time
        self._timing.sent()
        self.send(self.stage.measure(self._stamp, self._cycle - self._reset.first))

    def _on_command(self, data: bytes) -> bool:
        try:
            command = self.stage.admit(COMMAND, self._decode(data))
        except (MalformedMessage, BadInput) as error:
            self.ignore(str(error))
            return False
        assert isinstance(command, Command)
        if self._realtime and command.stamp != self._origin:  # that waits for discovery
            late = (self._stamp - command.stamp) // self.stage.cycle_time
            self._timing.heard(command.stamp, late)
        if self._realtime and self._cycle:
            self._start_clock()
        if command.stamp != self._stamp or command is self._command:
            return False
        before, self._command = self._command, command
        if self._realtime:
            self._start_clock()
        elif before is None or before.stamp != command.stamp:
            self._end_cycle(command)
        return True

    def _start_clock(self) -> None:
        """Real time begins, or goes on, when a cycle has gone around; the first one is recorded."""
        if self._clock_runs or self._command is None:
            return
        if self._recorded >= self._stamp or self._cycle or not self._awaits_recorder:
            self._clock_runs = True
            self._next_tick = self.deadline = monotonic() + self.stage.dt

    def on_deadline(self) -> None:
        """Real time: the cycle is over, with or without its command."""
        command = self._command
        if self._held_back or command is None:
            return
        late = self._stamp - command.stamp
        if late:
            self._timing.misses += 1
        if late >= self.stage.timeout:
            command = self.stage.safe_command(self._stamp)
        self._next_tick += self.stage.dt / float(self.stage.values["speed"])
        self.deadline = self._next_tick
        self._end_cycle(command)

    def _end_cycle(self, command: Command) -> None:
        if self._pending:
            self.apply_changes(self._stamp)
        began = self._origin + self._reset.first * self.stage.cycle_time
        self.stage.advance(command, self._stamp - began)
        self._cycle += 1
        ended = self._cycle - self._reset.first >= self.stage.cycles and not self._reset.is_wanted
        if ended or self._control.stopped:
            self._over = True
            self.deadline = None
            report_progress(self._cycle)
            if self._realtime:
                self._report_last()
            self._held_back = self._awaits_recorder and self._recorded < self._stamp
            self.finished = not self._held_back
        elif self._behind():
            self._held_back = True
        else:
            self._begin_cycle()

    def _step_cycles(self) -> int:
        """How long a step goes on; in a pause a change has not taken effect yet."""
        name = "step_cycles"
        cycles: Any = self._pending.get(name, self.stage.values[name])
        return int(cycles)

    def _begin_cycle(self) -> None:
        """The next cycle, if the run is not paused, and does not begin again."""
        if self._reset.is_wanted:
            self._reset.ask(self._cycle)
            self.deadline = None
        elif self._control.may_begin():
            self._publish_cycle()
        else:
            self._stands_still, self.deadline = True, None

    def _end_pause(self) -> None:
        """After a pause."""
        if not self._stands_still:
            return
        self._stands_still = False
        if self._realtime:
            self._next_tick = self.deadline = monotonic() + self.stage.dt
        self._begin_cycle()

    def _want_reset(self) -> str:
        """The run is to begin again; why it cannot, or nothing."""
        if self._over or self._stamp < 0:
            return "the run is over" if self._over else "the run has not begun yet"
        self._reset.is_wanted = True
        if self._stands_still:
            self._reset.ask(self._cycle)
        return ""

    def _all_acted(self) -> bool:
        """Whether no other node will act on a cycle of before; in real time an answer may lack."""
        newest = self._command.stamp if self._command is not None else -1
        return newest == self._stamp or monotonic() - self._timing.latest > AGAIN

    def _begin_again(self) -> None:
        """All others have forgotten; parameters and stamps go on."""
        self._clock_runs, self._command = False, None
        self.stage.begin_again()
        self._reset.tell(self._cycle, self._origin + self._cycle * self.stage.cycle_time)
        if not self._stands_still:
            self._begin_cycle()

    def _behind(self) -> bool:
        """Whether the recorder has to catch up first."""
        if not self._awaits_recorder or self._realtime:
            return False
        return self._recorded < self._stamp - WINDOW * self.stage.cycle_time

    def _on_recorded(self, data: bytes) -> bool:
        try:
            until = decode_time(data)
        except MalformedMessage as error:
            self.ignore(str(error))
            return False
        self._is_recorded = True
        if self._stamp < 0 and self.active:
            self._start()
        self._recorded = max(self._recorded, until)
        if self._realtime:
            self._start_clock()
        if not self._held_back:
            return True
        if self._over:
            self.finished = self._recorded >= self._stamp
        elif not self._behind():
            self._held_back = False
            self._begin_cycle()
        return True

    def housekeeping(self) -> None:
        """Progress; and a plant that comes second does not start."""
        super().housekeeping()
        report_progress(self._cycle, self._stands_still)
        if self._kept.aside.get(PAUSED, False) != self._control.paused:
            self._kept.aside[PAUSED] = self._control.paused
            self._kept.save()
        if self._reset.between and self._all_acted() and self._reset.is_done():
            self._begin_again()
        still = self._held_back or self.finished or self._stands_still or self._reset.between
        waits = self._timing.latest > 0.0 and not (self._realtime or still)
        if waits and monotonic() - max(self._timing.latest, self._sent_again) > AGAIN:
            self._sent_again = monotonic()
            self.send_again()  # a message of this cycle may have been lost
        begins = self._cycle == 0 and not self._kept.cycles
        if begins and self.count_publishers(JOINT_STATES.name) > 1:
            raise RunFailed(
                f"another node publishes {self.resolve_topic_name(JOINT_STATES.name)} in this ROS "
                "domain: use another ROS_DOMAIN_ID or --namespace"
            )

    def close(self) -> None:
        """Those of other hosts end too."""
        if self.context.ok():
            stopped = "" if self.finished else f"stopped in cycle {self._cycle}"
            announce(self._run_over, str(sys.exc_info()[1] or stopped))

    def _report_last(self) -> None:
        """Diagnostics of the last cycles, for which no second is left; this process ends next."""
        since, cycles = self._reported
        self._publish_diagnostics((self.cycles_done - cycles) / (monotonic() - since))
        self._diagnostics.wait_for_all_acked(LAST_REPORT)

    def health(self) -> tuple[str, dict[str, object]]:
        """State of the run; in real time misses, and latencies from sensor to command [ms]: of
        those since the last report, and the distribution of all (:mod:`fpt_ros.runs.latency`).
        """
        t = (self._stamp - self._origin) / SECOND
        values = {"time [s]": f"{t:.3f}", **self._timing.report(self._realtime)}
        mode = ("real time" if self._realtime else "lockstep") + ", paused" * self._stands_still
        return f"cycle {self._cycle} of {self.stage.cycles}, {mode}", values


def main() -> None:
    """Console script."""
    from fpt_ros.nodes.process import run_process

    run_process([PlantNode], PlantSimulator.name, PlantSimulator.__doc__ or "")
