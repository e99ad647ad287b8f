"""Starting the graph as processes, watching it, and ending it: what ``fpt run`` does.

The nodes and the recorder are processes of their own, each in its own session, so that a Ctrl-C in
the terminal reaches only this one, which then ends the loop first and the recorder last. Whatever
happens, the recording is closed, and no process is left.
"""

import asyncio
import ctypes
import math
import os
import signal
import sys
import tempfile
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from fpt_ros.cycle.fpt_deformer import FptDeformer
from fpt_ros.cycle.parameter_tuner import ParameterTuner
from fpt_ros.cycle.plant_simulator import PlantSimulator
from fpt_ros.cycle.stages import STAGES
from fpt_ros.errors import BadInput, FptError, Interrupted, RunFailed
from fpt_ros.experiments.description import NODE as RECORDER
from fpt_ros.experiments.experiment import Experiment
from fpt_ros.nodes import cores, shared_memory
from fpt_ros.nodes.robot import Robot

STALL = 60.0
"""Seconds without a new cycle after which the graph is given up."""

GRACE = 1.2
"""Seconds that a process has to end when asked to, before it is killed."""

RECORDER_GRACE = 10.0
"""The same of the recorder, which has to finish its file."""

LAST_LINES = 12
PR_SET_PDEATHSIG = 1


@dataclass
class _Child:
    """A process of the graph, and the last lines that it wrote."""

    name: str
    process: asyncio.subprocess.Process
    lines: deque[str] = field(default_factory=lambda: deque(maxlen=LAST_LINES))
    reader: "asyncio.Task[None] | None" = None

    async def ended(self) -> "_Child":
        await self.process.wait()
        if self.reader is not None:
            await self.reader
        return self

    def failure(self) -> FptError:
        """What to say of its end."""
        status = self.process.returncode or 0
        own = [line for line in self.lines if line.startswith(f"{self.name}: ")]
        if own and status == BadInput.exit_status:
            return BadInput(own[-1])
        if own and status == RunFailed.exit_status:
            return RunFailed(own[-1])
        how = f"was killed by {signal.Signals(-status).name}" if status < 0 else f"ended ({status})"
        last = "".join(f"\n  {line}" for line in self.lines) or " nothing"
        return RunFailed(f"the node {self.name} {how}; its last lines:{last}")


def run(
    experiment: Experiment,
    record: Path | None,
    composed: bool = False,
    realtime: bool = False,
    namespace: str = "",
    progress: Callable[[int], None] | None = None,
    robot: Robot | None = None,
) -> None:
    """Run an experiment as processes over DDS.

    Args:
        experiment: what to run.
        record: directory of the recording, must not exist; None: no recorder is started.
        composed: the five stages in one process.
        realtime: on the wall clock instead of in lockstep.
        namespace: ROS namespace of all nodes.
        progress: is told how many cycles are done.
        robot: in the place of the plant's node; what it does follows the wall clock.

    Raises:
        BadInput: a node refused its parameters.
        RunFailed: a node failed or died; the recording is closed and says why.
        Interrupted: Ctrl-C.
    """
    realtime = realtime or robot is not None
    experiment = experiment.for_graph(realtime)
    if robot is not None:
        experiment = robot.experiment(experiment)
    recorded = record is not None
    experiment = experiment.with_values(PlantSimulator.name, await_recorder=recorded)
    if record is not None:
        cycles, directory = experiment.loop().plant.cycles, str(record.absolute())
        cycles = cycles if robot is None else 0
        experiment = experiment.with_values(RECORDER, directory=directory, cycles=cycles)
    with tempfile.TemporaryDirectory(prefix="fpt_ros-") as folder:
        parameters = Path(folder) / "parameters.yaml"
        experiment.write(parameters)
        arguments = ["--ros-args", "--params-file", str(parameters)]
        if robot is not None:
            arguments += robot.remappings()
        if namespace:
            arguments += ["-r", f"__ns:=/{namespace.strip('/')}"]
        with shared_memory.left_as_found():
            core = None if composed or realtime else cores.idlest()
            asyncio.run(_Graph(arguments, composed, recorded, core, progress, robot).run())


def environment() -> Mapping[str, str]:
    """Environment of the processes.

    Unless the user has chosen otherwise, nobody on the network hears us.
    """
    defaults = {
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "PYTHONUNBUFFERED": "1",
        "RCUTILS_LOGGING_USE_STDOUT": "0",
    }
    return {**defaults, **os.environ}


def _die_with_parent() -> None:
    """In the child: SIGTERM when the parent is gone, however it went."""
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGTERM)


class _Graph:
    """One run of the processes."""

    def __init__(
        self,
        arguments: list[str],
        composed: bool,
        recorded: bool,
        core: int | None,
        progress: Callable[[int], None] | None,
        robot: Robot | None,
    ) -> None:
        self._arguments = arguments
        self._robot = robot
        self._recorded = recorded
        self._core = core
        self._loop_names = ["composed"] if composed else list(reversed(STAGES))
        self._plant = "composed" if composed else PlantSimulator.name
        if robot is not None:
            self._loop_names.remove(PlantSimulator.name)
            self._plant = FptDeformer.name
        self._progress = progress
        self._loop: list[_Child] = []
        self._recorder: _Child | None = None
        self._stop = asyncio.Event()
        self._moved = self._began = 0.0
        self._cycle = 0
        self._partial = b""

    async def run(self) -> None:
        """Start, watch, end."""
        loop = asyncio.get_running_loop()
        for number in (signal.SIGINT, signal.SIGTERM):
            loop.add_signal_handler(number, self._stop.set)
        progress_in, progress_out = os.pipe()
        reason_in, reason_out = os.pipe()
        os.set_blocking(progress_in, False)
        os.set_blocking(reason_in, False)
        loop.add_reader(progress_in, self._on_progress, progress_in)
        failure: FptError | None = None
        try:
            failure = await self._watch(progress_out, reason_in)
        finally:
            loop.remove_reader(progress_in)
            await _end(self._loop)
            if failure is not None:
                os.write(reason_out, str(failure).encode()[:4000])
            if self._recorder is not None:
                await _end([self._recorder], RECORDER_GRACE)
            for descriptor in (progress_in, progress_out, reason_in, reason_out):
                os.close(descriptor)
        if failure is not None:
            raise failure
        if self._recorder is not None and self._recorder.process.returncode:
            raise self._recorder.failure()

    async def _watch(self, progress_out: int, reason_in: int) -> FptError | None:
        """Until the plant has finished (None), or something has gone wrong."""
        if self._recorded:
            self._recorder = await self._start(RECORDER, FPT_REASON_FD=reason_in)
        for name in self._loop_names:
            if name == self._plant:
                self._loop.append(await self._start(name, FPT_PROGRESS_FD=progress_out))
            else:
                self._loop.append(await self._start(name))
        children = [*([self._recorder] if self._recorder is not None else []), *self._loop]
        ends = {asyncio.create_task(child.ended()) for child in children}
        interrupted = asyncio.create_task(self._stop.wait())
        clock = asyncio.get_running_loop()
        self._moved = clock.time()
        try:
            while True:
                done, _ = await asyncio.wait(
                    {*ends, interrupted}, timeout=1.0, return_when=asyncio.FIRST_COMPLETED
                )
                if interrupted in done:
                    return Interrupted("interrupted; the recording is closed")
                failures = [t.result() for t in ends & done if t.result().process.returncode]
                if failures:
                    return failures[0].failure()
                for child in (t.result() for t in ends & done):
                    if child.name == self._plant:
                        return None
                    return RunFailed(f"the node {child.name} ended before the run did")
                if self._robot is not None and self._cycle:
                    self._began = self._began or clock.time()
                    if clock.time() - self._began >= (self._robot.lasts or math.inf):
                        return None
                if clock.time() - self._moved > STALL:
                    return RunFailed(
                        f"no cycle was completed for {STALL:g} s: is DDS working between the "
                        "processes of this machine (firewall, ROS_DOMAIN_ID)?"
                    )
        finally:
            for task in (*ends, interrupted):
                task.cancel()

    async def _start(self, name: str, **descriptors: int) -> _Child:
        process = await asyncio.create_subprocess_exec(
            sys.executable,
            "-P",  # what lies in the current folder is not ours
            "-m",
            f"fpt_ros.nodes.{name}",
            *self._arguments,
            stdin=asyncio.subprocess.DEVNULL,
            stdout=asyncio.subprocess.PIPE,
            stderr=asyncio.subprocess.STDOUT,
            env={**environment(), **{key: str(fd) for key, fd in descriptors.items()}},
            pass_fds=tuple(descriptors.values()),
            start_new_session=True,
            preexec_fn=_die_with_parent,
        )
        child = _Child(name, process)
        child.reader = asyncio.create_task(_read_lines(child))
        return child

    def _on_progress(self, descriptor: int) -> None:
        try:
            self._partial += os.read(descriptor, 65536)
        except BlockingIOError:
            return
        *lines, self._partial = self._partial.split(b"\n")
        if lines:
            cycle = int(lines[-1])
            if cycle < 0:  # paused
                cycle, self._moved = -1 - cycle, asyncio.get_running_loop().time()
            if cycle and self._core is not None:  # all have started, which is quicker on many
                for child in self._loop:
                    if child.name == ParameterTuner.name:
                        continue  # works beside the trajectory generator
                    cores.keep_on(self._core, child.process.pid)
                self._core = None
            if cycle != self._cycle:
                self._cycle, self._moved = cycle, asyncio.get_running_loop().time()
            if self._progress is not None:
                self._progress(cycle)


async def _read_lines(child: _Child) -> None:
    assert child.process.stdout is not None
    while line := await child.process.stdout.readline():
        child.lines.append(line.decode(errors="replace").rstrip())


async def _end(children: list[_Child], grace: float = GRACE) -> None:
    """Ask processes to end, and kill those that do not."""
    running = [child for child in children if child.process.returncode is None]
    for child in running:
        child.process.terminate()
    ends = [asyncio.create_task(child.ended()) for child in running]
    if ends:
        _, late = await asyncio.wait(ends, timeout=grace)
        if late:
            for child in running:
                if child.process.returncode is None:
                    child.process.kill()
            await asyncio.wait(late)
