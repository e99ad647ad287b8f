"""Stage 3 of the cycle: the nominal motion, and the response that makes the error decay."""

import math
from typing import NamedTuple

from fpt_ros.cycle.joints import Entrance
from fpt_ros.cycle.records import Layout
from fpt_ros.cycle.rows import DesiredRow, Estimated
from fpt_ros.cycle.stage import ANSWERING, CYCLE_TIME, JOINTS, REALTIME, Input, Stage, indices
from fpt_ros.errors import BadInput
from fpt_ros.laws import Indices, MutableVector, Switch, Vector, helper
from fpt_ros.messages.frames import SECOND, Desired, Names, StateEstimate
from fpt_ros.messages.topics import DESIRED, STATE_ESTIMATE
from fpt_ros.parameters import Parameter, Values, integer, number, numbers, word, words
from fpt_ros.relaxations import RELAXATIONS, Prescribe, combined_error
from fpt_ros.trajectories import TRAJECTORIES, Nominal

RELAXATION = Parameter(
    "error_relaxation",
    "how the tracking error is to decay, by its registered name",
    "pid",
    live=False,
)

PARAMETERS = (
    Parameter("trajectory", "nominal motion, by its registered name", kind="str", live=False),
    Parameter("controlled", "coordinates that follow it", kind="strings", live=False),
    Parameter("amplitude", "scale of the nominal motion, per coordinate", kind="floats"),
    Parameter("frequency", "scale of its time, per coordinate", kind="floats", unit="1/s"),
    Parameter("lambda", "decay rate Lambda of the tracking error", unit="1/s", above=0.0),
    RELAXATION,
    Parameter(
        "time_sharing",
        "how long each coordinate is controlled, in turn; empty: all of them always",
        [],
        unit="s",
        above=0.0,
        live=False,
    ),
    Parameter(
        "nominal_delay",
        "cycles by which the nominal motion is late, as sensors may be",
        0,
        minimum=0,
        maximum=1000,
        live=False,
    ),
    REALTIME,
    *ANSWERING,
    JOINTS,
)


class TrajectoryConstants(NamedTuple):
    """Constants of the motion and of the relaxation; places of the controlled coordinates; slots.

    ``slots``: how long each coordinate's turn is [ns]; empty: it is always everyone's. ``order``:
    derivative of the nominal motion that is the nominal response, that of the plant. ``late``: by
    which the nominal motion is delayed [s].
    """

    nominal: Vector
    relaxation: Vector
    where: Indices
    slots: Vector
    order: Switch
    late: float


class TrajectoryMemory(NamedTuple):
    """What the motion's error has been, and the state of a motion that is integrated.

    ``integral``: of the tracking errors (c); ``error``: of the latest cycle (c), which the next one
    adds to it (forward rectangles over the time that really passed); ``turn``: whose turn the
    latest cycle was, one number.
    """

    integral: MutableVector
    error: MutableVector
    turn: MutableVector
    nominal: MutableVector


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
    nominal: Nominal,
    relax: Prescribe,
    constants: TrajectoryConstants,
    memory: TrajectoryMemory,
    active: int,
    t: float,
    dt: float,
    estimate: Estimated,
    out: DesiredRow,
) -> None:
    """Nominal motion and desired response of the c controlled coordinates, t [s] after the start.

    dt [s] since the latest cycle, 0 in the first. A coordinate whose turn it is not (``active``)
    gets NaN as its response; where its turn begins, its integral is zero.
    """
    then = max(t - constants.late, 0.0)
    nominal(
        constants.nominal,
        memory.nominal,
        then,
        dt,
        out.positions,
        out.velocities,
        out.accelerations,
    )
    rate, integral, last = constants.relaxation, memory.integral, memory.error
    q, v, q_n, v_n = estimate.positions, estimate.velocities, out.positions, out.velocities
    response, combined, order = out.accelerations, out.combined_error, constants.order
    for i in range(len(q_n)):
        if active >= 0 and active != i:
            response[i] = math.nan
            combined[i] = math.nan
            continue
        if active >= 0 and memory.turn[0] != active:
            integral[i] = 0.0
        else:
            integral[i] = integral[i] + dt * last[i]
        at = constants.where[i]
        error, error_dot = q_n[i] - q[at], v_n[i] - v[at]
        combined[i] = combined_error(rate[0], error, error_dot, integral[i])
        wanted = response[i] if order == 2 else v_n[i] if order == 1 else q_n[i]
        response[i] = relax(rate, wanted, error, error_dot, integral[i])
        last[i] = error
    memory.turn[0] = active


class TrajectoryGenerator(Stage):
    """Kinematic prescription of the desired response. State: :class:`TrajectoryMemory`.

    ``controlled`` are the coordinates that follow the nominal motion; with ``time_sharing`` one
    after the other.
    """

    name = "trajectory_generator"
    output = DESIRED
    memory: TrajectoryMemory

    @classmethod
    def parameters(cls, given: Values) -> tuple[Parameter, ...]:
        """Those of the stage, of the trajectory and of the relaxation."""
        name = given.get("trajectory")
        own = TRAJECTORIES[name].parameters if isinstance(name, str) else ()
        relaxation = str(given.get(RELAXATION.name, RELAXATION.default))
        return (*PARAMETERS, *own, *RELAXATIONS[relaxation].parameters)

    @property
    def inputs(self) -> tuple[Input, ...]:
        """The estimate of the cycle."""
        return (Input(STATE_ESTIMATE),)

    def _prepare(self) -> None:
        values = self.values
        self.controlled = tuple(words(values, "controlled"))
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
        slots = [float(round(x * SECOND)) for x in numbers(values, "time_sharing")]
        if len(slots) not in (0, c):
            raise BadInput(
                f"{self.name}.time_sharing: {len(slots)} given, {c} needed "
                f"({', '.join(self.controlled)}), or none"
            )
        self.trajectory = TRAJECTORIES[word(values, "trajectory")]
        self.relaxation = RELAXATIONS[word(values, RELAXATION.name)]
        self._motion = self.trajectory.prepare(values, c)  # and what its addresses point to
        decay = list(self.relaxation.prepare(values))
        self._entrance = Entrance(f"{self.name}, state_estimate", tuple(words(values, "joints")))
        self.entrances = {STATE_ESTIMATE.name: self._entrance}
        self._names: Names = ()
        late = self._delay()
        self.constants = TrajectoryConstants(
            list(self._motion), decay, (), slots, self.relaxation.order, late
        )
        self._turns = [(name,) for name in self.controlled]
        layout = Layout(
            TrajectoryMemory, integral=c, error=c, turn=1, nominal=len(self.trajectory.state)
        )
        self.memory, fresh = self._remember(layout)
        if fresh:
            self.memory.turn[0] = -1.0
            for i, x in enumerate(self.trajectory.state):
                self.memory.nominal[i] = x

    def _delay(self) -> float:
        """By how long the nominal motion is late [s]."""
        cycles, dt = integer(self.values, "nominal_delay"), number(self.values, CYCLE_TIME.name)
        if cycles and self.trajectory.state:
            name = word(self.values, "trajectory")
            raise BadInput(f"{self.name}.nominal_delay: {name} is integrated, it cannot be late")
        if cycles and not dt:
            raise BadInput(f"{self.name}.cycle_time is missing: nominal_delay is told in cycles")
        return cycles * dt

    def locate(self, names: Names) -> tuple[int, ...]:
        """Where the controlled coordinates stand among ``names``."""
        return indices(self.controlled, names, f"{self.name}.controlled")

    def place(self, names: Names) -> TrajectoryConstants:
        """The constants, for estimates whose vectors are over ``names``."""
        if names != self._names:
            self.constants = self.constants._replace(where=self.locate(names))
            self._names = names
        return self.constants

    def step(self, estimate: StateEstimate) -> Desired:
        """Nominal motion at t_k and the desired response, for the controlled coordinates."""
        estimate = self._entrance.take(estimate)
        constants = self.place(estimate.names)
        stamp, c = estimate.stamp, len(self.controlled)
        t, dt = self._advance_clock(stamp)
        out = DesiredRow([0.0] * c, [0.0] * c, [0.0] * c, [0.0] * c)
        active = slot(constants.slots, float(stamp - self.clock[0]))
        nominal, relax = self.trajectory.nominal, self.relaxation.prescribe
        prescribe(nominal, relax, constants, self.memory, active, t, dt, estimate, out)
        if active < 0:
            return Desired(stamp, self.controlled, *out)
        return Desired(stamp, self._turns[active], *[[vector[active]] for vector in out])
