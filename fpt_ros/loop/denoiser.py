"""Stage 2 of the cycle: from what is measured to the motion and the observed response."""

import math

from fpt_ros import registry
from fpt_ros.denoising.streaming import ORDER
from fpt_ros.loop.stage import REALTIME, Input, Stage
from fpt_ros.messages.frames import JointStates, StateEstimate
from fpt_ros.messages.topics import JOINT_STATES, STATE_ESTIMATE
from fpt_ros.parameters import Parameter, Values, word

METHOD = Parameter(
    "method", "filter, by its registered name; none: differences", "none", live=False
)


class Denoiser(Stage):
    """A causal filter between the plant and the controller.

    State: that of the filter; before the second sample, which tells the time between two, the
    first one.
    """

    name = "denoiser"
    output = STATE_ESTIMATE

    @classmethod
    def parameters(cls, given: Values) -> tuple[Parameter, ...]:
        """Those of the stage and of the filter."""
        method = str(given.get("method", METHOD.default))
        return (METHOD, ORDER, *registry.streaming_filter(method).parameters, REALTIME)

    @property
    def inputs(self) -> tuple[Input, ...]:
        """The measurement of the cycle."""
        return (Input(JOINT_STATES),)

    def _prepare(self) -> None:
        self.filter = registry.streaming_filter(word(self.values, "method"))
        self.constants: list[float] = []

    def begin(self, q: list[float], v: list[float], dt: float) -> None:
        """Size the state for samples dt [s] apart, and take the first one."""
        self._set_constants(len(q), dt)
        del self.state[:]
        self.state.extend([0.0] * self.filter.state_size(self.constants, len(q)))
        self.filter.start(self.constants, self.state, q, v)

    def _set_constants(self, n: int, dt: float) -> None:
        self.constants = list(self.filter.prepare(self.values, n, dt))

    def step(self, measured: JointStates) -> StateEstimate:
        """Filtered motion at t_k and the response to r_{k-1}; NaN for it in the first cycle."""
        stamp, names, q, v, _ = measured
        n = len(names)
        t, dt = self._advance_clock(stamp)
        if not self.state:
            self.state.extend([*q, *v])
            return StateEstimate(stamp, names, q, v, [math.nan] * n)
        if t == dt and not self.constants:  # the second sample
            self.begin(list(self.state[:n]), list(self.state[n:]), dt)
        elif not self.constants:  # changed in flight, or come back
            self._set_constants(n, dt)
        out_q, out_v, response = [0.0] * n, [0.0] * n, [0.0] * n
        self.filter.update(self.constants, self.state, dt, q, v, out_q, out_v, response)
        return StateEstimate(stamp, names, out_q, out_v, response)
