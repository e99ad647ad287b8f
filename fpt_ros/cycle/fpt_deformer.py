"""Stage 5 of the cycle: the desired response is deformed, and the model turns it into a force."""

import math
from collections.abc import Callable

from fpt_ros import registry
from fpt_ros.cycle.approximate_model import model_parameters
from fpt_ros.cycle.denoiser import SYNCHRONISED
from fpt_ros.cycle.stage import CYCLE_TIME, REALTIME, Input, Stage, indices
from fpt_ros.cycle.tuned import NOTHING, Tuned, tuned_by
from fpt_ros.errors import BadInput, Diverged
from fpt_ros.laws import NOT_CONTROLLED, MutableVector, Vector, helper
from fpt_ros.messages.frames import Command, Desired, Names, StateEstimate, Tuning
from fpt_ros.messages.topics import COMMAND, DESIRED, STATE_ESTIMATE
from fpt_ros.messages.topics import TUNING as TUNING_TOPIC
from fpt_ros.parameters import Parameter, Values, flag, group, integer, number, numbers, word

NONE = "none"

PARAMETERS = (
    Parameter(
        "transformation",
        "fixed point transformation, by its name; none: not adaptive",
        NONE,
        live=False,
    ),
    Parameter("adaptive_from", "time at which the deformation starts", 0.0, unit="s", minimum=0.0),
    Parameter(
        "learning_delay",
        "cycles between the deformed response and the one that it is corrected to",
        1,
        minimum=1,
        maximum=1000,
        live=False,
    ),
    Parameter(
        "learning_hold",
        "correct only once every so many cycles, and hold between",
        1,
        minimum=1,
        maximum=1000,
        live=False,
    ),
    Parameter("weights", "of the response errors, per controlled coordinate; empty: ones", []),
    Parameter(
        "initial_response",
        "deformed response of the first cycle; empty: the desired one",
        [],
        live=False,
    ),
    SYNCHRONISED,
    Parameter("await_tuning", "a tuner is in the loop: wait for it", False, live=False),
    Parameter("effort_command", "publish the efforts for a ros2_control controller", False),
    REALTIME,
    CYCLE_TIME,
)


@helper
def deform_response(
    deform: Callable[..., None],
    effort: Callable[..., None],
    adaptive: int,
    constants: Vector,
    weights: Vector,
    initial: Vector,
    coefficients: Vector,
    where: "tuple[int, ...] | list[int]",
    delay: int,
    hold: int,
    state: MutableVector,
    q: Vector,
    v: Vector,
    response: Vector,
    shown: Vector,
    desired: Vector,
    s: Vector,
    r: MutableVector,
    h: MutableVector,
    out: MutableVector,
    full_s: MutableVector,
    out_r: MutableVector,
    out_effort: MutableVector,
) -> None:
    """r_k = G(r_{k-d}, response to r_{k-d} - desired_k), and the model's effort for it.

    Over the c controlled coordinates: weights, desired, s and the work vectors r, h, out; over all
    n: the rest. A coordinate that is controlled anew gets the desired response itself.

    ``state``: the number of cycles, the last d deformed responses and the last d observed ones, n
    numbers each, in rings. ``shown`` is r as the filter shows it: where it is not NaN, the step is
    made from it instead of from r_{k-d}.
    """
    n, c = len(out_r), len(desired)
    count = int(state[0])
    state[0] = count + 1.0
    turn = count % delay if delay > 1 else 0
    past, seen = 1 + turn * n, 1 + delay * n
    now, then = seen + turn * n, seen + (turn + 1 if turn + 1 < delay else 0) * n
    for i in range(n):
        state[now + i] = response[i]
        full_s[i] = 0.0
        out_r[i] = math.nan
    held = hold > 1 and count % hold != 0
    for i in range(c):
        at, before = where[i], state[past + where[i]]
        r[i], h[i] = desired[i], 0.0
        if adaptive and not math.isnan(before) and not math.isnan(desired[i]):
            r[i] = before if math.isnan(shown[at]) else shown[at]
            if not held:
                h[i] = weights[i] * (state[then + at] - desired[i])
        if not math.isnan(desired[i]):
            full_s[at] = s[i]
    if adaptive:
        deform(constants, r, h, out)
    for i in range(c):
        at = where[i]
        if count == 0 and len(initial) > 0:
            out_r[at] = initial[i]
        elif math.isnan(desired[i]) or math.isnan(state[past + at]) or not adaptive:
            out_r[at] = desired[i]
        else:
            out_r[at] = r[i] if held else out[i]
    for i in range(n):
        state[past + i] = out_r[i]
    effort(coefficients, q, v, out_r, full_s, out_effort)


@helper
def no_deformation(constants: Vector, r: Vector, h: Vector, out: MutableVector) -> None:
    """In the place of a transformation where there is none."""
    for i in range(len(r)):
        out[i] = r[i]


class FptDeformer(Stage):
    """Fixed point transformation and approximate model. State: see :func:`deform_response`."""

    name = "fpt_deformer"
    output = COMMAND

    @classmethod
    def parameters(cls, given: Values) -> tuple[Parameter, ...]:
        """Those of the stage, of the transformation and of the model."""
        own: tuple[Parameter, ...] = ()
        kind = given.get("transformation", NONE)
        if kind != NONE:
            own = registry.transformation(str(kind)).parameters
        return (
            *PARAMETERS,
            *own,
            *model_parameters(given, live=given.get("await_tuning") is not True),
        )

    @property
    def inputs(self) -> tuple[Input, ...]:
        """Estimate and desired response of the cycle; tuning where a tuner is in the loop."""
        tuning = (Input(TUNING_TOPIC),) if flag(self.values, "await_tuning") else ()
        return (Input(STATE_ESTIMATE), Input(DESIRED), *tuning)

    def _prepare(self) -> None:
        values = self.values
        self.model = model = registry.model(word(values, "model"))
        self.coefficients = list(model.coefficients(group(values, "approximate", model.parameters)))
        kind = word(values, "transformation")
        self.transformation = registry.transformation(kind) if kind != NONE else None
        self.constants: list[float] = [0.0]
        if self.transformation is not None:
            self.constants = list(self.transformation.prepare(values))
        self.gain = self.constants[0]
        self.adaptive_from = number(values, "adaptive_from")
        self.delay, self.hold = integer(values, "learning_delay"), integer(values, "learning_hold")
        if flag(values, "synchronised") and max(self.delay, self.hold) > 1:
            raise BadInput(f"{self.name}: synchronised excludes learning_delay and learning_hold")
        if self.delay > 1 and self.hold > 1:
            raise BadInput(f"{self.name}: learning_delay and learning_hold exclude each other")
        self.initial = numbers(values, "initial_response")
        self._names: Names = ()
        self._tuned: Tuned = NOTHING
        self._tuning_names: Names = ()
        if not self.state:
            n = len(model.coordinates)
            self.state.extend([0.0] + [NOT_CONTROLLED] * (2 * self.delay * n))

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

    def step(
        self, estimate: StateEstimate, desired: Desired, tuning: Tuning | None = None
    ) -> Command:
        """Deformed response r_k and the model's effort.

        Raises:
            Diverged: the transformation or the model left its domain.
        """
        stamp, _, q, v, response, seen = estimate
        model, n, c = self.model, len(self.model.coordinates), len(desired.names)
        if desired.names is not self._names:
            self.check_controlled(desired.names)
            self._where = indices(desired.names, model.coordinates, f"{self.name}.model")
            self._weights = self.weights_of(desired.names)
            self._names = desired.names
        t, _ = self._advance_clock(stamp)
        if tuning is not None:
            if tuning.names is not self._tuning_names:
                self._tuned = tuned_by(tuning.names, model.coefficient_names)
                self._tuning_names = tuning.names
            self._tuned.apply(
                tuning.values, self.gain, self.constants, self.coefficients, self._weights
            )
        adaptive = self.transformation is not None and t >= self.adaptive_from
        r, h, out = [0.0] * c, [0.0] * c, [0.0] * c
        s, deformed, effort = [0.0] * n, [0.0] * n, [0.0] * n
        try:
            deform_response(
                self.transformation.deform if self.transformation is not None else no_deformation,
                model.effort,
                int(adaptive),
                self.constants,
                self._weights,
                self.initial,
                self.coefficients,
                self._where,
                self.delay,
                self.hold,
                self.state,
                q,
                v,
                response,
                seen,
                desired.accelerations,
                desired.combined_error,
                r,
                h,
                out,
                s,
                deformed,
                effort,
            )
        except (ArithmeticError, ValueError) as error:
            remedy = self.trouble(q) or str(error)
            raise self._diverged(t, 0, "model's effort", math.nan, remedy) from error
        self._check(t, q, h, deformed, effort)
        return Command(stamp, model.coordinates, deformed, effort)

    def _check(self, t: float, q: Vector, h: Vector, deformed: Vector, effort: Vector) -> None:
        for at in self._where:
            if not math.isfinite(deformed[at]):
                size = math.sqrt(sum([x * x for x in h]))
                remedy = (
                    f"||h|| = {size:g} with A = {self.constants[0]:g} is outside the domain of "
                    "the transformation: a smaller |fpt_deformer.A|, or guard: true"
                )
                raise self._diverged(t, at, "deformed response", deformed[at], remedy)
        for at, value in enumerate(effort):
            if not math.isfinite(value):
                raise self._diverged(t, at, "model's effort", value, self.trouble(q))

    def _diverged(self, t: float, at: int, what: str, value: float, remedy: str) -> Diverged:
        cycle = int(self.state[0]) - 1
        return Diverged(t, self.model.coordinates[at], what, value, remedy=remedy, cycle=cycle)

    def trouble(self, q: Vector) -> str:
        """What is wrong with the approximate model at q; empty: nothing that it knows of."""
        return self.model.trouble(self.coefficients, q) if self.model.trouble is not None else ""

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
