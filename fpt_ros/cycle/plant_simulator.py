"""Stage 1 and 6 of the cycle: the plant shows its state, and answers the force."""

import math
from array import array
from collections.abc import Callable

from fpt_ros import registry
from fpt_ros.cycle.stage import REALTIME, Input, Stage
from fpt_ros.errors import BadInput, Diverged
from fpt_ros.laws import MutableVector, Vector, helper
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
    Parameter("measured", "what the sensors tell", "all", choices=("all", "position"), live=False),
    Parameter(
        "measurement_delay",
        "cycles by which the sensors are late",
        0,
        minimum=0,
        maximum=1000,
        live=False,
    ),
    Parameter("noise.position", "standard deviation of the position noise", 0.0, minimum=0.0),
    Parameter("noise.velocity", "standard deviation of the velocity noise", 0.0, minimum=0.0),
    Parameter("limit.acceleration", "beyond it the run has diverged", 1e9, above=0.0, live=False),
    Parameter("limit.position", "one per coordinate; empty: none", [], above=0.0, live=False),
    Parameter("safe_effort", "what acts when the command is too old", 0.0),
    Parameter("command_timeout", "age at which a command is too old", 0.1, unit="s", above=0.0),
    REALTIME,
    Parameter("await_recorder", "do not outrun the recorder", False, live=False),
)

GOOD, EFFORT, RESPONSE, POSITION = 0, 1, 2, 3
"""What :func:`integrate` found wrong; times ``CODE``, plus the coordinate."""

CODE = 1024

LOST = "control is lost: fpt gain shows which fpt_deformer.A converges, and of which sign"
"""The remedy where nothing better is known."""


@helper
def measure(
    state: Vector,
    sigma_q: float,
    sigma_v: float,
    table: Vector,
    cycle: int,
    all_measured: int,
    past: MutableVector,
    out_q: MutableVector,
    out_v: MutableVector,
) -> None:
    """Position and velocity with the noise of ``cycle``: unit normal numbers times sigma.

    The velocity is NaN where it is not measured. ``past`` is a ring of motions, 2 n numbers each,
    for sensors that are late, or empty.
    """
    n = len(out_q)
    at = 2 * n * cycle
    length = len(past)
    now = at % length if length > 0 else 0
    then = (at + 2 * n) % length if length > 0 else 0
    for i in range(n):
        out_q[i], out_v[i] = state[i], state[n + i]
        if length > 0:
            past[now + i], past[now + n + i] = state[i], state[n + i]
            out_q[i], out_v[i] = past[then + i], past[then + n + i]
        if len(table) > 0:
            out_q[i] += sigma_q * table[at + i]
            out_v[i] += sigma_v * table[at + n + i]
        if not all_measured:
            out_v[i] = math.nan


@helper
def integrate(
    response: Callable[..., None],
    force: Callable[..., float],
    coefficients: Vector,
    disturbance: Vector,
    friction: MutableVector,
    hit: int,
    order: int,
    substeps: int,
    h: float,
    t: float,
    acceleration_limit: float,
    position_limit: Vector,
    effort: Vector,
    state: MutableVector,
    acting: MutableVector,
    q: MutableVector,
    v: MutableVector,
    a: MutableVector,
) -> int:
    """Explicit Euler steps of h [s] with the effort held; 0, or what is wrong (``CODE``).

    ``state``: q, v and the effort that acted last; it stays as it is where something is wrong.
    ``friction`` is the state of the disturbance. acting, q, v, a: work vectors.
    """
    n = len(q)
    for i in range(n):
        q[i], v[i] = state[i], state[n + i]
        if not math.isfinite(effort[i]):
            return EFFORT * CODE + i
    for step in range(substeps):
        for i in range(n):
            acting[i] = effort[i]
        acting[hit] += force(disturbance, friction, t + step * h, h, q[hit], v[hit])
        response(coefficients, q, v, acting, a)
        for i in range(n):
            if not abs(a[i]) <= acceleration_limit:
                return RESPONSE * CODE + i
            if order == 2:
                q[i] += h * v[i]
                v[i] += h * a[i]
            elif order == 1:
                q[i] += h * a[i]
                v[i] = a[i]
            else:
                q[i] = a[i]
            if not abs(q[i]) <= position_limit[i]:
                return POSITION * CODE + i
    for i in range(n):
        state[i], state[n + i], state[2 * n + i] = q[i], v[i], effort[i]
    return GOOD


class PlantSimulator(Stage):
    """The exact plant, integrated by explicit Euler with the force held over the cycle.

    State: q, v and the effort that acted last, n each; that of the disturbance; with late sensors
    the motions of the last cycles.
    """

    name = "plant_simulator"
    output = JOINT_STATES

    @classmethod
    def parameters(cls, given: Values) -> tuple[Parameter, ...]:
        """Those of the simulator, and ``exact.NAME`` for each one of the plant's."""
        plant = given.get("plant")
        if not isinstance(plant, str):
            return STRUCTURE
        kind = str(given.get("disturbance.kind", "none"))
        return (
            *STRUCTURE,
            *prefixed("disturbance", registry.disturbance(kind).parameters),
            *prefixed("exact", registry.plant(plant).parameters),
        )

    @property
    def inputs(self) -> tuple[Input, ...]:
        """The command of the cycle."""
        return (Input(COMMAND),)

    def _prepare(self) -> None:
        values = self.values
        self.plant = plant = registry.plant(word(values, "plant"))
        n = len(plant.coordinates)
        self.coefficients = list(plant.coefficients(group(values, "exact", plant.parameters)))
        self.dt = number(values, "dt")
        self.cycle_time = round(self.dt * SECOND)
        if self.cycle_time / SECOND != self.dt:
            raise BadInput(f"{self.name}.dt: {self.dt!r} s is not a whole number of nanoseconds")
        self.cycles = round(number(values, "duration") / self.dt)
        if self.cycles < 1:
            raise BadInput(f"{self.name}.duration is shorter than one cycle of {self.dt:g} s")
        self.substeps = integer(values, "substeps")
        self.step_time = self.dt / self.substeps
        self.disturbance = registry.disturbance(word(values, "disturbance.kind"))
        seed = integer(values, "seed")
        self.disturbance_constants = list(self.disturbance.prepare(values, seed, self.cycles))
        where = word(values, "disturbance.coordinate") or plant.coordinates[0]
        self.hit = self._position_of(where, "disturbance.coordinate")
        self.acceleration_limit = number(values, "limit.acceleration")
        self.position_limit = self._vector("limit.position", n, math.inf)
        self.sigma = number(values, "noise.position"), number(values, "noise.velocity")
        self.all_measured = word(values, "measured") == "all"
        self._table: Vector | None = None
        self.timeout = round(number(values, "command_timeout") * SECOND)
        if not self.state:
            start = self._vector("initial_position", n, 0.0)
            start += self._vector("initial_velocity", n, 0.0)
            self.state.extend(start + [0.0] * (n + self.disturbance.state))
            late = integer(values, "measurement_delay")
            self.state.extend(start * (late + 1) if late else [])

    @property
    def coordinates(self) -> Names:
        """Names of the coordinates."""
        return self.plant.coordinates

    def _position_of(self, coordinate: str, parameter: str) -> int:
        names = self.plant.coordinates
        if coordinate not in names:
            raise BadInput(
                f"{self.name}.{parameter}: no coordinate '{coordinate}', only {', '.join(names)}"
            )
        return names.index(coordinate)

    def _vector(self, name: str, n: int, default: float) -> list[float]:
        given = numbers(self.values, name)
        if given and len(given) != n:
            names = ", ".join(self.plant.coordinates)
            raise BadInput(f"{self.name}.{name}: {len(given)} numbers given, {n} needed ({names})")
        return given or [default] * n

    def memory(self) -> tuple[MutableVector, ...]:
        """The state in its parts: of the plant, of the disturbance, and the motions of the past."""
        split = 3 * len(self.coordinates)
        return self._divide(split, split + self.disturbance.state)

    def noise(self) -> Vector:
        """Unit normal numbers: for each cycle n for the positions, then n for the velocities.

        Empty without noise.
        """
        if self._table is None:
            if self.sigma == (0.0, 0.0):
                return ()
            import numpy as np

            generator = np.random.default_rng(integer(self.values, "seed"))
            size = self.cycles * 2 * len(self.coordinates)
            self._table = array("d", generator.standard_normal(size).tobytes())
        return self._table

    def measure(self, stamp: int, cycle: int) -> JointStates:
        """Step 1: what is measured at ``stamp`` [ns], the noise of ``cycle`` added."""
        n = len(self.coordinates)
        q, v = [0.0] * n, [0.0] * n
        noise, everything = self.noise(), int(self.all_measured)
        plant, _, past = self.memory()
        measure(plant, *self.sigma, noise, cycle % self.cycles, everything, past, q, v)
        return JointStates(stamp, self.coordinates, q, v, self.state[2 * n : 3 * n])

    def safe_command(self, stamp: int) -> Command:
        """What acts when no command is young enough."""
        n = len(self.plant.coordinates)
        effort = [number(self.values, "safe_effort")] * n
        return Command(stamp, self.plant.coordinates, [math.nan] * n, effort)

    def advance(self, command: Command, stamp: int) -> None:
        """Step 6: apply the effort over [t_k, t_{k+1}), t_k = ``stamp`` [ns].

        Raises:
            Diverged: an acceleration or a position is not finite or beyond its limit.
        """
        n, t = len(self.coordinates), stamp / SECOND
        plant, friction, _ = self.memory()
        acting, q, v, a = [0.0] * n, [0.0] * n, [0.0] * n, [0.0] * n
        try:
            status = integrate(
                self.plant.response,
                self.disturbance.force,
                self.coefficients,
                self.disturbance_constants,
                friction,
                self.hit,
                self.plant.order,
                self.substeps,
                self.step_time,
                t,
                self.acceleration_limit,
                self.position_limit,
                command.effort,
                plant,
                acting,
                q,
                v,
                a,
            )
        except (ArithmeticError, ValueError) as error:
            remedy, cycle = self._trouble(q) or str(error), stamp // self.cycle_time
            name = self.coordinates[0]
            raise Diverged(t, name, "response", math.nan, remedy=remedy, cycle=cycle) from error
        if status == GOOD:
            return
        code, at = divmod(status, CODE)
        what = {
            EFFORT: ("effort", command.effort[at], math.inf),
            RESPONSE: ("acceleration", a[at], self.acceleration_limit),
            POSITION: ("position", q[at], self.position_limit[at]),
        }[code]
        cycle, remedy = stamp // self.cycle_time, self._trouble(q)
        raise Diverged(t, self.coordinates[at], *what, remedy=remedy or LOST, cycle=cycle)

    def _trouble(self, q: Vector) -> str:
        plant = self.plant
        return plant.trouble(self.coefficients, q) if plant.trouble is not None else ""
