"""The signals of a run that figures and metrics share, matched by stamp.

A run may be cut anywhere, so topics can differ in length or be absent; everything here then gives
what is there, down to empty arrays.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fpt_ros.cycle.plant_simulator import PlantSimulator
from fpt_ros.cycle.trajectory_generator import TrajectoryGenerator
from fpt_ros.errors import BadInput
from fpt_ros.experiments.nominal import sample
from fpt_ros.messages.frames import SECOND
from fpt_ros.parameters import Value
from fpt_ros.plants import MODELS, PLANTS, Model, Plant, made
from fpt_ros.runs.run import Array, Run

Stamps = NDArray[np.int64]
"""(N,) times of messages [ns]."""

CONTROLLER_ONLY = ("K_D",)
"""Parameters of models that no plant has: gains of a feedback of their own."""


@dataclass(frozen=True)
class Motion:
    """Nominal and realised motion of one controlled coordinate, (N,) each.

    Noise and delay that the simulator has put into the measurement are taken out again.

    Attributes:
        time: since the run's first stamp [s].
        nominal, position: in the plant's unit.
        nominal_velocity, velocity: in the plant's unit per second.
    """

    time: Array
    nominal: Array
    position: Array
    nominal_velocity: Array
    velocity: Array

    @property
    def error(self) -> Array:
        """Tracking error, nominal minus realised; with time sharing, in all turns."""
        return self.nominal - self.position


def parameter(run: Run, node: str, name: str) -> Value | None:
    """A node's parameter; ``None`` where the run does not hold it."""
    return run.parameters.get(node, {}).get(name)


def parameter_number(run: Run, node: str, name: str) -> float | None:
    """A node's parameter as a number; ``None`` where it is absent or none."""
    value = parameter(run, node, name)
    return None if isinstance(value, bool) or not isinstance(value, int | float) else float(value)


def settle_time(run: Run) -> float:
    """From here on the settled error counts [s since the first stamp]."""
    return parameter_number(run, "recorder", "settle_time") or 0.0


def adaptive(run: Run) -> bool:
    """Whether anything adapts: a transformation that deforms, or a tuner in the loop."""
    deforms = parameter(run, "fpt_deformer", "transformation") not in (None, "none")
    return deforms or parameter(run, "parameter_tuner", "method") not in (None, "none")


def origin(run: Run) -> int:
    """First stamp of the run [ns]."""
    stamps = [int(series.stamps[0]) for series in run.topics.values() if len(series.stamps)]
    return min(stamps, default=0)


def seconds(run: Run, stamps: Stamps) -> Array:
    """(N,) stamps as times since the run's first stamp [s]."""
    return (stamps - origin(run)) / SECOND


def settled(run: Run, time: Array) -> NDArray[np.bool_]:
    """(N,) whether ``time`` [s] is settled, exact where both are whole nanoseconds."""
    return np.round(time * SECOND) >= round(settle_time(run) * SECOND)


def controlled(run: Run) -> tuple[str, ...]:
    """Coordinates that are controlled at some time, in the order of ``desired``."""
    return run.topics["desired"].names if "desired" in run.topics else ()


def uncontrolled(run: Run) -> tuple[str, ...]:
    """Coordinates that are measured and never controlled."""
    names = run.topics["joint_states"].names if "joint_states" in run.topics else ()
    return tuple(name for name in names if name not in controlled(run))


def topic(run: Run, name: str, vector: str, column: str) -> tuple[Array, Array]:
    """Times [s] and numbers of one column of a topic, (N,) each; empty where it is absent."""
    series = run.topics.get(name)
    if series is None or column not in series.names:
        return np.empty(0), np.empty(0)
    return seconds(run, series.stamps), series.column(vector, column)


def motion(run: Run, coordinate: str) -> Motion:
    """Nominal and realised motion of a coordinate at the stamps that have both."""
    desired, measured = run.topics.get("desired"), run.topics.get("joint_states")
    if desired is None or measured is None:
        return Motion(*[np.empty(0)] * 5)
    if coordinate not in desired.names or coordinate not in measured.names:
        return Motion(*[np.empty(0)] * 5)
    stamps, i, j = _common(desired.stamps, measured.stamps)
    position = measured.column("position", coordinate)[j] - _noise(run, coordinate, stamps)
    velocity = measured.column("velocity", coordinate)[j]
    if np.isnan(velocity).all():  # not measured: what the denoiser makes of it
        velocity = _estimated_velocity(run, coordinate, stamps)
    nominal = desired.column("positions", coordinate)[i]
    nominal_velocity = desired.column("velocities", coordinate)[i]
    time = seconds(run, stamps)
    away = np.isnan(nominal)
    if parameter(run, "trajectory_generator", "time_sharing") and away.any():
        nominal, nominal_velocity = nominal.copy(), nominal_velocity.copy()
        nominal[away], nominal_velocity[away] = _nominal(run, coordinate, time[away])
    late = int(parameter_number(run, "plant_simulator", "measurement_delay") or 0)
    count = max(len(time) - late, 0)  # what was measured late belongs to an earlier cycle
    return Motion(
        time[:count],
        nominal[:count],
        position[late:],
        nominal_velocity[:count],
        velocity[late:],
    )


Where = NDArray[np.intp] | slice
"""Some entries of an array."""


def _common(a: Stamps, b: Stamps) -> tuple[Stamps, Where, Where]:
    """Stamps that are in both, ascending, and where they are; mostly both have all of them."""
    if len(a) == len(b) and bool((a == b).all()) and bool((a[1:] > a[:-1]).all()):
        return a, slice(None), slice(None)
    stamps, i, j = np.intersect1d(a, b, return_indices=True)
    return stamps, i, j


def _noise(run: Run, coordinate: str, stamps: Stamps) -> Array | float:
    """The noise that the simulator added to the position: errors are those of the plant itself."""
    if not parameter_number(run, PlantSimulator.name, "noise.position"):
        return 0.0
    plant = PlantSimulator(run.parameters[PlantSimulator.name])
    n, at = len(plant.coordinates), plant.coordinates.index(coordinate)
    table = np.empty((plant.cycles, 2 * n))
    plant.noise.rows(0, table)
    noise: Array = plant.constants.sigma_q * table[(stamps - origin(run)) // plant.cycle_time, at]
    return noise


def _estimated_velocity(run: Run, coordinate: str, stamps: Stamps) -> Array:
    estimate = run.topics.get("state_estimate")
    if estimate is None:
        return np.full(len(stamps), np.nan)
    _, i, j = _common(stamps, estimate.stamps)
    found = np.full(len(stamps), np.nan)
    found[i] = estimate.column("velocities", coordinate)[j]
    return found


def _nominal(run: Run, coordinate: str, time: Array) -> tuple[Array, Array]:
    """Nominal position and velocity while it is another coordinate's turn to be controlled."""
    stage = TrajectoryGenerator(run.parameters[TrajectoryGenerator.name])
    at = stage.controlled.index(coordinate)
    motions = sample(stage, time.tolist())
    return np.array([m[0][at] for m in motions]), np.array([m[1][at] for m in motions])


def realised_response(run: Run, coordinate: str) -> tuple[Array, Array]:
    """Times [s] and responses of the plant to r_k, (N-1,) each.

    The estimate of cycle k+1 holds the response to the command of cycle k: it is given at t_k, so
    that it lies beside the desired and the deformed response that caused it.
    """
    time, response = topic(run, "state_estimate", "accelerations", coordinate)
    return time[:-1], response[1:]


def period(motions: Iterable[Motion]) -> float | None:
    """Longest period of the nominal motions [s], from where they cross their middle.

    ``None`` where none of them crosses it twice.
    """
    found = []
    for one in motions:
        known = np.isfinite(one.nominal)
        time, nominal = one.time[known], one.nominal[known]
        if len(nominal) < 3 or np.ptp(nominal) == 0.0:
            continue
        above = nominal > (nominal.max() + nominal.min()) / 2
        crossings = time[1:][above[1:] != above[:-1]]
        if len(crossings) >= 2:
            found.append(2.0 * float(np.mean(np.diff(crossings))))
    return max(found, default=None)


def plant_of(run: Run) -> Plant | None:
    """The run's plant; ``None`` where it is not installed here."""
    try:
        plant = PLANTS[str(parameter(run, "plant_simulator", "plant"))]
        return made(plant, run.parameters.get("plant_simulator", {}), "exact")
    except (BadInput, KeyError):
        return None


def unit(run: Run, coordinate: str) -> str:
    """Unit of a coordinate's position; empty where it has none or is not known."""
    plant = plant_of(run)
    if plant is None or coordinate not in plant.coordinates:
        return ""
    return plant.units[plant.coordinates.index(coordinate)]


def effort_unit(run: Run, coordinate: str) -> str:
    """Unit of a coordinate's effort; empty where it has none or is not known."""
    plant = plant_of(run)
    if plant is None or coordinate not in plant.coordinates:
        return ""
    return plant.effort_units[plant.coordinates.index(coordinate)]


def model_of(run: Run) -> Model | None:
    """The run's approximate model; ``None`` where it is not installed here."""
    try:
        model = MODELS[str(parameter(run, "fpt_deformer", "model"))]
        return made(model, run.parameters.get("fpt_deformer", {}), "approximate")
    except (BadInput, KeyError):
        return None


def coefficient_names(run: Run) -> set[str]:
    """Names of the model's coefficients; empty where the model is not installed here."""
    model = model_of(run)
    return set() if model is None else set(model.coefficient_names)


def exact_coefficients(run: Run) -> dict[str, float]:
    """The model's coefficients as they would be with the plant's exact parameters, by name.

    Empty where the model has parameters that the plant does not know (an affine model, say): then
    there are no exact values.
    """
    model = model_of(run)
    if model is None:
        return {}
    values = []
    for p in model.parameters:
        exact = parameter_number(run, "plant_simulator", f"exact.{p.name}")
        if exact is None and p.name not in CONTROLLER_ONLY:
            return {}
        own = parameter_number(run, "fpt_deformer", f"approximate.{p.name}")
        values.append((exact if exact is not None else own) or 0.0)
    coefficients = model.coefficients(values)
    return dict(zip(model.coefficient_names, coefficients, strict=False)) if values else {}
