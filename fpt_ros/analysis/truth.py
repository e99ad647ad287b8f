"""The motion that the plant really made, where the sensors have spoilt what is recorded of it.

Noise can be subtracted again; lost and rounded samples cannot. But a recording holds the efforts
and all parameters, so the plant is run once more under the same efforts: the same bits.
"""

from collections.abc import Sequence

import numpy as np

from fpt_ros.bags import begun_again
from fpt_ros.cycle.plant_simulator import PlantSimulator
from fpt_ros.cycle.suffered import SENSORS
from fpt_ros.errors import Diverged
from fpt_ros.messages.frames import Command
from fpt_ros.runs.chunks import Chunk
from fpt_ros.runs.run import Array, Run


class Truth:
    """Runs the plant of a recording again, chunk by chunk from its first cycle on."""

    def __init__(self, plant: PlantSimulator) -> None:
        self._plant = plant
        self._lost = False

    @classmethod
    def of(cls, about: Run) -> "Truth | None":
        """Of a run in lockstep whose sensors are disturbed; others need none.

        On the wall clock it is not told which cycle a late command has acted on; of a run that was
        reset the second one would have to begin in the middle.
        """
        values = about.parameters.get(PlantSimulator.name, {})
        if about.info.get(begun_again.TOPIC):
            return None
        if not values.get(SENSORS.name) or values.get("realtime"):
            return None
        return cls(PlantSimulator(values))

    def take(self, chunk: Chunk) -> dict[str, tuple[Array, Array]]:
        """Position and velocity of each coordinate at the stamps of ``joint_states``.

        NaN behind a cycle whose command is not there.
        """
        measured, command = chunk["joint_states"], chunk.get("command")
        plant, names = self._plant, self._plant.coordinates
        memory, n = plant.memory, len(names)
        found = np.full((2 * n, len(measured.stamps)), np.nan)
        rows = {} if command is None else {int(s): i for i, s in enumerate(command.stamps)}
        effort = None if command is None else command.vectors["effort"]
        for k, stamp in enumerate(measured.stamps.tolist()):
            if self._lost:
                break
            for i in range(n):
                found[i, k], found[n + i, k] = memory.position[i], memory.velocity[i]
            at = rows.get(stamp)
            if at is None or effort is None or command is None:
                self._lost = True
                break
            self._advance(command.names, effort[at].tolist(), stamp)
        return {name: (found[i], found[n + i]) for i, name in enumerate(names)}

    def _advance(self, names: Sequence[str], effort: list[float], stamp: int) -> None:
        unknown = [float("nan")] * len(effort)
        try:
            self._plant.advance(Command(stamp, tuple(names), unknown, effort), stamp)
        except Diverged:
            self._lost = True
