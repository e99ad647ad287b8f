"""Numbers of a run by the names that ``--metric`` and ``--limit`` have for them."""

from collections.abc import Mapping, Sequence
from typing import cast

from fpt_ros.cycle.stages import Loop
from fpt_ros.errors import BadInput

_TRACKING = ("rms_settled", "max_settled", "rms", "max")
_EFFORT = {"effort": "rms", "effort_max": "max"}
_FINAL = "final."
_WHOLE = "whole."


def metric(result: Mapping[str, object], name: str) -> float | None:
    """One number of a summary by the name that ``--metric`` has for it."""
    if name == "chatter":
        return cast("float | None", result["chatter"])
    if name.startswith(_WHOLE):  # over all coordinates: fpt compare
        whole = cast("Mapping[str, float | None]", result["whole"])
        return whole[name.removeprefix(_WHOLE)]
    kind, _, of = name.partition(".")
    if name.startswith(_FINAL):
        return cast("Mapping[str, float | None]", result["final_parameters"]).get(of)
    part, key = ("effort", _EFFORT[kind]) if kind in _EFFORT else ("tracking", kind)
    return cast("Mapping[str, Mapping[str, float | None]]", result[part]).get(of, {}).get(key)


def metrics_of(loop: Loop, wanted: Sequence[str] = ()) -> tuple[str, ...]:
    """Names of the numbers that a run has; ``rms_settled`` alone stands for all coordinates.

    Raises:
        BadInput: a run has no such number.
    """
    controlled, plant = loop.trajectory.controlled, loop.plant.coordinates
    known = [f"{kind}.{name}" for name in controlled for kind in _TRACKING]
    known += [f"{kind}.{name}" for name in plant for kind in _EFFORT]
    known.append("chatter")
    final = [_FINAL + name for name in _final(loop)]
    found: list[str] = []
    for name in wanted:
        group = [each for each in known if each.startswith(name + ".")]
        if name not in known and name not in final and not group:
            hint = f", {_FINAL}{{{','.join(_final(loop))}}}" if final else ""
            raise BadInput(f"there is no metric '{name}': there are {', '.join(known)}{hint}")
        found += group or [name]
    return tuple(dict.fromkeys(found)) if wanted else tuple(known)


def _final(loop: Loop) -> tuple[str, ...]:
    names = loop.deformer.model.coefficient_names
    return tuple(dict.fromkeys((*names, *(loop.tuner.published if loop.tuner.active else ()))))
