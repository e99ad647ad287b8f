"""Comparing two kept runs to the last bit."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Arrays = Mapping[str, NDArray[Any]]


def read(path: Path) -> dict[str, NDArray[Any]]:
    """A file of ``dumper.py``."""
    with np.load(path) as file:
        return {key: file[key] for key in file.files}


def cycles(arrays: Arrays) -> int:
    """Number of cycles of a run."""
    found = [len(array) for key, array in arrays.items() if key.endswith("/stamps")]
    return max(found, default=0)


def unequal(old: NDArray[Any], new: NDArray[Any]) -> NDArray[np.bool_]:
    """Where two arrays of one shape differ: NaN is NaN whatever its payload, -0.0 is not 0.0."""
    if old.dtype != np.float64:
        return np.asarray(old != new)
    a, b = (np.ascontiguousarray(each).view(np.uint64) for each in (old, new))
    return np.asarray((a != b) & ~(np.isnan(old) & np.isnan(new)))


def differences(old: Arrays, new: Arrays) -> Iterator[str]:
    """How the topics and the end of two runs differ, a line each, the earliest cycle first."""
    for who, arrays in (("old", old), ("new", new)):
        if "refused" in arrays:
            yield f"the {who} tree cannot run it: {arrays['refused']}"
            return
    found: list[tuple[int, str]] = []
    keys = [key for key in (*old, *(k for k in new if k not in old)) if key.startswith("topic/")]
    for key in keys:
        _, topic, field = key.split("/")
        if key not in old or key not in new:
            found.append((-1, f"{topic} {field}: only in the {'old' if key in old else 'new'}"))
        else:
            names = old[f"topic/{topic}/names"].tolist()
            found += _of_field(f"{topic} {field}", old[key], new[key], names)
    if str(old["ended"]) != str(new["ended"]):
        ends = (str(each["ended"]) or "complete" for each in (old, new))
        found.append((-1, "ended: old {}, new {}".format(*ends)))
    yield from (line for _, line in sorted(found, key=lambda each: each[0]))


def _of_field(
    what: str, old: NDArray[Any], new: NDArray[Any], names: list[str]
) -> Iterator[tuple[int, str]]:
    """The first cycle at which a field differs, and how."""
    if old.shape[1:] != new.shape[1:] or (what.endswith(" names") and old.shape != new.shape):
        yield -1, f"{what}: old {_shape(old)}, new {_shape(new)}"
        return
    if len(old) != len(new):
        yield min(len(old), len(new)), f"{what}: old has {len(old)} cycles, new {len(new)}"
    common = min(len(old), len(new))
    wrong = np.argwhere(unequal(old[:common], new[:common]))
    if wrong.size:
        at = tuple(int(i) for i in wrong[0])
        column = f" {names[at[1]]}" if len(at) > 1 else ""
        a, b = (_shown(each[at]) for each in (old, new))
        where = f"column {at[0]}" if what.endswith(" names") else f"cycle {at[0]}"
        yield at[0], f"{what}{column}: {where}, old {a}, new {b} ({len(wrong)} differ)"


def state_differences(old: Arrays, new: Arrays) -> Iterator[str]:
    """How final states differ that have the same size in both."""
    for key in _states(old, new):
        if key in old and key in new and len(old[key]) == len(new[key]):
            wrong = np.flatnonzero(unequal(old[key], new[key]))
            if wrong.size:
                a, b = (_shown(each[key][wrong[0]]) for each in (old, new))
                name = key.removeprefix("state/")
                yield f"final state of {name}[{wrong[0]}]: old {a}, new {b} ({len(wrong)} differ)"


def relaid(old: Arrays, new: Arrays) -> Iterator[tuple[str, str]]:
    """Stage and sizes of the states that have another size, and cannot be compared."""
    for key in _states(old, new):
        sizes = [str(len(each[key])) if key in each else "none" for each in (old, new)]
        if sizes[0] != sizes[1]:
            yield key.removeprefix("state/"), f"{sizes[0]} -> {sizes[1]} numbers"


def _states(old: Arrays, new: Arrays) -> list[str]:
    return [key for key in dict.fromkeys((*old, *new)) if key.startswith("state/")]


def _shape(array: NDArray[Any]) -> str:
    return str(array.tolist()) if array.dtype.kind == "U" else f"{array.shape}"


def _shown(value: Any) -> str:
    """A number by its shortest decimals that tell its bits."""
    return repr(value.item()) if hasattr(value, "item") else repr(value)
