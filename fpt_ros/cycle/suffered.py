"""What a plant's sensors and actuators suffer: the disturbances that its parameters name."""

from collections.abc import Mapping
from typing import Any

from fpt_ros.cycle.chains import driving, sensing, spoiling
from fpt_ros.cycle.motion import PlantMemory
from fpt_ros.cycle.records import ByRow
from fpt_ros.cycle.stage import indices
from fpt_ros.disturbances.actuators import ACTUATOR_DISTURBANCES, ActuatorDisturbance
from fpt_ros.disturbances.chance import seed_of
from fpt_ros.disturbances.sensors import SENSOR_DISTURBANCES, SensorDisturbance
from fpt_ros.errors import BadInput
from fpt_ros.laws import Matrix
from fpt_ros.messages.frames import Names
from fpt_ros.parameters import Parameter, Values, prefixed, words
from fpt_ros.registry import Kind

SENSORS = Parameter(
    "sensors.kinds",
    "what spoils the measurements, by registered names, one after the other; empty: nothing",
    [],
    kind="strings",
    live=False,
)
ACTUATORS = Parameter(
    "actuators.kinds",
    "what becomes of the efforts, by registered names, one after the other; empty: nothing",
    [],
    kind="strings",
    live=False,
)

SUFFERED = (
    SENSORS,
    Parameter("sensors.coordinates", "whose sensors; empty: all", [], kind="strings", live=False),
    ACTUATORS,
    Parameter(
        "actuators.coordinates", "whose actuators; empty: all", [], kind="strings", live=False
    ),
)

KINDS: Mapping[str, Kind[Any]] = {
    "sensors": SENSOR_DISTURBANCES,
    "actuators": ACTUATOR_DISTURBANCES,
}


class Suffered:
    """The disturbances of a plant's sensors and actuators.

    Attributes:
        sensors, actuators: by name, in their order; ``laws``: of all of them.
        spoil: all of them as one law.
        sensor_constants, actuator_constants: a row each.
        sensors_at, actuators_at: places of the coordinates that have them.
        sensor_states, actuator_states: rows and columns of what they remember.
    """

    def __init__(self, values: Values, coordinates: Names, seed: int) -> None:
        """Of checked parameters.

        Raises:
            BadInput: a coordinate that the plant does not have.
        """
        self.names = coordinates
        self.sensors: dict[str, SensorDisturbance] = _laws("sensors", values)
        self.actuators: dict[str, ActuatorDisturbance] = _laws("actuators", values)
        n = len(coordinates)
        spoil = tuple(each.spoil for each in self.sensors.values())
        actuate = tuple(each.actuate for each in self.actuators.values())
        self.laws = (*spoil, *actuate)
        self.spoil = spoiling(sensing(spoil), driving(actuate))
        self.sensor_constants = _constants("sensors", self.sensors, values, seed)
        self.actuator_constants = _constants("actuators", self.actuators, values, seed)
        self.sensors_at = self._places("sensors", values)
        self.actuators_at = self._places("actuators", values)
        self.sensor_states = _size([each.state(n) for each in self.sensors.values()])
        self.actuator_states = _size([each.state(n) for each in self.actuators.values()])

    @staticmethod
    def parameters(given: Values) -> tuple[Parameter, ...]:
        """Those of the disturbances that are named, ``sensors.lost.probability`` for example."""
        found: list[Parameter] = []
        for where, kinds in KINDS.items():
            for name in _named(given, where):
                found += prefixed(f"{where}.{name}", kinds[name].parameters)
        return tuple(found)

    def start(self, memory: PlantMemory) -> None:
        """Set what they remember for the initial motion."""
        for at, each in enumerate(self.sensors.values()):
            if each.start is not None:
                each.start(memory.sensors[at], memory.position, memory.velocity)

    def _places(self, where: str, values: Values) -> tuple[int, ...]:
        wanted = words(values, f"{where}.coordinates") or self.names
        return indices(wanted, self.names, f"plant_simulator.{where}.coordinates")


def _named(given: Values, where: str) -> list[str]:
    """The names of a list as it is given, each once: it has not been checked yet."""
    names = given.get(f"{where}.kinds", [])
    return list(dict.fromkeys(map(str, names))) if isinstance(names, list | tuple) else []


def _laws(where: str, values: Values) -> dict[str, Any]:
    given = words(values, f"{where}.kinds")
    for name in given:
        if given.count(name) > 1:
            raise BadInput(f"plant_simulator.{where}.kinds: '{name}' is named twice")
    return {name: KINDS[where][name] for name in given}


def _constants(where: str, laws: Mapping[str, Any], values: Values, seed: int) -> Any:
    rows = []
    for at, (name, law) in enumerate(laws.items()):
        prefix = f"{where}.{name}."
        own = {p.name: values[prefix + p.name] for p in law.parameters}
        stream = at if where == "sensors" else 1000 + at
        rows.append(list(law.prepare(own, seed_of(seed, stream))))
    longest = max(map(len, rows), default=0)
    matrix: Matrix | list[list[float]] = [row + [0.0] * (longest - len(row)) for row in rows]
    return matrix


def _size(states: list[int]) -> ByRow:
    return ByRow(len(states), max([1, *states]) if states else 0)
