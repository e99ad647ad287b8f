"""The in-process engine: the control cycle over a whole run, compiled, without ROS."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, cast

import numpy as np

from fpt_ros.cycle import loop as cycle
from fpt_ros.cycle.loop import CycleConstants, CycleMemory, CycleWork
from fpt_ros.cycle.records import Buffer
from fpt_ros.cycle.rows import CommandRow
from fpt_ros.cycle.run import NO_CHANGES, Changes, Run
from fpt_ros.cycle.stages import Loop
from fpt_ros.cycle.tuning import TunerConstants, TunerMemory, TunerWork
from fpt_ros.engine import compiled, switches
from fpt_ros.engine.buffers import Buffers
from fpt_ros.engine.in_python import in_python
from fpt_ros.engine.relay import Relay
from fpt_ros.engine.types import Array, as_arrays, empty
from fpt_ros.errors import Diverged, RunFailed
from fpt_ros.messages.frames import SECOND, Command, StateEstimate
from fpt_ros.notices import notice
from fpt_ros.runs.chunks import CHUNK, Consumer
from fpt_ros.runs.run import Series

LONG = 500_000
"""Cycles from which a specialised loop is worth the seconds that it takes, once."""

MANY = 10_000_000
"""The same for the cycles of many runs together: a sweep of an instant should stay one."""

SLOWER = "about 100 times slower"
"""As measured with TORA."""


class Engine:
    """One run of an experiment's loop.

    Example::

        engine = Engine(experiment.load("tora").loop())
        engine.run()
        command = engine.topics()["command"]

    Attributes:
        done: number of cycles that are done, their messages given to the consumers.
    """

    def __init__(
        self,
        loop: Loop,
        compile_laws: bool = True,
        consumers: Sequence[Consumer] | None = None,
        changes: Changes = NO_CHANGES,
        runs: int = 1,
    ) -> None:
        """Prepare fresh stages for a run.

        Args:
            loop: of an experiment; its stages' states are advanced by the run.
            compile_laws: whether the loop runs as machine code, or as the Python that it is.
            consumers: of the messages, chunk by chunk; by default all of them are kept for
                :meth:`topics`, which takes memory for the whole run.
            changes: of parameters in flight.
            runs: how many of this kind there are, all together.
        """
        self._loop, self._changes = loop, changes
        self.done = 0
        self._keeps = consumers is None
        beside = self.cycles >= LONG
        self._relay = Relay(list(consumers or ()), beside)
        plant, denoiser, tuner = loop.plant, loop.denoiser, loop.tuner
        denoiser.begin(plant.measure(0, 0), plant.dt)
        if tuner.active and not tuner.published:
            tuner.begin(plant.coordinates, loop.trajectory.controlled)
        if not loop.deformer.controlled:
            loop.deformer.begin(loop.trajectory.controlled)
        self._buffers = Buffers(loop, self.cycles if self._keeps else min(CHUNK, self.cycles))
        self._spare = Buffers(loop, CHUNK) if beside and not self._keeps else self._buffers
        self._states = [_view(stage.state) for stage in loop.stages()]
        self._command: list[Array] = list(np.full((2, len(plant.coordinates)), np.nan))
        self._compiles, self._many = compile_laws, runs * self.cycles >= MANY
        self._lay_out()

    def _lay_out(self) -> None:
        """The loop, and all that it works on, by the parameters that are in force."""
        loop = self._loop
        self._constants, self._work = _constants(loop), _work(loop)
        found = self._compiled() if self._compiles else None
        self._compiles = found is not None  # why not is said once
        self._run: Callable[..., int] = found or in_python(self._laws)
        if self._compiles:
            self._constants = as_arrays(self._constants, CycleConstants)
            self._work = as_arrays(self._work, CycleWork)
            self._memory = _memory(loop, self._states, self._command)
        else:
            states = [stage.state for stage in loop.stages()]
            command = [cast("memoryview[float]", vector.data) for vector in self._command]
            self._memory = _memory(loop, states, command)
        width = 2 * len(loop.plant.coordinates) if loop.plant.noisy else 0
        self._noise = np.empty((min(CHUNK, self.cycles), width))

    @property
    def _laws(self) -> compiled.Laws:
        """In the order of the loop's arguments."""
        return (
            self._loop.denoiser.filter.update,
            self._loop.trajectory.trajectory.nominal,
            self._loop.trajectory.relaxation.prescribe,
            self._loop.tuner.regressor,
            self._loop.tuner.law.update,
            self._loop.deformer.transformation.deform,
            self._loop.deformer.model.effort,
            self._loop.deformer.compensator.compensate,
            *self._loop.plant.laws,
        )

    def _compiled(self) -> Callable[..., int] | None:
        """The loop as machine code; of laws that cannot be compiled there is none, it says why."""
        special = cycle.run, self._laws, switches.read("constants", self._constants)
        try:
            if self.cycles >= LONG or self._many or compiled.is_specialised(*special):
                return compiled.specialised_loop(*special)
            return compiled.loop(cycle.run, self._laws)
        except compiled.NotCompiled as error:
            notice(f"a law cannot be compiled, {error.why}; the run is in Python, {SLOWER}")
            return None

    @property
    def cycles(self) -> int:
        """Length of the run."""
        return self._loop.plant.cycles

    def run(self, progress: Callable[[int], None] | None = None, until: int | None = None) -> None:
        """Run to the end.

        Args:
            progress: is told, every now and then, how many cycles are done; what it raises ends
                the run there.
            until: end when so many cycles are done.

        Raises:
            Diverged: the messages up to there have been given to the consumers.
        """
        total = self.cycles if until is None else min(until, self.cycles)
        stops = sorted((*self._changes, total))
        try:
            while self.done < total:
                if progress is not None:
                    progress(self.done)
                if self.done in self._changes:
                    self._change()
                else:
                    stop = next(stop for stop in stops if stop > self.done)
                    self._advance(min(self.done + CHUNK, stop))
        finally:
            self._relay.wait()
        if progress is not None:
            progress(total)

    def _advance(self, end: int) -> None:
        """Run up to a cycle; where one fails, run it again as frames, for what is wrong with it."""
        first = self.done
        before = [state.copy() for state in self._remembered()]
        reached = self._call(first, end)
        if reached == end:
            self._hand_over(first, end)
            return
        for state, kept in zip(self._remembered(), before, strict=True):
            state[:] = kept
        reached = self._call(first, reached)
        self._in_python(first, reached)
        raise RunFailed(f"cycle {reached} failed compiled, but not as Python: this is a bug")

    def _change(self) -> None:
        """A cycle in which parameters change, each where its stage acts: as frames."""
        command = self._in_python(self.done, self.done)
        for kept, new in zip(self._command, command[2:], strict=True):
            kept[:] = new
        self._lay_out()

    def _in_python(self, first: int, cycle: int) -> Command:
        """Run a cycle as frames, and give all from ``first`` on to the consumers."""
        run = Run(self._loop, cycle, self._last_command(cycle), self._changes)
        estimate: StateEstimate | None = None
        command: Command | None = None
        try:
            for topic, frame in run.frames(1):
                self._buffers.put(cycle, topic, frame)
                if isinstance(frame, StateEstimate):
                    estimate = frame
                if isinstance(frame, Command):  # all its messages are there, the plant may fail
                    command = frame
                    self._hand_over(first, cycle + 1)
        except Diverged as error:
            if self.done == first:
                self._hand_over(first, cycle)
                raise
            assert estimate is not None
            raise error.because(self._loop.deformer.trouble(estimate.positions)) from None
        assert command is not None
        return command

    def _hand_over(self, first: int, end: int) -> None:
        """Give some cycles to the consumers, and go on in rows that none of them reads."""
        self.done = end
        if end > first and not self._keeps:
            self._relay.give(partial(self._buffers.series, first, end))
            self._buffers, self._spare = self._spare, self._buffers
            self._buffers.begin(end)

    def _remembered(self) -> list[Array]:
        """All that a cycle changes and the next one needs."""
        return [*self._states, *self._command]

    def _call(self, first: int, end: int) -> int:
        noise = self._noise[: end - first]
        if self._loop.plant.noisy:
            self._loop.plant.noise.rows(first, noise)
        rows = self._buffers.rows(first, end, noise)
        with np.errstate(all="ignore"):
            return self._run(self._constants, self._memory, self._work, rows)

    def _last_command(self, cycle: int) -> Command | None:
        if cycle == 0:
            return None
        r, effort = (vector.tolist() for vector in self._command)
        stamp = (cycle - 1) * self._loop.plant.cycle_time
        return Command(stamp, self._loop.plant.coordinates, r, effort)

    def topics(self) -> dict[str, Series]:
        """All messages so far, by topic, in the order of the cycle.

        Raises:
            RunFailed: they were given to consumers instead.
        """
        if not self._keeps:
            raise RunFailed("the engine keeps no messages where it has consumers")
        return self._buffers.series(0, self.done)


def _constants(loop: Loop) -> CycleConstants:
    """The constants of all stages."""
    plant, tuner, deformer = loop.plant, loop.tuner, loop.deformer
    return CycleConstants(
        cycle_time=plant.cycle_time,
        dt=plant.cycle_time / SECOND,
        has_tuner=int(tuner.active),
        plant=plant.constants,
        denoiser=loop.denoiser.constants,
        trajectory=loop.trajectory.place(plant.coordinates),
        tuner=tuner.constants if tuner.active else empty(TunerConstants),
        deformer=deformer.tuned_by(tuner.published if tuner.active else ()),
    )


def _memory(loop: Loop, states: Sequence[Buffer], command: Sequence[Buffer]) -> CycleMemory:
    """The stages' memories on their own states."""
    records: Any = [
        stage.layout.on(state) if stage.layout is not None else empty(TunerMemory)
        for stage, state in zip(loop.stages(), states, strict=True)
    ]
    vectors: Any = command
    records.append(CommandRow(*vectors))
    return CycleMemory(*records)


def _work(loop: Loop) -> CycleWork:
    tuner = loop.tuner.work if loop.tuner.active else empty(TunerWork)
    return CycleWork(loop.plant.work, loop.denoiser.work, tuner, loop.deformer.work)


def _view(state: Any) -> Array:
    """The memory of a state as an array, without a copy; it cannot grow any more."""
    return np.frombuffer(state, dtype=np.float64) if len(state) else np.empty(0)
