"""Stage 2 of the cycle: from what is measured to the motion and the observed response."""

import math
from array import array
from collections.abc import Callable

from fpt_ros import registry
from fpt_ros.cycle.stage import CYCLE_TIME, REALTIME, Input, Stage
from fpt_ros.denoising.streaming import ORDER
from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.messages.frames import Command, JointStates, StateEstimate
from fpt_ros.messages.topics import COMMAND, JOINT_STATES, STATE_ESTIMATE
from fpt_ros.parameters import Parameter, Values, flag, word

METHOD = Parameter(
    "method",
    "filter, by its registered name; none: differences; not given, an experiment with noise has "
    "kalman_bank",
    "none",
    live=False,
)
FILTER_OF_NOISE = "kalman_bank"
"""Chosen for an experiment whose plant has noise and that names none."""

SYNCHRONISED = Parameter(
    "synchronised",
    "the deformation goes on from r as the filter shows it, instead of from the newest r",
    False,
    live=False,
)
"""Of denoiser and deformer alike: the one works it out, the other makes use of it."""


@helper
def synchronise(
    update: Callable[..., None],
    constants: Vector,
    state: MutableVector,
    motion: MutableVector,
    dt: float,
    r: Vector,
    out_q: MutableVector,
    out_v: MutableVector,
    out: MutableVector,
) -> None:
    """The deformed response r as the filter shows it: filtered is the motion that r would cause.

    ``motion``: position and velocity of that motion, n each, by explicit Euler as the plant's;
    ``state``: that of a second filter of the same kind, which is shown it. Exact for filters that
    are linear; of a bank, for one member.
    """
    n = len(out)
    for i in range(n):
        motion[i] += dt * motion[n + i]
        if not math.isnan(r[i]):
            motion[n + i] += dt * r[i]
    update(constants, state, dt, motion[:n], motion[n:], out_q, out_v, out)
    for i in range(n):
        if math.isnan(r[i]):
            out[i] = math.nan


class Denoiser(Stage):
    """A causal filter between the plant and the controller.

    State: that of the filter; where it is synchronised, also that of a second one and the motion
    that it sees. Before the second sample, which tells the time between two, the first one.
    """

    name = "denoiser"
    output = STATE_ESTIMATE

    @classmethod
    def parameters(cls, given: Values) -> tuple[Parameter, ...]:
        """Those of the stage and of the filter."""
        method = str(given.get("method", METHOD.default))
        own = registry.streaming_filter(method).parameters
        return (METHOD, ORDER, SYNCHRONISED, *own, REALTIME, CYCLE_TIME)

    @property
    def inputs(self) -> tuple[Input, ...]:
        """The measurement of the cycle; synchronised, the command of the cycle before."""
        command = (Input(COMMAND, lag=1),) if self.synchronised else ()
        return (Input(JOINT_STATES), *command)

    def _prepare(self) -> None:
        self.filter = registry.streaming_filter(word(self.values, "method"))
        self.synchronised = flag(self.values, "synchronised")
        self.constants: list[float] = []
        self._size = 0

    def begin(self, q: list[float], v: list[float], dt: float) -> None:
        """Size the state for samples dt [s] apart, and take the first one."""
        self._set_constants(len(q), dt)
        self.state = array("d")
        motion = [*q, *([0.0] * len(q))] if self.synchronised else []
        filters = 2 if self.synchronised else 1
        self.state.extend([0.0] * (filters * self._size) + motion)
        self.filter.start(self.constants, self.parts()[0], q, v)
        if self.synchronised:
            self.filter.start(self.constants, self.parts()[1], q, motion[len(q) :])

    def parts(self) -> tuple[MutableVector, ...]:
        """The state: of the filter, of the second one, and of the motion that it sees."""
        size = self._size
        return self._divide(size, (2 if self.synchronised else 1) * size)

    def _set_constants(self, n: int, dt: float) -> None:
        self.constants = list(self.filter.prepare(self.values, n, dt))
        self._size = self.filter.state_size(self.constants, n)

    def step(self, measured: JointStates, command: Command | None = None) -> StateEstimate:
        """Filtered motion at t_k and the response to r_{k-1}; NaN for it in the first cycle."""
        stamp, names, q, v, _ = measured
        n = len(names)
        t, dt = self._advance_clock(stamp)
        unknown = [math.nan] * n
        if not self.state:
            self.state.extend([*q, *v])
            at_rest = [0.0 if math.isnan(x) else x for x in v]  # what is not measured is so taken
            return StateEstimate(stamp, names, q, at_rest, unknown, unknown)
        if t == dt and not self._size:  # the second sample
            self.begin(list(self.state[:n]), list(self.state[n:]), dt)
        elif not self._size:  # changed in flight, or come back
            self._set_constants(n, dt)
        out_q, out_v, response = [0.0] * n, [0.0] * n, [0.0] * n
        first, second, motion = self.parts()
        self.filter.update(self.constants, first, dt, q, v, out_q, out_v, response)
        if not self.synchronised or command is None:
            return StateEstimate(stamp, names, out_q, out_v, response, unknown)
        seen, work = [0.0] * n, ([0.0] * n, [0.0] * n)
        r = command.accelerations
        synchronise(self.filter.update, self.constants, second, motion, dt, r, *work, seen)
        return StateEstimate(stamp, names, out_q, out_v, response, seen)
