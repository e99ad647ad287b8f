"""Stage 4 of the cycle: what was observed corrects the approximate model."""

from fpt_ros import registry
from fpt_ros.errors import BadInput
from fpt_ros.loop.approximate_model import model_parameters
from fpt_ros.loop.stage import REALTIME, Input, Stage
from fpt_ros.messages.frames import Command, StateEstimate, Tuning
from fpt_ros.messages.topics import COMMAND, STATE_ESTIMATE, TUNING
from fpt_ros.parameters import Parameter, Values, group, word

NONE = "none"

METHOD = Parameter("method", "tuning law, by its name; none: not in the loop", NONE, live=False)


def in_the_loop(values: Values) -> bool:
    """Whether a tuner with these parameters takes part in the cycle."""
    return values.get("method", NONE) != NONE


class ParameterTuner(Stage):
    """Identification of the model's coefficients Theta^ in the loop.

    The response to r_{k-1} is seen in cycle k; together with q and v kept of cycle k-1 and the
    effort of that cycle's command it gives the rate, and Theta^ steps over the time between
    (explicit Euler). State: Theta^, then q and v of the latest cycle.
    """

    name = "parameter_tuner"
    output = TUNING

    @classmethod
    def parameters(cls, given: Values) -> tuple[Parameter, ...]:
        """``method``; with a law in the loop also those of the law and of the model."""
        if not in_the_loop(given):
            return (METHOD, REALTIME)
        law = registry.tuning_law(str(given["method"]))
        return (METHOD, REALTIME, *law.parameters, *model_parameters(given, live=False))

    @property
    def inputs(self) -> tuple[Input, ...]:
        """The estimate of the cycle and the command of the cycle before."""
        return (Input(STATE_ESTIMATE), Input(COMMAND, lag=1)) if self.active else ()

    @property
    def active(self) -> bool:
        """Whether the tuner takes part in the cycle."""
        return in_the_loop(self.values)

    def _prepare(self) -> None:
        if not self.active:
            return
        values = self.values
        law = registry.tuning_law(word(values, "method"))
        self._constants, self._rate = law.prepare(values), law.rate
        self._model = model = registry.model(word(values, "model"))
        if model.regressor is None:
            raise BadInput(
                f"{self.name}.method: {word(values, 'method')} tunes models that are linear in "
                f"their coefficients, {word(values, 'model')} is not declared so"
            )
        self._regressor = model.regressor
        if not self.state:
            theta = model.coefficients(group(values, "approximate", model.parameters))
            self.state.extend(theta)
            self.state.extend([0.0] * (2 * len(model.coordinates)))

    def step(self, estimate: StateEstimate, command: Command | None) -> Tuning:
        """Theta^ of cycle k; the initial one in the first cycle, where ``command`` is None."""
        stamp, _, q, v, response = estimate
        _, dt = self._advance_clock(stamp)
        model, state = self._model, self.state
        n, size = len(model.coordinates), len(model.coefficient_names)
        theta = list(state[:size])
        if command is not None:
            last_q, last_v = state[size : size + n], state[size + n :]
            regressor, rate = [0.0] * (model.rows * size), [0.0] * size
            self._regressor(last_q, last_v, response, regressor)
            error = [
                command.effort[i] - sum([regressor[i * size + j] * theta[j] for j in range(size)])
                for i in range(model.rows)
            ]
            self._rate(self._constants, regressor, error, rate)
            theta = [theta[j] + dt * rate[j] for j in range(size)]
        for i, value in enumerate((*theta, *q, *v)):
            state[i] = value
        return Tuning(stamp, model.coefficient_names, theta)
