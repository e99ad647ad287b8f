"""The signals of a run that figures and metrics share, matched by stamp.

A run may be cut anywhere, so topics can differ in length or be absent; everything here then gives
what is there, down to empty arrays.
"""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from fpt_ros.bags import units
from fpt_ros.errors import BadInput
from fpt_ros.messages.frames import SECOND
from fpt_ros.parameters import Value
from fpt_ros.plants import MODELS, Model, Plant, made
from fpt_ros.runs.run import Array, Run, Series

Stamps = NDArray[np.int64]
"""(N,) times of messages [ns]."""

CONTROLLER_ONLY = ("K_D",)
"""Parameters of models that no plant has: gains of a feedback of their own."""


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
    return first_stamp(run.topics)


def first_stamp(topics: Mapping[str, Series]) -> int:
    """First stamp of all topics [ns]."""
    return min((int(s.stamps[0]) for s in topics.values() if len(s.stamps)), default=0)


def seconds(run: Run, stamps: Stamps) -> Array:
    """(N,) stamps as times since the run's first stamp [s]."""
    return (stamps - origin(run)) / SECOND


def settled(run: Run, time: Array) -> NDArray[np.bool_]:
    """(N,) whether ``time`` [s] is settled, exact where both are whole nanoseconds."""
    return np.round(time * SECOND) >= round(settle_time(run) * SECOND)


def first_settled(run: Run, time: Array) -> int:
    """Index of the first of ascending times [s] that is settled; their number: none is."""
    return int(np.searchsorted(settled(run, time), True))


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


def realised_response(run: Run, coordinate: str) -> tuple[Array, Array]:
    """Times [s] and responses of the plant to r_k, (N-1,) each.

    The estimate of cycle k+1 holds the response to the command of cycle k: it is given at t_k, so
    that it lies beside the desired and the deformed response that caused it.
    """
    time, response = topic(run, "state_estimate", "accelerations", coordinate)
    return time[:-1], response[1:]


def plant_of(run: Run) -> Plant | None:
    """The run's plant; ``None`` where it is not installed here."""
    return units.plant_of(run.parameters)


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
