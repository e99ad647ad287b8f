"""Stage 5 of the cycle: the desired response is deformed, and the model turns it into a force."""

import math

from fpt_ros.compensators import COMPENSATORS
from fpt_ros.cycle.acting import HELD, forget
from fpt_ros.cycle.approximate_model import model_of
from fpt_ros.cycle.commanding import command_cycle
from fpt_ros.cycle.deformation import DeformerConstants, DeformerMemory, DeformerWork, apply_tuning
from fpt_ros.cycle.deformer_parameters import COMPENSATOR, TRANSFORMATION, deformer_parameters
from fpt_ros.cycle.holding import hold, let_go
from fpt_ros.cycle.joints import Entrance
from fpt_ros.cycle.limits import limit_work, limits_of
from fpt_ros.cycle.records import Layout
from fpt_ros.cycle.rows import CommandRow, not_measured
from fpt_ros.cycle.stage import CYCLE_TIME, Input, Stage, indices
from fpt_ros.cycle.tuned import CONTROLLED, NOTHING, tuned_by
from fpt_ros.errors import BadInput, Diverged
from fpt_ros.laws import NOT_CONTROLLED, Vector
from fpt_ros.messages.frames import Command, Desired, JointStates, Names, StateEstimate, Tuning
from fpt_ros.messages.topics import COMMAND, DESIRED, JOINT_STATES, STATE_ESTIMATE
from fpt_ros.messages.topics import TUNING as TUNING_TOPIC
from fpt_ros.parameters import (
    Parameter,
    Values,
    flag,
    integer,
    number,
    numbers,
    word,
    words,
)
from fpt_ros.transformations import TRANSFORMATIONS


class FptDeformer(Stage):
    """Fixed point transformation and approximate model. State: :class:`DeformerMemory`."""

    name = "fpt_deformer"
    output = COMMAND
    memory: DeformerMemory
    constants: DeformerConstants
    controlled: Names = ()

    @classmethod
    def parameters(cls, given: Values) -> tuple[Parameter, ...]:
        """Those of the stage, of the transformation, of the compensator and of the model."""
        return deformer_parameters(given)

    @property
    def inputs(self) -> tuple[Input, ...]:
        """Estimate and desired response of the cycle; the measurement where it is asked which
        effort acted, or a position may have to be held; tuning where a tuner is in the loop.
        """
        asks = self.limits.remembers or self.limits.hold.holds
        measured = (Input(JOINT_STATES, optional=True),) if asks else ()
        tuning = (Input(TUNING_TOPIC),) if flag(self.values, "await_tuning") else ()
        return (Input(STATE_ESTIMATE), Input(DESIRED), *measured, *tuning)

    def _prepare(self) -> None:
        values = self.values
        self.model, self.coefficients = model_of(values)
        self.transformation = TRANSFORMATIONS[word(values, TRANSFORMATION.name)]
        self.compensator = COMPENSATORS[word(values, COMPENSATOR.name)]
        self.late, self.hold = integer(values, "sensor_delay"), integer(values, "learning_hold")
        self.delay = integer(values, "learning_delay") + self.late
        if flag(values, "synchronised") and max(self.delay, self.hold) > 1:
            raise BadInput(
                f"{self.name}: synchronised excludes learning_delay, learning_hold and sensor_delay"
            )
        if self.delay > 1 and self.hold > 1:
            raise BadInput(f"{self.name}: learning_hold excludes learning_delay and sensor_delay")
        n = len(self.model.coordinates)
        self._transformation = list(self.transformation.prepare(values))
        dt = number(values, CYCLE_TIME.name)
        if self.compensator.acts and not dt:
            raise BadInput(f"{self.name}.cycle_time is missing: a compensator has to know it")
        self._compensator = list(self.compensator.prepare(values, n, dt))
        self.limits = limits_of(values, self.model.coordinates, self.name)
        limits = self.limits.remembers
        acts = int(self.compensator.acts or limits)
        layout = Layout(
            DeformerMemory,
            cycles=1,
            deformed=(self.delay, n),
            observed=(self.delay, n),
            compensator=self.compensator.memory(self._compensator, n),
            position=n * acts,
            velocity=n * acts,
            effort=n * acts,
            sent=(HELD * limits, n),
            unlimited=n * limits,
            start=n * limits,
            engaged=limits,
            held=n * self.limits.hold.holds,
        )
        self.memory, fresh = self._remember(layout)
        if fresh:
            for turn in range(self.delay):
                for i in range(n):
                    self.memory.deformed[turn, i] = NOT_CONTROLLED
                    self.memory.observed[turn, i] = NOT_CONTROLLED
            let_go(self.memory.held)
        controlled = self.controlled or tuple(words(values, CONTROLLED.name))
        self._tuning_names: Names = ()
        self._desired = Entrance(f"{self.name}, desired", controlled, partial=True)
        self._estimated = Entrance(f"{self.name}, state_estimate", self.model.coordinates)
        self._measured = Entrance(f"{self.name}, joint_states", self.model.coordinates)
        self.entrances = {
            STATE_ESTIMATE.name: self._estimated,
            DESIRED.name: self._desired,
            JOINT_STATES.name: self._measured,
        }
        if controlled and set(controlled) <= set(self.model.controlled):
            self.begin(controlled)  # otherwise the first cycle, or the check of the fit, refuses

    def begin(self, controlled: Names) -> None:
        """Fix which coordinates are controlled, in their order.

        Raises:
            BadInput: the model cannot prescribe the response of one.
        """
        values, n, c = self.values, len(self.model.coordinates), len(controlled)
        self.check_controlled(controlled)
        self.controlled = controlled
        self.constants = DeformerConstants(
            transformation=self._transformation,
            coefficients=self.coefficients,
            weights=self.weights_of(controlled),
            gain=self._transformation[0],
            tuned=NOTHING,
            where=indices(controlled, self.model.coordinates, f"{self.name}.model"),
            initial=numbers(values, "initial_response"),
            delay=self.delay,
            late=self.late,
            hold=self.hold,
            adapts=int(self.transformation.adapts),
            adaptive_from=number(values, "adaptive_from"),
            compensator=self._compensator,
            compensates=int(self.compensator.acts),
            limits=self.limits,
        )
        r, h, f, target = ([0.0] * c for _ in range(4))
        combined, explained, wanted, zeros = ([0.0] * n for _ in range(4))
        limits = limit_work(n, c)
        self.work = DeformerWork(r, h, f, target, combined, explained, wanted, zeros, limits)

    @property
    def gain(self) -> float:
        """A as it is without a tuner."""
        return self._transformation[0] if not self.controlled else self.constants.gain

    def weights_of(self, names: Names) -> list[float]:
        """The weights of these controlled coordinates, as they are without a tuner.

        Raises:
            BadInput: another number of them is given.
        """
        for name in ("weights", "initial_response"):
            given = numbers(self.values, name)
            if given and len(given) != len(names):
                raise BadInput(
                    f"{self.name}.{name}: {len(given)} given, {len(names)} needed "
                    f"({', '.join(names)})"
                )
        return numbers(self.values, "weights") or [1.0] * len(names)

    def tuned_by(self, names: Names) -> DeformerConstants:
        """The constants, for tuning messages with these names."""
        if names != self._tuning_names:
            tuned = tuned_by(names, self.model.coefficient_names)
            self.constants = self.constants._replace(tuned=tuned)
            self._tuning_names = names
        return self.constants

    def step(
        self, estimate: StateEstimate, desired: Desired, *rest: JointStates | Tuning | None
    ) -> Command:
        """Deformed response r_k and the model's effort.

        ``rest``: the measurement where limits are remembered, and the tuner's message where it is
        in the loop.

        Raises:
            Diverged: the transformation or the model left its domain.
        """
        estimate, desired = self._estimated.take(estimate), self._desired.take(desired)
        if not self.controlled:
            self.begin(desired.names)
        measured = not_measured(self.model.coordinates)
        for each in rest:
            if isinstance(each, Tuning):
                apply_tuning(self.tuned_by(each.names), each)
            elif each is not None:
                measured = self._measured.take(each)
        stamp, model, n = estimate.stamp, self.model, len(self.model.coordinates)
        t, dt = self._advance_clock(stamp)
        out = CommandRow([0.0] * n, [0.0] * n)
        try:
            command_cycle(
                self.transformation.deform,
                model.effort,
                self.compensator.compensate,
                self.constants,
                self.memory,
                self.work,
                t,
                dt,
                estimate,
                desired,
                measured,
                out,
            )
        except (ArithmeticError, ValueError) as error:
            remedy = self.trouble(estimate.positions) or str(error)
            raise self._diverged(t, 0, "model's effort", math.nan, remedy) from error
        self._check(t, estimate.positions, desired, out)
        return Command(stamp, model.coordinates, out.accelerations, out.effort)

    def _check(self, t: float, q: Vector, desired: Desired, out: CommandRow) -> None:
        for at, wanted in zip(self.constants.where, desired.accelerations, strict=True):
            if math.isnan(wanted):
                continue  # not its turn
            if not math.isfinite(out.accelerations[at]):
                size = math.sqrt(sum([x * x for x in self.work.h]))
                remedy = (
                    f"||h|| = {size:g} with A = {self.constants.transformation[0]:g} is outside "
                    "the domain of the transformation: a smaller |fpt_deformer.A|, or guard: true"
                )
                what = "deformed response"
                raise self._diverged(t, at, what, out.accelerations[at], remedy)
        for at, value in enumerate(out.effort):
            if not math.isfinite(value):
                raise self._diverged(t, at, "model's effort", value, self.trouble(q))

    def _diverged(self, t: float, at: int, what: str, value: float, remedy: str) -> Diverged:
        cycle = int(self.memory.cycles[0]) - 1
        return Diverged(t, self.model.coordinates[at], what, value, remedy=remedy, cycle=cycle)

    def trouble(self, q: Vector) -> str:
        """What is wrong with the approximate model at q; empty: nothing that it knows of."""
        lost = [name for name, x in zip(self.coordinates, q, strict=True) if math.isnan(x)]
        if lost:
            return (
                f"the position of {', '.join(lost)} is not known, a sample was lost: "
                "denoiser.healing.kind=predict heals it"
            )
        return self.model.trouble(self.coefficients, q) if self.model.trouble is not None else ""

    def forget(self) -> None:
        """What was learned does not count any more: the next cycle begins anew."""
        forget(self.memory, len(self.model.coordinates))

    def safe_command(self, stamp: int) -> Command:
        """What is commanded where nothing is measured any more, or in a stop."""
        n = len(self.model.coordinates)
        return Command(stamp, self.model.coordinates, [math.nan] * n, self.limits.safe)

    def hold_command(self, measured: JointStates, stamp: int) -> Command:
        """What holds the position of a measurement, where nothing but that comes any more.

        ``stamp``: of the command [ns]; that of the measurement, or later where it is repeated.
        """
        limits, memory, n = self.limits, self.memory, len(self.model.coordinates)
        q, v, effort = measured.position, measured.velocity, [0.0] * n
        hold(limits.hold, limits.safe, limits.effort, memory.held, q, v, effort)
        for i in range(len(memory.effort)):
            memory.effort[i] = effort[i]
        return Command(stamp, self.model.coordinates, [math.nan] * n, effort)

    @property
    def coordinates(self) -> Names:
        """Names of the model's coordinates."""
        return self.model.coordinates

    def check_controlled(self, names: Names) -> None:
        """Raise BadInput where the model cannot prescribe the response of one of ``names``."""
        for name in names:
            if name not in self.model.controlled:
                valid = ", ".join(self.model.controlled)
                raise BadInput(
                    f"{self.name}.model: {word(self.values, 'model')} cannot prescribe the "
                    f"response of '{name}', only of {valid} (see trajectory_generator.controlled)"
                )
