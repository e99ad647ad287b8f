"""Runs cases with the fpt_ros of one tree and keeps topics and final states; run by ``tree.py``.

``python dumper.py TREE FOLDER``, the cases as JSON on the standard input; a line for each that is
kept. The tree may be of any age: what differs between ages is in the adapters, and nowhere else.
"""

import json
import os
import sys
from collections.abc import Iterator
from importlib import import_module
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np

# An editable installation would find modules of its own tree that the tree asked for lacks.
sys.meta_path[:] = [each for each in sys.meta_path if "editable" not in f"{each}".lower()]

# --- adapters: the newest name first -----------------------------------------------------------

EXPERIMENT = ("fpt_ros.experiments.experiment", "fpt_ros.loop.experiment")
ENGINE = ("fpt_ros.engine.engine", "fpt_ros.loop.engine")


def module(names: tuple[str, ...]) -> Any:
    """The first of these modules that the tree has."""
    for name in names:
        try:
            return import_module(name)
        except ModuleNotFoundError as error:
            if error.name is None or not f"{name}.".startswith(f"{error.name}."):
                raise  # the module is there, and something else is not
    raise SystemExit(f"the tree has none of {', '.join(names)}: teach test/same_bits/dumper.py")


def load(case: dict[str, Any]) -> Any:
    """A fresh loop of a case."""
    arguments = case["experiment"], case["variant"], case["settings"]
    loaded = module(EXPERIMENT).load(*arguments)
    plant = loaded.nodes["plant_simulator"]
    if case["cycles"] is not None:
        wanted = max(case["cycles"] * plant["dt"], case["seconds"])
        duration = min(plant["duration"], wanted)
        loaded = loaded.with_values("plant_simulator", duration=duration)
    return loaded.loop()


def topics(engine: Any) -> Iterator[tuple[str, Any, tuple[str, ...], dict[str, Any]]]:
    """Topic, stamps, names of columns, and field -> (N, m)."""
    for topic, series in engine.topics().items():
        yield topic, series.stamps, series.names, series.vectors


def states(loop: Any) -> Iterator[tuple[str, Any]]:
    """What each stage remembers; its clock only if set, as the engine has no use for it."""
    for stage in loop.stages():
        yield stage.name, stage.state
        clock = getattr(stage, "clock", None)
        if clock is not None and clock[0] >= 0:
            yield f"{stage.name}.clock", clock


# -----------------------------------------------------------------------------------------------


def flat(thing: Any) -> list[float]:
    """The numbers of a state, whatever it is made of, in their order."""
    if isinstance(thing, dict):
        thing = tuple(thing.values())
    if isinstance(thing, tuple | list):
        return list(chain.from_iterable(map(flat, thing)))
    return [float(x) for x in np.ravel(np.asarray(thing))]


def run(case: dict[str, Any]) -> dict[str, Any]:
    """All arrays of one case; an error of the run is kept by the name of its class."""
    arrays: dict[str, Any] = {}
    loop = load(case)
    engine = module(ENGINE).Engine(loop)
    ended = ""
    try:
        engine.run()
    except Exception as error:  # how a run ends belongs to what is compared
        ended = type(error).__name__
    arrays["ended"] = np.array(ended)
    for topic, stamps, names, vectors in topics(engine):
        arrays[f"topic/{topic}/stamps"] = stamps
        arrays[f"topic/{topic}/names"] = np.array(names, dtype=str)
        for field, matrix in vectors.items():
            arrays[f"topic/{topic}/{field}"] = np.asarray(matrix, dtype=np.float64)
    for name, state in states(loop):
        arrays[f"state/{name}"] = np.array(flat(state), dtype=np.float64)
    return arrays


def main() -> None:
    """Keep all cases of the standard input in the folder."""
    tree, folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
    package = Path(str(import_module("fpt_ros").__file__)).resolve()
    if not package.is_relative_to(tree):
        raise SystemExit(f"imported {package}, which is not of the tree {tree}")
    for case in json.load(sys.stdin):
        try:
            arrays = run(case)
        except Exception as error:  # a case that this tree cannot run, the others it may
            arrays = {"refused": np.array(f"{type(error).__name__}: {error}")}
        part = folder / f"part-{os.getpid()}"
        with part.open("wb") as file:
            np.savez(file, **arrays)
        part.rename(folder / case["file"])
        print(case["name"], flush=True)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit(130)
