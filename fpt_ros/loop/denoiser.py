"""Stage 2 of the cycle: from what is measured to the motion and the observed response."""

import math

from fpt_ros import registry
from fpt_ros.loop.stage import REALTIME, Input, Stage
from fpt_ros.messages.frames import JointStates, StateEstimate
from fpt_ros.messages.topics import JOINT_STATES, STATE_ESTIMATE
from fpt_ros.parameters import Parameter, Values, word

PARAMETERS = (
    Parameter("method", "filter, by its registered name; none: differences", "none", live=False),
    REALTIME,
)


class Denoiser(Stage):
    """A causal filter between the plant and the controller. State: that of the filter."""

    name = "denoiser"
    output = STATE_ESTIMATE

    @classmethod
    def parameters(cls, given: Values) -> tuple[Parameter, ...]:
        """Those of the stage."""
        return PARAMETERS

    @property
    def inputs(self) -> tuple[Input, ...]:
        """The measurement of the cycle."""
        return (Input(JOINT_STATES),)

    def _prepare(self) -> None:
        self._filter = registry.streaming_filter(word(self.values, "method"))

    def step(self, measured: JointStates) -> StateEstimate:
        """Filtered motion at t_k and the response to r_{k-1}; NaN for it in the first cycle."""
        stamp, names, q, v, _ = measured
        n = len(names)
        _, dt = self._advance_clock(stamp)
        if not self.state:
            self.state.extend([0.0] * self._filter.state_size(n))
            self._filter.start(self.state, q, v)
            return StateEstimate(stamp, names, q, v, [math.nan] * n)
        out_q, out_v, response = [0.0] * n, [0.0] * n, [0.0] * n
        self._filter.update(self.state, dt, q, v, out_q, out_v, response)
        return StateEstimate(stamp, names, out_q, out_v, response)
