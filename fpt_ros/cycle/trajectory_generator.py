"""Stage 3 of the cycle: the nominal motion, and the response that makes the error decay."""

import math
from collections.abc import Callable

from fpt_ros import registry
from fpt_ros.cycle.stage import CYCLE_TIME, REALTIME, Input, Stage, indices
from fpt_ros.error_relaxation import RELAXATIONS, Prescription, combined_error
from fpt_ros.errors import BadInput
from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.messages.frames import SECOND, Desired, Names, StateEstimate
from fpt_ros.messages.topics import DESIRED, STATE_ESTIMATE
from fpt_ros.parameters import Parameter, Values, number, numbers, word, words

PARAMETERS = (
    Parameter("trajectory", "nominal motion, by its registered name", kind="str", live=False),
    Parameter("controlled", "coordinates that follow it", kind="strings", live=False),
    Parameter("amplitude", "scale of the nominal motion, per coordinate", kind="floats"),
    Parameter("frequency", "scale of its time, per coordinate", kind="floats", unit="1/s"),
    Parameter("lambda", "decay rate Lambda of the tracking error", unit="1/s", above=0.0),
    Parameter(
        "error_relaxation",
        "how the tracking error is to decay",
        "pid",
        choices=tuple(sorted(RELAXATIONS)),
        live=False,
    ),
    Parameter(
        "time_sharing",
        "how long each coordinate is controlled, in turn; empty: all of them always",
        [],
        unit="s",
        above=0.0,
        live=False,
    ),
    REALTIME,
    CYCLE_TIME,
)


@helper
def slot(lengths: Vector, elapsed: float) -> int:
    """Which coordinate's turn it is ``elapsed`` [ns] after the start; -1: everyone's."""
    if len(lengths) == 0:
        return -1
    total = 0.0
    for i in range(len(lengths)):
        total += lengths[i]
    phase = elapsed % total
    for i in range(len(lengths)):
        if phase < lengths[i]:
            return i
        phase -= lengths[i]
    return len(lengths) - 1


@helper
def prescribe(
    nominal: Callable[..., None],
    relax: Prescription,
    constants: Vector,
    lam: float,
    where: "tuple[int, ...] | list[int]",
    active: int,
    motion: MutableVector,
    state: MutableVector,
    t: float,
    dt: float,
    q: Vector,
    v: Vector,
    out_q: MutableVector,
    out_v: MutableVector,
    out_response: MutableVector,
    out_s: MutableVector,
) -> None:
    """Nominal motion and desired response of the c controlled coordinates.

    ``motion`` is the state of the trajectory. ``state``: the integrals of the tracking errors (c),
    the errors of the latest cycle (c), which the next cycle adds to them (forward rectangles over
    the time that really passed), and whose turn the latest cycle was. A coordinate whose turn it is
    not gets NaN as its response; where its turn begins, its integral is zero.
    """
    c = len(out_q)
    nominal(constants, motion, t, dt, out_q, out_v, out_response)
    for i in range(c):
        if active >= 0 and active != i:
            out_response[i] = math.nan
            out_s[i] = math.nan
            continue
        if active >= 0 and state[2 * c] != active:
            state[i] = 0.0
        else:
            state[i] = state[i] + dt * state[c + i]
        at = where[i]
        error, error_dot = out_q[i] - q[at], out_v[i] - v[at]
        out_s[i] = combined_error(lam, error, error_dot, state[i])
        out_response[i] = relax(lam, out_response[i], error, error_dot, state[i])
        state[c + i] = error
    state[2 * c] = active


class TrajectoryGenerator(Stage):
    """Kinematic prescription of the desired response.

    ``controlled`` are the coordinates that follow the nominal motion; with ``time_sharing`` one
    after the other. State: see :func:`prescribe`, then that of the trajectory.
    """

    name = "trajectory_generator"
    output = DESIRED

    @classmethod
    def parameters(cls, given: Values) -> tuple[Parameter, ...]:
        """Those of the stage and of the trajectory."""
        name = given.get("trajectory")
        own = registry.trajectory(name).parameters if isinstance(name, str) else ()
        return (*PARAMETERS, *own)

    @property
    def inputs(self) -> tuple[Input, ...]:
        """The estimate of the cycle."""
        return (Input(STATE_ESTIMATE),)

    def _prepare(self) -> None:
        values = self.values
        self.controlled = tuple(words(values, "controlled"))
        self.lam = number(values, "lambda")
        c = len(self.controlled)
        if not 0 < c == len(set(self.controlled)):
            raise BadInput(
                f"{self.name}.controlled: {list(self.controlled)} is not valid, it takes one or "
                "more different coordinates of the plant"
            )
        for name in ("amplitude", "frequency"):
            given = numbers(values, name)
            if len(given) != c:
                wanted = ", ".join(self.controlled)
                raise BadInput(f"{self.name}.{name}: {len(given)} given, {c} needed ({wanted})")
        self.slots = [float(round(x * SECOND)) for x in numbers(values, "time_sharing")]
        if len(self.slots) not in (0, c):
            raise BadInput(
                f"{self.name}.time_sharing: {len(self.slots)} given, {c} needed "
                f"({', '.join(self.controlled)}), or none"
            )
        self.trajectory = registry.trajectory(word(values, "trajectory"))
        self.constants = list(self.trajectory.prepare(values, c))
        self.relaxation = RELAXATIONS[word(values, "error_relaxation")]
        self._names: Names = ()
        self._turns = [(name,) for name in self.controlled]
        if not self.state:
            self.state.extend([0.0] * (2 * c) + [-1.0, *self.trajectory.state])

    def memory(self) -> tuple[MutableVector, ...]:
        """The state in its two parts: of the trajectory, and of the errors."""
        errors, trajectory = self._divide(2 * len(self.controlled) + 1)
        return trajectory, errors

    def locate(self, names: Names) -> tuple[int, ...]:
        """Where the controlled coordinates stand among ``names``."""
        return indices(self.controlled, names, f"{self.name}.controlled")

    def step(self, estimate: StateEstimate) -> Desired:
        """Nominal motion at t_k and the desired response, for the controlled coordinates."""
        stamp, names, q, v, _, _ = estimate
        if names is not self._names:
            self._where = self.locate(names)
            self._names = names
        t, dt = self._advance_clock(stamp)
        c = len(self.controlled)
        out = [0.0] * c, [0.0] * c, [0.0] * c, [0.0] * c
        motion, errors = self.memory()
        active = slot(self.slots, float(stamp - self.clock[0]))
        prescribe(
            self.trajectory.nominal,
            self.relaxation.prescribe,
            self.constants,
            self.lam,
            self._where,
            active,
            motion,
            errors,
            t,
            dt,
            q,
            v,
            *out,
        )
        if active < 0:
            return Desired(stamp, self.controlled, *out)
        return Desired(stamp, self._turns[active], *[[vector[active]] for vector in out])
