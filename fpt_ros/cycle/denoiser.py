"""Stage 2 of the cycle: from what is measured to the motion and the observed response."""

import math
from typing import NamedTuple

from fpt_ros.cycle import healing
from fpt_ros.cycle.healing import HEALING, HealingConstants, heal, keep_estimate
from fpt_ros.cycle.joints import Entrance
from fpt_ros.cycle.records import Layout
from fpt_ros.cycle.rows import Commanded, Measured, StateEstimateRow, no_command
from fpt_ros.cycle.stage import ANSWERING, IN_FLIGHT, JOINTS, REALTIME, ROBOT, Input, Stage
from fpt_ros.denoising.streaming import FILTERS, ORDER, Update
from fpt_ros.errors import BadInput
from fpt_ros.laws import Matrix, MutableVector, Switch, Vector, helper
from fpt_ros.messages.frames import Command, Frame, JointStates, StateEstimate
from fpt_ros.messages.topics import COMMAND, JOINT_STATES, STATE_ESTIMATE, Topic
from fpt_ros.parameters import Parameter, Values, flag, integer, number, word, words

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


class DenoiserConstants(NamedTuple):
    """Fixed: the filter's constants, whether a second filter is shown r, how samples are healed."""

    filter: Vector
    synchronised: Switch
    healing: HealingConstants


class DenoiserMemory(NamedTuple):
    """State of the filter; synchronised: of a second one, position and velocity that it sees.

    ``healing``: see :mod:`fpt_ros.cycle.healing`.
    """

    filter: MutableVector
    second: MutableVector
    position: MutableVector
    velocity: MutableVector
    healing: Matrix


class DenoiserWork(NamedTuple):
    """The second filter's position and velocity, which nobody reads, and the healed sample's."""

    position: MutableVector
    velocity: MutableVector
    healed_position: MutableVector
    healed_velocity: MutableVector


@helper
def show_first(measured: Measured, out: StateEstimateRow) -> None:
    """The first cycle: what is measured, at rest where no velocity is; no response is known."""
    q, v = measured.position, measured.velocity
    for i in range(len(q)):
        out.positions[i], out.velocities[i] = q[i], 0.0
        if not math.isnan(v[i]):
            out.velocities[i] = v[i]
        out.accelerations[i], out.deformed[i] = math.nan, math.nan


@helper
def filter_motion(
    update: Update,
    constants: DenoiserConstants,
    memory: DenoiserMemory,
    work: DenoiserWork,
    dt: float,
    measured: Measured,
    command: Commanded,
    out: StateEstimateRow,
) -> None:
    """The filtered motion of a later cycle, ``command`` being that of the cycle before."""
    q, v, deformed = measured.position, measured.velocity, out.deformed
    if constants.healing.heals:
        q, v = work.healed_position, work.healed_velocity
        heal(constants.healing, memory.healing, dt, measured.position, measured.velocity, q, v)
    update(
        constants.filter,
        memory.filter,
        dt,
        q,
        v,
        out.positions,
        out.velocities,
        out.accelerations,
    )
    if constants.healing.heals:
        keep_estimate(
            constants.healing,
            memory.healing,
            out.positions,
            out.velocities,
            out.accelerations,
        )
    for i in range(len(q)):
        deformed[i] = math.nan
    if constants.synchronised:
        synchronise(update, constants, memory, work, dt, command.accelerations, deformed)


@helper
def synchronise(
    update: Update,
    constants: DenoiserConstants,
    memory: DenoiserMemory,
    work: DenoiserWork,
    dt: float,
    r: Vector,
    out: MutableVector,
) -> None:
    """The deformed response r as the filter shows it: filtered is the motion that r would cause.

    That motion goes on by explicit Euler as the plant's; a second filter of the same kind is shown
    it. Exact for filters that are linear; of a bank, for one member.
    """
    q, v = memory.position, memory.velocity
    for i in range(len(out)):
        q[i] += dt * v[i]
        if not math.isnan(r[i]):
            v[i] += dt * r[i]
    update(constants.filter, memory.second, dt, q, v, work.position, work.velocity, out)
    for i in range(len(out)):
        if math.isnan(r[i]):
            out[i] = math.nan


class Denoiser(Stage):
    """A causal filter between the plant and the controller. State: :class:`DenoiserMemory`.

    Where neither a parameter tells the cycle time, the state is sized at the second sample, by the
    gap between the first two.
    """

    name = "denoiser"
    output = STATE_ESTIMATE
    memory: DenoiserMemory
    constants: DenoiserConstants
    _n = 0
    _dt = 0.0
    _first: JointStates | None = None

    @classmethod
    def parameters(cls, given: Values) -> tuple[Parameter, ...]:
        """Those of the stage and of the filter."""
        method = str(given.get("method", METHOD.default))
        own = FILTERS[method].parameters
        return (
            METHOD,
            ORDER,
            SYNCHRONISED,
            *healing.PARAMETERS,
            *own,
            REALTIME,
            ROBOT,
            *ANSWERING,
            JOINTS,
        )

    @property
    def inputs(self) -> tuple[Input, ...]:
        """The measurement of the cycle; synchronised, the command of the cycle before."""
        command = (Input(COMMAND, lag=1),) if self.synchronised else ()
        return (Input(JOINT_STATES), *command)

    @property
    def heals(self) -> bool:
        """Whether lost samples are healed, or left to the filter."""
        return word(self.values, HEALING.name) != "none"

    def admit(self, topic: Topic, frame: Frame) -> Frame:
        """As of any stage; and a measurement without velocity needs a filter that finds it.

        Raises:
            BadInput: the frame cannot be used.
        """
        frame = super().admit(topic, frame)
        if isinstance(frame, JointStates) and self._needs_velocity:
            motions = zip(frame.names, frame.position, frame.velocity, strict=True)
            for name, position, velocity in motions:
                if math.isnan(velocity) and not (self.heals and math.isnan(position)):
                    raise BadInput(
                        f"{self.name}, joint_states: there is no velocity of {name}, and "
                        f"{self.name}.method none takes what is measured: finite_difference finds "
                        "it, or another filter"
                    )
        return frame

    def _prepare(self) -> None:
        values = self.values
        self._needs_velocity = (
            word(values, "method") == METHOD.default and integer(values, "order") == 2
        )
        self.filter = FILTERS[word(values, "method")]
        self.synchronised = flag(values, "synchronised")
        if not self._n:
            joints = tuple(words(values, "joints"))
            self._measured = Entrance(f"{self.name}, joint_states", joints)
            self._commanded = Entrance(f"{self.name}, command", joints)
            self.entrances = {JOINT_STATES.name: self._measured, COMMAND.name: self._commanded}
            self._size(len(joints), number(values, "cycle_time"))
        else:
            self._size(self._n, self._dt)

    def _size(self, n: int, dt: float) -> None:
        """Constants for samples dt [s] apart, and the memory; once both are known."""
        self._n, self._dt = n, dt
        if not n or dt == 0.0:
            return
        constants = list(self.filter.prepare(self.values, n, dt))
        if self.layout is not None and not self.filter.serves(self.constants.filter, constants):
            raise BadInput(f"{self.name}: other filters {IN_FLIGHT}")
        heals = healing.constants_of(self.values)
        self.constants = DenoiserConstants(constants, int(self.synchronised), heals)
        size, second = self.filter.state_size(constants, n), int(self.synchronised)
        layout = Layout(
            DenoiserMemory,
            filter=size,
            second=second * size,
            position=second * n,
            velocity=second * n,
            healing=(healing.ROWS * heals.heals, n),
        )
        self.memory, _ = self._remember(layout)
        self.work = DenoiserWork(*[[0.0] * n for _ in range(4)])

    def begin(self, first: JointStates, dt: float = 0.0) -> None:
        """Take the first sample; ``dt`` [s] where no parameter tells it."""
        q, v = list(first.position), list(first.velocity)
        if not self.sized:
            self._size(len(q), self._dt or dt)
        filter_constants = self.constants.filter
        self.filter.start(filter_constants, self.memory.filter, q, v)
        if self.constants.healing.heals:
            healing.start(self.memory.healing, q, v)
        if self.synchronised:
            at_rest = [0.0] * len(q)
            for i, x in enumerate(q):
                self.memory.position[i], self.memory.velocity[i] = x, 0.0
            self.filter.start(filter_constants, self.memory.second, q, at_rest)

    @property
    def sized(self) -> bool:
        """Whether joints and cycle time are known."""
        return bool(self._n) and self._dt > 0.0

    def report(self) -> dict[str, object]:
        """Standard deviations of the newest estimates, where the filter knows them."""
        if self.filter.deviation is None or not self.sized or self.clock[0] < 0:
            return {}
        told: dict[str, object] = {}
        for c, name in enumerate(self._measured.names):
            found = self.filter.deviation(self.constants.filter, self.memory.filter, c)
            if found is None:
                return {}
            for what, value in zip(("position", "velocity", "response"), found, strict=True):
                told[f"deviation of {what} {name}"] = f"{value:.3g}"
        return told

    def step(self, measured: JointStates, command: Command | None = None) -> StateEstimate:
        """Filtered motion at t_k and the response to r_{k-1}; NaN for it in the first cycle."""
        measured = self._measured.take(measured)
        stamp, names, n = measured.stamp, measured.names, len(measured.names)
        first = self.clock[0] < 0
        _, dt = self._advance_clock(stamp)
        out = StateEstimateRow([0.0] * n, [0.0] * n, [0.0] * n, [0.0] * n)
        if first:
            show_first(measured, out)
            if self.sized or self._dt:
                self.begin(measured)
            else:
                self._first = measured
            return StateEstimate(stamp, names, *out)
        if not self.sized:
            self.begin(self._first or measured, dt)
        update, constants, memory = self.filter.update, self.constants, self.memory
        if command is None:
            before, constants = no_command(names), constants._replace(synchronised=0)
        else:
            before = self._commanded.take(command)
        filter_motion(update, constants, memory, self.work, dt, measured, before, out)
        return StateEstimate(stamp, names, *out)
