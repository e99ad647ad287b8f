"""One registry for everything that has a name in a parameter file: Python entry points.

A plant, model, trajectory, disturbance, transformation, tuning law or filter is found by the name
under which a package (this one, or a user's own) lists it in the group ``fpt_ros.<kind>``.
"""

from functools import cache
from importlib.metadata import EntryPoint, entry_points
from typing import TYPE_CHECKING, cast

from fpt_ros.errors import BadInput
from fpt_ros.extras import remedy

if TYPE_CHECKING:
    from fpt_ros.denoising.offline import Method
    from fpt_ros.denoising.streaming import Filter
    from fpt_ros.disturbances import Disturbance
    from fpt_ros.plants import Model, Plant
    from fpt_ros.trajectories import Trajectory
    from fpt_ros.transformations import Transformation
    from fpt_ros.tuning import TuningLaw


_CALLED = {"tuning": "tuning laws"}
_NONE = {"transformations": ("none",), "tuning": ("none",)}
"""Kinds of which a stage can do without one: what it is then called."""


@cache
def _group(kind: str) -> dict[str, EntryPoint]:
    return {point.name: point for point in entry_points(group=f"fpt_ros.{kind}")}


def names(kind: str) -> tuple[str, ...]:
    """All registered names of a kind, sorted."""
    return tuple(sorted(_group(kind)))


@cache
def _load(kind: str, name: str) -> object:
    if name not in _group(kind):
        called = _CALLED.get(kind, kind)
        if not names(kind):
            raise BadInput(f"no {called} are registered: is fpt_ros installed? run make setup")
        valid = ", ".join((*_NONE.get(kind, ()), *names(kind)))
        raise BadInput(f"'{name}' is none of the {called}: {valid}")
    try:
        return _group(kind)[name].load()
    except (ImportError, AttributeError) as error:
        reason = remedy(error) or str(error)
        raise BadInput(
            f"'{name}' of the {_CALLED.get(kind, kind)} cannot be loaded: {reason}"
        ) from error


def plant(name: str) -> "Plant":
    """The exact dynamics registered as ``name``."""
    return cast("Plant", _load("plants", name))


def model(name: str) -> "Model":
    """The approximate model registered as ``name``."""
    return cast("Model", _load("models", name))


def trajectory(name: str) -> "Trajectory":
    """The nominal trajectory registered as ``name``."""
    return cast("Trajectory", _load("trajectories", name))


def disturbance(name: str) -> "Disturbance":
    """The disturbance registered as ``name``."""
    return cast("Disturbance", _load("disturbances", name))


def transformation(name: str) -> "Transformation":
    """The fixed point transformation registered as ``name``."""
    return cast("Transformation", _load("transformations", name))


def tuning_law(name: str) -> "TuningLaw":
    """The tuning law registered as ``name``."""
    return cast("TuningLaw", _load("tuning", name))


def streaming_filter(name: str) -> "Filter":
    """The causal filter registered as ``name``."""
    return cast("Filter", _load("filters", name))


def denoiser(name: str) -> "Method":
    """The denoiser of whole records registered as ``name``."""
    return cast("Method", _load("denoisers", name))
