"""Starting the graph as processes, watching it, and ending it: what ``fpt run`` does.

The nodes and the recorder are processes of their own, each in its own session, so that a Ctrl-C in
the terminal reaches only this one, which then ends the loop first and the recorder last. Whatever
happens, the recording is closed, and no process is left. One that was killed is started again.
"""

import asyncio
import math
import os
import signal
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path

from fpt_ros.cycle.fpt_deformer import FptDeformer
from fpt_ros.cycle.parameter_tuner import ParameterTuner
from fpt_ros.cycle.plant_simulator import PlantSimulator
from fpt_ros.cycle.stages import STAGES
from fpt_ros.errors import FptError, Interrupted, RunFailed
from fpt_ros.experiments.description import NODE as RECORDER
from fpt_ros.experiments.experiment import Experiment
from fpt_ros.nodes import cores, doctor, run_folder
from fpt_ros.nodes.child import Child, end
from fpt_ros.nodes.nursery import Nursery
from fpt_ros.nodes.part import Part
from fpt_ros.nodes.restarts import Restarts
from fpt_ros.nodes.robot import Robot

STALL = 60.0
"""Seconds without a new cycle after which the graph is given up."""

RECORDER_GRACE = 10.0
"""Seconds that the recorder has to finish its file, before it is killed."""


def run(
    nursery: Nursery,
    experiment: Experiment,
    record: Path | None,
    composed: bool = False,
    realtime: bool = False,
    namespace: str = "",
    progress: Callable[[int], None] | None = None,
    robot: Robot | None = None,
    restarts: Restarts | None = None,
    tell: Callable[[str], None] = lambda line: None,
    part: Part | None = None,
) -> None:
    """Run an experiment as processes over DDS.

    Args:
        nursery: where the processes come from.
        experiment: what to run.
        record: directory of the recording, must not exist; None: no recorder is started.
        composed: the five stages in one process.
        realtime: on the wall clock instead of in lockstep.
        namespace: ROS namespace of all nodes.
        progress: is told how many cycles are done.
        robot: in the place of the plant's node; what it does follows the wall clock.
        restarts: counts them, and says how many there may be.
        tell: is told of each restart.
        part: the nodes of this host, where others run the rest.

    Raises:
        BadInput: a node refused its parameters, or this machine has no DDS to offer.
        RunFailed: a node failed or died; the recording is closed and says why.
        Interrupted: Ctrl-C.
    """
    doctor.check_fit()
    realtime = realtime or robot is not None
    experiment = experiment.for_graph(realtime)
    if robot is not None:
        experiment = robot.experiment(experiment)
    recorded = record is not None
    if part is None or recorded:  # else the recorder may be on another host
        experiment = experiment.with_values(PlantSimulator.name, await_recorder=recorded)
    if part is not None:
        experiment = part.experiment(experiment)
    if record is not None:
        cycles, directory = experiment.loop().plant.cycles, str(record.absolute())
        cycles = cycles if robot is None else 0
        experiment = experiment.with_values(RECORDER, directory=directory, cycles=cycles)
    with run_folder.made() as folder, ExitStack() as held:
        if part is None:
            held.enter_context(run_folder.claimed(folder, namespace))
        parameters = folder / "parameters.yaml"
        experiment.write(parameters)
        arguments = ["--ros-args", "--params-file", str(parameters)]
        if robot is not None:
            arguments += robot.remappings()
        if namespace:
            arguments += ["-r", f"__ns:=/{namespace.strip('/')}"]
        core = None if composed or realtime else cores.idlest()
        graph = _Graph(nursery, folder, arguments, composed, recorded, core, progress, robot, part)
        graph.restarts, graph.tell = restarts or Restarts(), tell
        asyncio.run(graph.run())


class _Graph:
    """One run of the processes."""

    def __init__(
        self,
        nursery: Nursery,
        folder: Path,
        arguments: list[str],
        composed: bool,
        recorded: bool,
        core: int | None,
        progress: Callable[[int], None] | None,
        robot: Robot | None,
        part: Part | None,
    ) -> None:
        self.restarts = Restarts()
        self.tell: Callable[[str], None] = lambda line: None
        self._nursery, self._folder = nursery, folder
        self._descriptors: dict[str, dict[str, int]] = {}
        self._arguments = arguments
        self._robot = robot
        self._part = part
        self._recorded = recorded
        self._core = core
        self._loop_names = ["composed"] if composed else list(reversed(STAGES))
        self._plant = "composed" if composed else PlantSimulator.name
        if robot is not None:
            self._loop_names.remove(PlantSimulator.name)
            self._plant = FptDeformer.name
        if part is not None:
            self._loop_names = [name for name in self._loop_names if name in part.names]
            self._plant = self._loop_names[-1] if self._loop_names else RECORDER
        self._progress = progress
        self._children: dict[str, Child] = {}
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
        self._nursery.listen()
        failure: FptError | None = None
        try:
            self._descriptors[self._plant] = {"FPT_PROGRESS_FD": progress_out}
            self._descriptors[RECORDER] = {"FPT_REASON_FD": reason_in}
            failure = await self._watch()
        finally:
            loop.remove_reader(progress_in)
            recorder = self._children.pop(RECORDER, None)
            await end(list(self._children.values()))
            if failure is not None:
                os.write(reason_out, str(failure).encode()[:4000])
            if recorder is not None:
                await end([recorder], RECORDER_GRACE)
                if failure is None and (recorder.status or 0) < 0:
                    recorder = await self._closed_by_another(recorder)
            self._nursery.ignore()
            for descriptor in (progress_in, progress_out, reason_in, reason_out):
                os.close(descriptor)
        if failure is not None:
            raise failure
        if recorder is not None and recorder.status:
            raise recorder.failure()

    async def _watch(self) -> FptError | None:
        """Until the plant has finished (None), or something has gone wrong."""
        for name in [*([RECORDER] if self._recorded else []), *self._loop_names]:
            await self._start(name)
        interrupted = asyncio.create_task(self._stop.wait())
        clock = asyncio.get_running_loop()
        self._moved = clock.time()
        try:
            while True:
                ends = [child.end for child in self._children.values()]
                done, _ = await asyncio.wait(
                    {*ends, interrupted}, timeout=1.0, return_when=asyncio.FIRST_COMPLETED
                )
                if interrupted in done:
                    return Interrupted("interrupted; the recording is closed")
                ended = [child for child in self._children.values() if child.end in done]
                for child in ended:
                    if child.status and child.status > 0:
                        return child.failure()
                over = [each for each in ended if each.name == self._plant or self._part]
                if any(not child.status for child in over):
                    return None
                for child in ended:
                    if not child.status:
                        return RunFailed(f"the node {child.name} ended before the run did")
                    if not self.restarts.allow(child.name, clock.time()):
                        return child.failure()
                    self.tell(f"{child.how()}: started again")
                    await self._start(child.name)
                    self._moved = clock.time()
                if self._robot is not None and self._cycle:
                    self._began = self._began or clock.time()
                    if clock.time() - self._began >= (self._robot.lasts or math.inf):
                        return None
                if self._part is not None and not self._cycle:
                    self._moved = clock.time()  # the other hosts may begin later
                if clock.time() - self._moved > STALL:
                    return RunFailed(
                        f"no cycle was completed for {STALL:g} s: is DDS working between the "
                        "processes of this machine (firewall, ROS_DOMAIN_ID)?"
                    )
        finally:
            interrupted.cancel()

    async def _closed_by_another(self, recorder: Child) -> Child:
        """A recorder that was killed when all was recorded: the next one finishes the file."""
        if self.restarts.allow(RECORDER, asyncio.get_running_loop().time()):
            self.tell(f"{recorder.how()}: started again")
            await self._start(RECORDER)
            recorder = self._children.pop(RECORDER)
            await end([recorder], RECORDER_GRACE)
        return recorder

    async def _start(self, name: str) -> None:
        descriptors = self._descriptors.get(name, {})
        self._children[name] = await self._nursery.start(
            name, self._arguments, descriptors, self._folder, self._cycle
        )

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
            core = self._core
            for child in self._children.values():
                if core is not None and child.spread and cycle > child.began + 1:  # has started
                    child.spread = False
                    if child.name not in (ParameterTuner.name, RECORDER):
                        cores.keep_on(core, child.process)
            if cycle != self._cycle:
                self._cycle, self._moved = cycle, asyncio.get_running_loop().time()
            if self._progress is not None:
                self._progress(cycle)
