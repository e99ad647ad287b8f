"""The in-process engine: the control cycle over a whole run, compiled, without ROS."""

from array import array
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from fpt_ros.cycle import loop as cycles
from fpt_ros.cycle.fpt_deformer import no_deformation
from fpt_ros.cycle.tuned import NOTHING, tuned_by
from fpt_ros.engine import compiled
from fpt_ros.errors import Diverged, RunFailed
from fpt_ros.experiments.experiment import Loop
from fpt_ros.messages.frames import SECOND, Command, Frame, StateEstimate
from fpt_ros.messages.topics import (
    COMMAND,
    DESIRED,
    JOINT_STATES,
    LOOP_TOPICS,
    STATE_ESTIMATE,
    TUNING,
    Topic,
)
from fpt_ros.runs.run import Array, Series

CHUNK = 8192
"""Cycles between two looks at progress and Ctrl-C."""

LONG = 500_000
"""Cycles from which a loop with its laws built in is worth the seconds that it takes, once."""

Observer = Callable[[Topic, Frame], None]
"""Called with every frame, in the order of events."""


class Engine:
    """One run of an experiment's loop.

    Attributes:
        done: number of cycles whose messages are all there.
    """

    def __init__(self, loop: Loop, compile_laws: bool = True) -> None:
        """Prepare fresh stages for a run.

        Args:
            loop: of an experiment; its stages' states are advanced by the run.
            compile_laws: whether the loop runs as machine code, or as the Python that it is.
        """
        self._loop = loop
        self.done = 0
        plant, denoiser, trajectory = loop.plant, loop.denoiser, loop.trajectory
        tuner, deformer = loop.tuner, loop.deformer
        n = len(plant.coordinates)
        self._names = {
            JOINT_STATES: plant.coordinates,
            STATE_ESTIMATE: plant.coordinates,
            DESIRED: trajectory.controlled,
            TUNING: (),
            COMMAND: plant.coordinates,
        }
        first = plant.measure(0, 0)
        denoiser.begin(list(first.position), list(first.velocity), plant.cycle_time / SECOND)
        tuned, names = NOTHING, deformer.model.coefficient_names
        if tuner.active:
            tuner.begin(plant.coordinates, trajectory.controlled)
            self._names[TUNING] = tuner.published
            tuned = tuned_by(tuner.published, names)
        self._states = [_view(stage.state) for stage in loop.stages()]
        law, transformation = tuner.law, deformer.transformation
        functions: tuple[Callable[..., Any], ...] = (
            denoiser.filter.update,
            trajectory.trajectory.nominal,
            trajectory.relaxation.prescribe,
            tuner.regressor,
            law.update,
            transformation.deform if transformation is not None else no_deformation,
            deformer.model.effort,
            plant.plant.response,
            plant.disturbance.force,
        )
        run: Callable[..., int] = cycles.run
        self._run: Callable[..., int] = partial(run, *functions)
        if compile_laws:
            loop_with = compiled.loop_of_its_own if self.cycles >= LONG else compiled.loop
            self._run = loop_with(run, functions, cycles.FUNCTIONS, cycles.ARGUMENTS)
        where = np.array(trajectory.locate(plant.coordinates), dtype=np.int64)
        tuned_where = tuner.where if tuner.active else ()
        parts = tuner.parts() if tuner.active else (array("d"),) * 5
        motion, errors = trajectory.memory()
        body, friction, past = plant.memory()
        self._carry = np.full(2 * n, np.nan)
        c = len(trajectory.controlled)
        self._fixed = (
            plant.cycle_time,
            int(tuner.active),
            int(law.desired),
            int(law.reference),
            int(tuner.guards),
            tuned.kind,
            tuned.first,
            tuned.size,
            tuned.factor,
            int(transformation is not None),
            deformer.delay,
            deformer.hold,
            plant.hit,
            plant.plant.order,
            plant.substeps,
            int(plant.all_measured),
            int(denoiser.synchronised),
            plant.cycle_time / SECOND,
            trajectory.lam,
            tuner.tune_from,
            deformer.adaptive_from,
            deformer.gain,
            *plant.sigma,
            plant.step_time,
            plant.acceleration_limit,
            where,
            np.array(tuned_where, dtype=np.int64),
            *map(
                _vector,
                (
                    denoiser.constants,
                    trajectory.constants,
                    trajectory.slots,
                    tuner.constants,
                    deformer.constants,
                    deformer.weights_of(trajectory.controlled),
                    deformer.initial,
                    deformer.coefficients,
                    plant.coefficients,
                    plant.disturbance_constants,
                    plant.position_limit,
                    plant.noise(),
                ),
            ),
            *map(_view, denoiser.parts()),
            _view(motion),
            _view(errors),
            *map(_view, parts),
            _view(deformer.state),
            _view(body),
            _view(friction),
            _view(past),
            self._carry,
            np.zeros(tuner.rows * (len(parts[0]))),
            np.zeros(tuner.rows),
            np.zeros(6 * n + 4 * c),
        )
        self._rows = {
            topic: [np.empty((plant.cycles, len(names))) for _ in topic.vectors]
            for topic, names in self._names.items()
        }

    @property
    def cycles(self) -> int:
        """Length of the run."""
        return self._loop.plant.cycles

    def run(self, progress: Callable[[int], None] | None = None) -> None:
        """Run to the end.

        Args:
            progress: is told, every now and then, how many cycles are done; what it raises ends
                the run there.

        Raises:
            Diverged: the cycles up to there are in the arrays.
        """
        total = self._loop.plant.cycles
        while self.done < total:
            if progress is not None:
                progress(self.done)
            self._advance(min(self.done + CHUNK, total))
        if progress is not None:
            progress(total)

    def _advance(self, end: int) -> None:
        """Run up to a cycle; where one fails, run it again as frames, for what is wrong with it."""
        first = self.done
        before = [state.copy() for state in (*self._states, self._carry)]
        reached = self._call(first, end)
        if reached == end:
            self.done = end
            return
        for state, kept in zip((*self._states, self._carry), before, strict=True):
            state[:] = kept
        self.done = self._call(first, reached)
        estimate, command = shown(self._loop, reached, self._last_command())
        self.done = reached + 1  # all its messages are there: it is the plant that fails
        try:
            self._loop.plant.advance(command, command.stamp)
        except Diverged as error:
            raise error.because(self._loop.deformer.trouble(estimate.positions)) from None
        raise RunFailed(f"cycle {reached} failed compiled, but not as Python: this is a bug")

    def _call(self, first: int, end: int) -> int:
        rows = [matrix for vectors in self._rows.values() for matrix in vectors]
        with np.errstate(all="ignore"):
            return self._run(first, end, *self._fixed, *rows)

    def _last_command(self) -> Command | None:
        n = len(self._loop.plant.coordinates)
        if self.done == 0:
            return None
        stamp = (self.done - 1) * self._loop.plant.cycle_time
        r, effort = self._carry[:n].tolist(), self._carry[n : 2 * n].tolist()
        return Command(stamp, self._loop.plant.coordinates, r, effort)

    def topics(self) -> dict[str, Series]:
        """The cycles so far, by topic, in the order of the cycle."""
        return {topic.name: self._series(topic) for topic in LOOP_TOPICS if self._names[topic]}

    def _series(self, topic: Topic) -> Series:
        stamps = np.arange(self.done, dtype=np.int64) * self._loop.plant.cycle_time
        vectors = {
            name: matrix[: self.done]
            for name, matrix in zip(topic.vectors, self._rows[topic], strict=True)
        }
        names = self._names[topic]
        if topic is DESIRED and self._loop.trajectory.slots:
            absent = np.isnan(vectors["accelerations"])
            had_turns = ~absent.all(axis=0)
            names = tuple(names[i] for i in np.flatnonzero(had_turns))
            vectors = {
                name: np.where(absent, np.nan, matrix)[:, had_turns]
                for name, matrix in vectors.items()
            }
        return Series(stamps, names, vectors)

    def frames(self, first: int, observe: Observer) -> None:
        """Show the frames of the cycles from ``first`` on, in the order of events."""
        time, slots = self._loop.plant.cycle_time, bool(self._loop.trajectory.slots)
        lists = {
            topic: [matrix[first : self.done].tolist() for matrix in self._rows[topic]]
            for topic in LOOP_TOPICS
        }
        for i in range(self.done - first):
            for topic in LOOP_TOPICS:
                names = self._names[topic]
                if not names:
                    continue
                vectors = [rows[i] for rows in lists[topic]]
                if topic is DESIRED and slots:
                    at = [j for j, x in enumerate(vectors[2]) if x == x]
                    names = tuple(names[j] for j in at)
                    vectors = [[vector[j] for j in at] for vector in vectors]
                observe(topic, topic.frame((first + i) * time, names, *vectors))


def shown(loop: Loop, cycle: int, command: Command | None) -> tuple[StateEstimate, Command]:
    """Run one cycle stage by stage up to the command, which is where it may end with an error."""
    plant = loop.plant
    stamp = cycle * plant.cycle_time
    for stage in (loop.denoiser, loop.trajectory, loop.tuner, loop.deformer):
        stage.clock[0], stage.clock[1] = (0, stamp - plant.cycle_time) if cycle else (-1, -1)
    if cycle == 0:
        loop.denoiser.state = array("d")
    seen = (command,) if loop.denoiser.synchronised else ()
    estimate = loop.denoiser.step(plant.measure(stamp, cycle), *seen)
    desired = loop.trajectory.step(estimate)
    tuning = None
    if loop.tuner.active:
        wanted = (desired,) if loop.tuner.law.desired else ()
        tuning = loop.tuner.step(estimate, *wanted, command)
    return estimate, loop.deformer.step(estimate, desired, tuning)


def _vector(values: Any) -> Array:
    return np.array(values, dtype=np.float64)


def _view(state: Any) -> Array:
    """The memory of a state as an array, without a copy; it cannot grow any more."""
    return np.frombuffer(state, dtype=np.float64) if len(state) else np.empty(0)
