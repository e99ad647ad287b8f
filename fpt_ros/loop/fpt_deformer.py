"""Stage 5 of the cycle: the desired response is deformed, and the model turns it into a force."""

import math

from fpt_ros import registry
from fpt_ros.errors import BadInput, Diverged
from fpt_ros.laws import NOT_CONTROLLED
from fpt_ros.loop.approximate_model import model_parameters
from fpt_ros.loop.stage import REALTIME, Input, Stage, indices
from fpt_ros.messages.frames import Command, Desired, Names, StateEstimate, Tuning
from fpt_ros.messages.topics import COMMAND, DESIRED, STATE_ESTIMATE
from fpt_ros.messages.topics import TUNING as TUNING_TOPIC
from fpt_ros.parameters import Parameter, Values, flag, group, number, word

NONE = "none"

PARAMETERS = (
    Parameter(
        "transformation",
        "fixed point transformation, by its name; none: not adaptive",
        NONE,
        live=False,
    ),
    Parameter("adaptive_from", "time at which the deformation starts", 0.0, unit="s", minimum=0.0),
    Parameter("await_tuning", "a tuner is in the loop: wait for it", False, live=False),
    Parameter("effort_command", "publish the efforts for a ros2_control controller", False),
    REALTIME,
)


class FptDeformer(Stage):
    """Fixed point transformation and approximate model.

    State: r of the latest cycle, one number per coordinate, NaN where it was not controlled.
    """

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
        self._model = model = registry.model(word(values, "model"))
        self._coefficients = model.coefficients(group(values, "approximate", model.parameters))
        kind = word(values, "transformation")
        self._transformation = registry.transformation(kind) if kind != NONE else None
        if self._transformation is not None:
            self._constants = self._transformation.prepare(values)
        self._adaptive_from = number(values, "adaptive_from")
        self._names: Names = ()
        if not self.state:
            self.state.extend([NOT_CONTROLLED] * len(model.coordinates))

    def step(
        self, estimate: StateEstimate, desired: Desired, tuning: Tuning | None = None
    ) -> Command:
        """Deformed response r_k = G(r_{k-1}, response_k - desired_k) and the model's effort.

        Raises:
            Diverged: the transformation or the model left its domain.
        """
        stamp, _, q, v, response = estimate
        model, state = self._model, self.state
        if desired.names is not self._names:
            self.check_controlled(desired.names)
            self._where = indices(desired.names, model.coordinates, f"{self.name}.model")
            self._names = desired.names
        where = self._where
        t, _ = self._advance_clock(stamp)
        r = list(desired.accelerations)
        if self._transformation is not None and t >= self._adaptive_from:
            r = self._deform(t, r, [response[i] for i in where])
        deformed = [NOT_CONTROLLED] * len(state)
        for i, value in zip(where, r, strict=True):
            deformed[i] = value
        for i, value in enumerate(deformed):
            state[i] = value
        coefficients = self._coefficients if tuning is None else tuning.values
        effort = [0.0] * len(state)
        try:
            model.effort(coefficients, q, v, deformed, effort)
        except (ArithmeticError, ValueError) as error:
            name = model.coordinates[0]
            raise Diverged(t, name, "model's effort", math.nan, remedy=str(error)) from error
        return Command(stamp, model.coordinates, deformed, effort)

    def _deform(self, t: float, desired: list[float], response: list[float]) -> list[float]:
        """r_k of the controlled coordinates; one that is controlled anew gets the desired one."""
        assert self._transformation is not None
        r, h = desired.copy(), [0.0] * len(desired)
        anew = [math.isnan(self.state[at]) for at in self._where]
        for i, at in enumerate(self._where):
            if not anew[i]:
                r[i] = self.state[at]
                h[i] = response[i] - desired[i]
        out = [0.0] * len(r)
        self._transformation.deform(self._constants, r, h, out)
        out = [desired[i] if anew[i] else value for i, value in enumerate(out)]
        for i, value in enumerate(out):
            if not math.isfinite(value):
                name = self._model.coordinates[self._where[i]]
                size = math.sqrt(sum([x * x for x in h]))
                raise Diverged(
                    t,
                    name,
                    "deformed response",
                    value,
                    remedy=f"response error {size:g}; a smaller |A| keeps F in its domain",
                )
        return out

    @property
    def coordinates(self) -> Names:
        """Names of the model's coordinates."""
        return self._model.coordinates

    def check_controlled(self, names: Names) -> None:
        """Raise BadInput where the model cannot prescribe the response of one of ``names``."""
        for name in names:
            if name not in self._model.controlled:
                valid = ", ".join(self._model.controlled)
                raise BadInput(
                    f"{self.name}.model: {word(self.values, 'model')} cannot prescribe the "
                    f"response of '{name}', only of {valid} (see trajectory_generator.controlled)"
                )
