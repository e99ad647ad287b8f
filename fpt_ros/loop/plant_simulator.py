"""Stage 1 and 6 of the cycle: the plant shows its state, and answers the force."""

import math
from array import array

from fpt_ros import registry
from fpt_ros.errors import BadInput, Diverged
from fpt_ros.laws import Vector
from fpt_ros.loop.stage import REALTIME, Input, Stage
from fpt_ros.messages.frames import SECOND, Command, JointStates, Names
from fpt_ros.messages.topics import COMMAND, JOINT_STATES
from fpt_ros.parameters import (
    Parameter,
    Values,
    group,
    integer,
    number,
    numbers,
    prefixed,
    word,
)

STRUCTURE = (
    Parameter("plant", "exact dynamics, by its registered name", kind="str", live=False),
    Parameter("dt", "control cycle, whole nanoseconds", unit="s", above=0.0, live=False),
    Parameter("duration", "length of the run", unit="s", above=0.0, live=False),
    Parameter("seed", "random seed of the measurement noise", 0, minimum=0, live=False),
    Parameter("substeps", "Euler steps in a cycle", 1, minimum=1, maximum=1000, live=False),
    Parameter("initial_position", "in the order of the coordinates; empty: zero", [], live=False),
    Parameter("initial_velocity", "in the order of the coordinates; empty: zero", [], live=False),
    Parameter("disturbance.kind", "shape of the external force, by its name", "none", live=False),
    Parameter("disturbance.coordinate", "where it acts; empty: the first one", "", live=False),
    Parameter("disturbance.amplitude", "factor of the external force", 0.0),
    Parameter("disturbance.frequency", "factor of its time", 1.0, unit="1/s"),
    Parameter("noise.position", "standard deviation of the position noise", 0.0, minimum=0.0),
    Parameter("noise.velocity", "standard deviation of the velocity noise", 0.0, minimum=0.0),
    Parameter("limit.acceleration", "beyond it the run has diverged", 1e9, above=0.0, live=False),
    Parameter("limit.position", "one per coordinate; empty: none", [], above=0.0, live=False),
    Parameter("safe_effort", "what acts when the command is too old", 0.0),
    Parameter("command_timeout", "age at which a command is too old", 0.1, unit="s", above=0.0),
    REALTIME,
    Parameter("await_recorder", "do not outrun the recorder", False, live=False),
)


class PlantSimulator(Stage):
    """The exact plant, integrated by explicit Euler with the force held over the cycle.

    State: q, v and the effort that acted last, n each.
    """

    name = "plant_simulator"
    output = JOINT_STATES

    @classmethod
    def parameters(cls, given: Values) -> tuple[Parameter, ...]:
        """Those of the simulator, and ``exact.NAME`` for each one of the plant's."""
        plant = given.get("plant")
        if not isinstance(plant, str):
            return STRUCTURE
        return STRUCTURE + prefixed("exact", registry.plant(plant).parameters)

    @property
    def inputs(self) -> tuple[Input, ...]:
        """The command of the cycle."""
        return (Input(COMMAND),)

    def _prepare(self) -> None:
        values = self.values
        self._plant = plant = registry.plant(word(values, "plant"))
        n = len(plant.coordinates)
        self._coefficients = plant.coefficients(group(values, "exact", plant.parameters))
        self.dt = number(values, "dt")
        self.cycle_time = round(self.dt * SECOND)
        if self.cycle_time / SECOND != self.dt:
            raise BadInput(f"{self.name}.dt: {self.dt!r} s is not a whole number of nanoseconds")
        self.cycles = round(number(values, "duration") / self.dt)
        if self.cycles < 1:
            raise BadInput(f"{self.name}.duration is shorter than one cycle of {self.dt:g} s")
        self._substeps = integer(values, "substeps")
        self._disturbance = registry.disturbance(word(values, "disturbance.kind")).force
        self._amplitude = number(values, "disturbance.amplitude")
        self._frequency = number(values, "disturbance.frequency")
        where = word(values, "disturbance.coordinate") or plant.coordinates[0]
        self._hit = self._position_of(where, "disturbance.coordinate")
        self._acceleration_limit = number(values, "limit.acceleration")
        self._position_limit = self._vector("limit.position", n, math.inf)
        self._noise = number(values, "noise.position"), number(values, "noise.velocity")
        self._noise_table: list[list[float]] | None = None
        self.timeout = round(number(values, "command_timeout") * SECOND)
        if not self.state:
            start = self._vector("initial_position", n, 0.0)
            start += self._vector("initial_velocity", n, 0.0)
            self.state.extend(start + [0.0] * n)

    @property
    def coordinates(self) -> Names:
        """Names of the coordinates."""
        return self._plant.coordinates

    def _position_of(self, coordinate: str, parameter: str) -> int:
        names = self._plant.coordinates
        if coordinate not in names:
            raise BadInput(
                f"{self.name}.{parameter}: no coordinate '{coordinate}', only {', '.join(names)}"
            )
        return names.index(coordinate)

    def _vector(self, name: str, n: int, default: float) -> list[float]:
        given = numbers(self.values, name)
        if given and len(given) != n:
            names = ", ".join(self._plant.coordinates)
            raise BadInput(f"{self.name}.{name}: {len(given)} numbers given, {n} needed ({names})")
        return given or [default] * n

    def measure(self, stamp: int, cycle: int) -> JointStates:
        """Step 1: what is measured at ``stamp`` [ns], the noise of ``cycle`` added."""
        n = len(self._plant.coordinates)
        state = self.state
        q: Vector = state[:n]
        v: Vector = state[n : 2 * n]
        if self._noise != (0.0, 0.0):
            table = self._noise_of(cycle)
            q = [x + self._noise[0] * e for x, e in zip(q, table[:n], strict=True)]
            v = [x + self._noise[1] * e for x, e in zip(v, table[n:], strict=True)]
        return JointStates(stamp, self._plant.coordinates, q, v, state[2 * n :])

    def _noise_of(self, cycle: int) -> list[float]:
        """Unit normal numbers of a cycle: position noise, then velocity noise."""
        if self._noise_table is None:
            import numpy as np

            generator = np.random.default_rng(integer(self.values, "seed"))
            size = self.cycles, 2 * len(self._plant.coordinates)
            self._noise_table = generator.standard_normal(size).tolist()
        return self._noise_table[cycle % self.cycles]

    def safe_command(self, stamp: int) -> Command:
        """What acts when no command is young enough."""
        n = len(self._plant.coordinates)
        effort = [number(self.values, "safe_effort")] * n
        return Command(stamp, self._plant.coordinates, [math.nan] * n, effort)

    def advance(self, command: Command, stamp: int) -> None:
        """Step 6: apply the effort over [t_k, t_{k+1}), t_k = ``stamp`` [ns].

        Raises:
            Diverged: an acceleration or a position is not finite or beyond its limit.
        """
        state, plant, names = self.state, self._plant, self._plant.coordinates
        n = len(names)
        t, h = stamp / SECOND, self.dt / self._substeps
        q, v, a = list(state[:n]), list(state[n : 2 * n]), [0.0] * n
        effort = list(command.effort)
        for i in range(n):
            if not math.isfinite(effort[i]):
                raise Diverged(t, names[i], "effort", effort[i])
        for step in range(self._substeps):
            acting = effort.copy()
            acting[self._hit] += self._disturbance(self._amplitude, self._frequency, t + step * h)
            try:
                plant.response(self._coefficients, q, v, acting, a)
            except (ArithmeticError, ValueError) as error:
                raise Diverged(t, names[0], "response", math.nan, remedy=str(error)) from error
            for i in range(n):
                if not abs(a[i]) <= self._acceleration_limit:
                    raise Diverged(t, names[i], "acceleration", a[i], self._acceleration_limit)
                q[i] += h * v[i]
                v[i] += h * a[i]
                if not abs(q[i]) <= self._position_limit[i]:
                    raise Diverged(t, names[i], "position", q[i], self._position_limit[i])
        state[:n] = _doubles(q)
        state[n : 2 * n] = _doubles(v)
        state[2 * n :] = _doubles(effort)


def _doubles(values: list[float]) -> "array[float]":
    return array("d", values)
