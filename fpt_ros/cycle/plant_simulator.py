"""Stage 1 and 6 of the cycle: the plant shows its state, and answers the force."""

import math

from fpt_ros.cycle.joints import Entrance
from fpt_ros.cycle.motion import (
    Fault,
    PlantConstants,
    PlantMemory,
    PlantWork,
    measure,
    move,
    not_advanced,
    not_integrated,
)
from fpt_ros.cycle.noise import Noise
from fpt_ros.cycle.records import Layout
from fpt_ros.cycle.rows import JointStatesRow
from fpt_ros.cycle.stage import AUTOSTART, REALTIME, Input, Stage
from fpt_ros.cycle.suffered import SUFFERED, Suffered
from fpt_ros.disturbances import DISTURBANCES
from fpt_ros.errors import BadInput, Diverged
from fpt_ros.integrators import INTEGRATORS, Integrate
from fpt_ros.laws import Vector
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
from fpt_ros.plants import PLANTS, Advance, made

EULER = "explicit_euler"

INTEGRATOR = Parameter(
    "integrator.kind", "how the plant is integrated, by its registered name", EULER, live=False
)

STRUCTURE = (
    Parameter("plant", "exact dynamics, by its registered name", kind="str", live=False),
    Parameter("dt", "control cycle, whole nanoseconds", unit="s", above=0.0, live=False),
    Parameter("duration", "length of the run", unit="s", above=0.0, live=False),
    Parameter("seed", "random seed of the measurement noise", 0, minimum=0, live=False),
    INTEGRATOR,
    Parameter("substeps", "integration steps in a cycle", 1, minimum=1, maximum=1000, live=False),
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
    *SUFFERED,
    Parameter("limit.acceleration", "beyond it the run has diverged", 1e9, above=0.0, live=False),
    Parameter("limit.position", "one per coordinate; empty: none", [], above=0.0, live=False),
    Parameter("safe_effort", "what acts when the command is too old", 0.0),
    Parameter("command_timeout", "age at which a command is too old", 0.1, unit="s", above=0.0),
    Parameter("speed", "of the clock in real time", 1.0, above=0.0),
    Parameter("step_cycles", "how long the service step goes on", 1, minimum=1, maximum=1_000_000),
    REALTIME,
    AUTOSTART,
    Parameter("await_recorder", "do not outrun the recorder", False, live=False),
)

LOST = "control is lost: fpt gain shows which fpt_deformer.A converges, and of which sign"
"""The remedy where nothing better is known."""


class PlantSimulator(Stage):
    """The exact plant, with the force held over the cycle. State: :class:`PlantMemory`.

    A plant that gives its response is integrated; others integrate themselves.
    """

    name = "plant_simulator"
    output = JOINT_STATES
    memory: PlantMemory
    constants: PlantConstants

    @classmethod
    def parameters(cls, given: Values) -> tuple[Parameter, ...]:
        """Those of the simulator, and ``exact.NAME`` for each one of the plant's."""
        plant = given.get("plant")
        if not isinstance(plant, str):
            return STRUCTURE
        kind = str(given.get("disturbance.kind", "none"))
        integrator = str(given.get(INTEGRATOR.name, EULER))
        return (
            *STRUCTURE,
            *prefixed("integrator", INTEGRATORS[integrator].parameters),
            *prefixed("disturbance", DISTURBANCES[kind].parameters),
            *Suffered.parameters(given),
            *prefixed("exact", PLANTS[plant].parameters),
        )

    @property
    def inputs(self) -> tuple[Input, ...]:
        """The command of the cycle."""
        return (Input(COMMAND),)

    def _prepare(self) -> None:
        values = self.values
        self.plant = plant = made(PLANTS[word(values, "plant")], values, "exact")
        n = len(plant.coordinates)
        self.coefficients = list(plant.coefficients(group(values, "exact", plant.parameters)))
        self.dt = number(values, "dt")
        self.cycle_time = round(self.dt * SECOND)
        if self.cycle_time / SECOND != self.dt:
            raise BadInput(f"{self.name}.dt: {self.dt!r} s is not a whole number of nanoseconds")
        self.cycles = round(number(values, "duration") / self.dt)
        if self.cycles < 1:
            raise BadInput(f"{self.name}.duration is shorter than one cycle of {self.dt:g} s")
        substeps, seed = integer(values, "substeps"), integer(values, "seed")
        self.disturbance = DISTURBANCES[word(values, "disturbance.kind")]
        where = word(values, "disturbance.coordinate") or plant.coordinates[0]
        late = integer(values, "measurement_delay")
        self.integrator = INTEGRATORS[word(values, INTEGRATOR.name)]
        self.suffered = suffered = Suffered(values, plant.coordinates, seed)
        self.spoil = suffered.spoil
        self.constants = PlantConstants(
            coefficients=self.coefficients,
            disturbance=list(self.disturbance.prepare(values, seed, self.cycles)),
            position_limit=self._vector("limit.position", n, math.inf),
            acceleration_limit=number(values, "limit.acceleration"),
            sigma_q=number(values, "noise.position"),
            sigma_v=number(values, "noise.velocity"),
            h=self.dt / substeps,
            substeps=substeps,
            order=plant.order,
            disturbed=self._position_of(where, "disturbance.coordinate"),
            velocity_measured=int(word(values, "measured") == "all"),
            late=late,
            dt=self.dt,
            integrator=list(self.integrator.prepare(values)),
            sensors=suffered.sensor_constants,
            sensors_at=suffered.sensors_at,
            actuators=suffered.actuator_constants,
            actuators_at=suffered.actuators_at,
            by_itself=int(plant.advance is not None),
        )
        if plant.set_step is not None:
            plant.set_step(self.constants.h)
        self.timeout = round(number(values, "command_timeout") * SECOND)
        self.laws = (suffered.spoil, self.disturbance.force, *self._laws())
        self.noise = Noise(seed, 2 * n)
        self._commanded = Entrance(f"{self.name}, command", plant.coordinates)
        self.entrances = {COMMAND.name: self._commanded}
        layout = Layout(
            PlantMemory,
            position=n,
            velocity=n,
            effort=n,
            disturbance=self.disturbance.state,
            own=plant.state,
            past=(late + 1 if late else 0, 2 * n),
            sensors=suffered.sensor_states,
            actuators=suffered.actuator_states,
        )
        self.memory, fresh = self._remember(layout)
        q, v, driven, acting, external, response = ([0.0] * n for _ in range(6))
        stages = [0.0] * (self.integrator.vectors * n)
        self.work = PlantWork(q, v, driven, acting, external, response, [0.0], stages)
        if fresh:
            self._start(n, late)
            suffered.start(self.memory)

    def _start(self, n: int, late: int) -> None:
        """The initial motion, in the past as well."""
        memory = self.memory
        start = self._vector("initial_position", n, 0.0)
        start += self._vector("initial_velocity", n, 0.0)
        for i in range(n):
            memory.position[i], memory.velocity[i] = start[i], start[n + i]
        for turn in range(late + 1 if late else 0):
            for i, x in enumerate(start):
                memory.past[turn, i] = x
        if self.plant.start is not None:
            self.plant.start(self.coefficients, memory.own, start[:n], start[n:])

    def _laws(self) -> tuple[Integrate, Advance]:
        """How the plant is integrated, and how it integrates itself; one of them does nothing."""
        name, kind = word(self.values, "plant"), word(self.values, INTEGRATOR.name)
        if self.plant.advance is not None:
            if kind != EULER:
                raise BadInput(
                    f"{self.name}.{INTEGRATOR.name}: {kind} given, but the plant {name} integrates "
                    "itself: leave it out"
                )
            return not_integrated, self.plant.advance
        if self.plant.response is None:
            raise BadInput(f"{self.name}.plant: {name} has neither a response nor advance")
        return self.integrator.over(self.plant.response), not_advanced

    @property
    def coordinates(self) -> Names:
        """Names of the coordinates."""
        return self.plant.coordinates

    @property
    def noisy(self) -> bool:
        """Whether the measurements have noise."""
        return (self.constants.sigma_q, self.constants.sigma_v) != (0.0, 0.0)

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

    def measure(self, stamp: int, cycle: int) -> JointStates:
        """Step 1: what is measured at ``stamp`` [ns], the noise of ``cycle`` added."""
        n = len(self.coordinates)
        out = JointStatesRow([0.0] * n, [0.0] * n, [0.0] * n)
        noise: Vector = self.noise.of(cycle) if self.noisy else ()
        measure(self.spoil, self.constants, self.memory, cycle, noise, out)
        return JointStates(stamp, self.coordinates, *out)

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
        t, work, effort = stamp / SECOND, self.work, self._commanded.take(command).effort
        try:
            fault = move(*self.laws, self.constants, self.memory, work, t, effort)
        except (ArithmeticError, ValueError) as error:
            remedy, cycle = self._trouble(work.position) or str(error), stamp // self.cycle_time
            name = self.coordinates[0]
            raise Diverged(t, name, "response", math.nan, remedy=remedy, cycle=cycle) from error
        if fault == Fault.NONE:
            return
        at = int(work.place[0])
        what = {
            Fault.EFFORT: ("effort", effort[at], math.inf),
            Fault.RESPONSE: (
                "acceleration",
                work.response[at],
                self.constants.acceleration_limit,
            ),
            Fault.POSITION: ("position", work.position[at], self.constants.position_limit[at]),
        }[Fault(fault)]
        cycle, remedy = stamp // self.cycle_time, self._trouble(work.position)
        raise Diverged(t, self.coordinates[at], *what, remedy=remedy or LOST, cycle=cycle)

    def _trouble(self, q: Vector) -> str:
        plant = self.plant
        return plant.trouble(self.coefficients, q) if plant.trouble is not None else ""
