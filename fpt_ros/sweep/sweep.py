"""A sweep from its definition to its table and its map; begun anew, or where it was left."""

import hashlib
import json
import os
from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from dataclasses import dataclass, replace
from itertools import islice, product
from pathlib import Path
from typing import Any, cast

from ruamel.yaml import YAML
from ruamel.yaml.error import YAMLError

from fpt_ros import __version__
from fpt_ros.errors import BadInput, RunFailed
from fpt_ros.loop.experiment import SECTIONS, Experiment, load
from fpt_ros.parameters import Parameter, Value
from fpt_ros.sweep.executor import Pool
from fpt_ros.sweep.grid import Axis, Space, is_number, parse, values
from fpt_ros.sweep.journal import Journal, Row
from fpt_ros.sweep.run_one import RESULT, Job, metrics_of, run_chunk

DEFINITION, JOURNAL = "sweep.yaml", "journal.jsonl"

CHUNK_TIME = 0.3
"""Seconds that one call to a worker should take: long against its cost, short to wait for."""

LARGEST_CHUNK = 256
TRIES = 4
"""Times that runs whose worker died are given to another one."""

BATCH = 4096
"""Rows that are turned into a table at a time."""

COMBINATIONS = 64
"""Combinations of words that are looked at for one that has all parameters."""

PER_COORDINATE = ("initial_position", "initial_velocity")
"""Lists that are zero for all coordinates where they are empty."""

Progress = Callable[[int, int], None]
"""Is told how many runs are done, and how many of them are not complete; may raise to end."""


@dataclass(frozen=True)
class Sweep:
    """A sweep whose definition has been checked.

    Attributes:
        experiment: at its first point without the axes.
        job: what workers are given.
        definition: what is stored, and compared when a sweep goes on.
    """

    experiment: Experiment
    job: Job
    definition: Mapping[str, Any]

    @property
    def size(self) -> int:
        """Number of runs."""
        return self.job.space.size


def define(
    name: str,
    variant: str,
    settings: Sequence[str],
    duration: float | None,
    grids: Sequence[str],
    random: int | None,
    seed: int,
    metrics: Sequence[str],
) -> Sweep:
    """Check what is asked for, and read the experiment once.

    Raises:
        BadInput: an unknown parameter or metric, a value that no run could take, no points.
    """
    if random is not None and random < 1:
        raise BadInput(f"--random {random} is not valid, it takes 1 or more")
    if seed < 0:
        raise BadInput(f"--seed {seed} is not valid, it takes 0 or more")
    if not grids:
        raise BadInput("a sweep takes at least one --grid, as in --grid fpt_deformer.A=-0.1:-4:64")
    axes = [parse(text, random is not None) for text in grids]
    _check_distinct(axes)
    if name.endswith((".yaml", ".yml")) or "/" in name:
        name = str(Path(name).absolute())
    bare = load(name, variant, settings, duration)
    experiment = _first_with_all(
        bare, axes, lambda words: load(name, variant, words, duration), settings
    )
    lists: dict[str, tuple[float, ...]] = {}
    axes = [_checked(axis, experiment, lists) for axis in axes]
    space = Space(tuple(axes), random or 0, seed if random else 0)
    chosen = metrics_of(experiment.loop(), metrics)
    job = Job(name, variant, tuple(settings), duration, space, tuple(lists.items()), chosen)
    definition = {
        "experiment": name,
        "variant": variant,
        "set": list(settings),
        "duration": duration,
        "grid": list(grids),
        "random": space.random,
        "seed": space.seed,
        "metrics": list(chosen),
        "runs": space.size,
        "parameters": _digest(bare),
        "version": __version__,
    }
    return Sweep(experiment, job, definition)


def run(sweep: Sweep, directory: Path, pool: Pool, progress: Progress) -> Journal:
    """Make all runs that are not in the directory's journal yet.

    Raises:
        RunFailed: workers die again and again, or the scheduler has gone.
    """
    job = sweep.job
    journal = Journal(
        directory / JOURNAL,
        sweep.size,
        len(job.columns),
        1 + len(job.space.axes),
    )
    try:
        progress(journal.done, journal.lost)
        for rows in _rows(job, journal, pool, progress):
            journal.append(rows)
            progress(journal.done, journal.lost)
    except BaseException:
        journal.close()
        raise
    return journal


def open_directory(sweep: Sweep, directory: Path) -> bool:
    """Make the directory ready; whether there was a sweep to go on with.

    Raises:
        BadInput: it cannot be written, or is that of something else.
    """
    path = directory / DEFINITION
    if directory.exists() and not directory.is_dir():
        raise BadInput(f"--out {directory} is a file, it takes a directory")
    if path.exists():
        _compare(sweep.definition, path)
        if not os.access(directory, os.W_OK):
            raise BadInput(f"--out {directory} cannot be written: Permission denied")
        return True
    if directory.exists() and any(directory.iterdir()):
        raise BadInput(f"--out {directory} holds other files, give a new directory")
    try:
        directory.mkdir(parents=True, exist_ok=True)
        half = directory / f".{DEFINITION}"
        with half.open("w", encoding="utf-8") as stream:
            yaml = YAML()
            yaml.width = 4096
            yaml.dump(dict(sweep.definition), stream)
        half.replace(path)
    except OSError as error:
        raise BadInput(f"--out {directory} cannot be written: {error.strerror}") from error
    return False


def write_tables(sweep: Sweep, journal: Journal, directory: Path) -> tuple[Path, Path]:
    """``runs.csv`` and ``runs.parquet``, by the number of the run, a batch of rows at a time.

    Raises:
        BadInput: they cannot be written.
    """
    import pandas
    import pyarrow
    from pyarrow import parquet

    types = _types(sweep.job)
    kinds = {"int": pyarrow.int64(), "float": pyarrow.float64(), "bool": pyarrow.bool_()}
    schema = pyarrow.schema(
        [(name, kinds.get(kind, pyarrow.string())) for name, kind in types.items()]
    )
    paths = directory / "runs.csv", directory / "runs.parquet"
    halves = [path.with_name("." + path.name) for path in paths]
    try:
        with (
            halves[0].open("w", encoding="utf-8", newline="") as text,
            parquet.ParquetWriter(halves[1], schema) as writer,
        ):
            first = True
            for rows in _batches(journal.rows()):
                columns = {
                    name: _column([row[i] for row in rows], kind)
                    for i, (name, kind) in enumerate(types.items())
                }
                frame = pandas.DataFrame(columns)
                frame.to_csv(text, index=False, header=first)
                writer.write_table(
                    pyarrow.Table.from_pandas(frame, schema=schema, preserve_index=False)
                )
                first = False
        for half, path in zip(halves, paths, strict=True):
            half.replace(path)
    except OSError as error:
        raise BadInput(f"{directory} cannot be written: {error.strerror}") from error
    return paths


def _rows(job: Job, journal: Journal, pool: Pool, progress: Progress) -> Iterator[list[Row]]:
    """Rows as they come; a few chunks for each worker are under way at any time."""
    numbers = journal.missing()
    again: deque[tuple[list[int], int]] = deque()
    under_way: dict[Future[Any], tuple[list[int], int]] = {}
    left, size = journal.missing_count, 1
    try:
        while True:
            while len(under_way) < 2 * pool.slots + 1:
                chunk, tries = again.popleft() if again else (list(islice(numbers, size)), 0)
                if not chunk:
                    break
                under_way[pool.submit(run_chunk, job, chunk)] = chunk, tries
            if not under_way:
                return
            ready, _ = wait(under_way, timeout=0.2, return_when=FIRST_COMPLETED)
            progress(journal.done, journal.lost)
            broken: BaseException | None = None
            for future in ready:
                chunk, tries = under_way.pop(future)
                failure = future.exception()
                if failure is None:
                    seconds, rows = future.result()
                    left -= len(rows)
                    wanted = round(CHUNK_TIME * len(rows) / max(seconds, 1e-9))
                    even = left // (4 * pool.slots) + 1  # so that all end together
                    size = max(1, min(wanted, even, LARGEST_CHUNK))
                    yield rows
                else:
                    broken = failure
                    again.append((chunk, tries + 1))
            if broken is not None:
                if any(tries >= TRIES for _, tries in again):
                    raise RunFailed(f"workers die again and again: {_line(broken)}") from broken
                pool.repair(broken)
    finally:
        for future in under_way:
            future.cancel()


def _line(error: BaseException) -> str:
    return (str(error) or type(error).__name__).splitlines()[0]


def _check_distinct(axes: Sequence[Axis]) -> None:
    seen: dict[str, list[int | None]] = {}
    for axis in axes:
        others = seen.setdefault(axis.target.parameter, [])
        if axis.target.index in others or (others and None in (axis.target.index, *others)):
            raise BadInput(f"--grid {axis.target}: there are two for {axis.target.parameter}")
        others.append(axis.target.index)


def _first_with_all(
    bare: Experiment,
    axes: Sequence[Axis],
    make: Callable[[list[str]], Experiment],
    settings: Sequence[str],
) -> Experiment:
    """The experiment with the first words that it is valid with and has all parameters with.

    Where there are none, the first ones, for what is wrong with them.
    """
    words = [axis for axis in axes if not axis.numeric and axis.target.index is None]
    if not words:
        return bare
    for axis in words:
        node, name = axis.target.node, axis.target.name
        if node not in SECTIONS:
            continue  # the loader says it
        for value in axis.choices:
            plain = list(value) if isinstance(value, tuple) else value
            known = SECTIONS[node]({**bare.nodes[node], name: plain})  # names of laws are checked
            for parameter in known:
                if parameter.name == name:
                    parameter.check(plain, node)
    combinations = product(*(axis.choices for axis in words))
    for values_ in islice(combinations, COMBINATIONS):
        own = [f"{a.target}={json.dumps(v)}" for a, v in zip(words, values_, strict=True)]
        try:
            found = make([*settings, *own])
        except BadInput:
            continue
        if all(
            axis.target.name in _known(found, axis.target.node)
            for axis in axes
            if axis.target.node in SECTIONS
        ):
            return found
    return make([*settings, *(f"{a.target}={json.dumps(a.choices[0])}" for a in words)])


def _known(experiment: Experiment, node: str) -> dict[str, Parameter]:
    return {each.name: each for each in SECTIONS[node](experiment.nodes[node])}


def parameter_of(experiment: Experiment, node: str, name: str) -> Parameter:
    """The definition of a parameter.

    Raises:
        BadInput: there is none, with those that there are.
    """
    if node not in SECTIONS:
        raise BadInput(f"there is no node '{node}': there are {', '.join(SECTIONS)}")
    known = _known(experiment, node)
    if name not in known:
        raise BadInput(f"{node} has no parameter '{name}': it has {', '.join(sorted(known))}")
    return known[name]


def _checked(axis: Axis, experiment: Experiment, lists: dict[str, tuple[float, ...]]) -> Axis:
    """The axis with the type of its parameter; its values are valid each by itself."""
    target = axis.target
    parameter = parameter_of(experiment, target.node, target.name)
    if target.index is None:
        axis = replace(axis, whole=parameter.kind == "int" and not axis.choices)
        if axis.whole:
            _check_whole(axis)
        for value in _samples(axis):
            parameter.check(list(value) if isinstance(value, tuple) else value, target.node)
        return axis
    whole = lists.get(target.parameter) or _list_of(experiment, axis, parameter)
    if target.index >= len(whole):
        raise BadInput(f"--grid {target}: {target.parameter} has {len(whole)} elements, from [0]")
    for value in _samples(axis):
        given = [*whole[: target.index], value, *whole[target.index + 1 :]]
        parameter.check(given, target.node)
    lists[target.parameter] = whole
    return axis


def _list_of(experiment: Experiment, axis: Axis, parameter: Parameter) -> tuple[float, ...]:
    if parameter.kind != "floats":
        raise BadInput(f"--grid {axis.target}: {axis.target.parameter} is no list of numbers")
    given = cast("Sequence[float]", experiment.nodes[axis.target.node][parameter.name])
    if not given and parameter.name in PER_COORDINATE:
        return (0.0,) * len(experiment.loop().plant.coordinates)
    return tuple(float(value) for value in given)


def _check_whole(axis: Axis) -> None:
    ends = (axis.start, axis.stop)
    steps = values(replace(axis, whole=False)) if axis.count else ends
    for value in (*ends, *steps):
        if float(cast("float", value)) != round(cast("float", value)):
            raise BadInput(f"--grid {axis.target}: {value} is not valid, it takes an integer")


def _samples(axis: Axis) -> Sequence[Value]:
    if axis.choices:
        return axis.choices
    ends = (axis.start, axis.stop)
    return values(axis) or (tuple(map(int, ends)) if axis.whole else ends)


def _digest(experiment: Experiment) -> str:
    text = json.dumps(experiment.nodes, sort_keys=True, default=list)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def _compare(definition: Mapping[str, Any], path: Path) -> None:
    try:
        stored = YAML(typ="safe", pure=True).load(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, YAMLError) as error:
        raise BadInput(f"{path} cannot be read, give a new directory") from error
    if not isinstance(stored, dict):
        raise BadInput(f"{path} is not of a sweep, give a new directory")
    for key in {**definition, **stored}:
        if stored.get(key) != definition.get(key):
            raise BadInput(
                f"{path.parent} is of another sweep: its {key} is {stored.get(key)}, not "
                f"{definition.get(key)}; give a new directory"
            )


def _types(job: Job) -> dict[str, str]:
    """Kind of every column."""
    found = {"run": "int"}
    for axis in job.space.axes:
        kind = "int" if axis.whole else "float"
        if axis.choices:
            kinds = {type(value) for value in axis.choices}
            kind = {bool: "bool", int: "int"}.get(kinds.pop(), "str") if len(kinds) == 1 else "str"
            if kind != "int" and all(is_number(value) for value in axis.choices):
                kind = "float"
        found[str(axis.target)] = kind
    found.update(zip(RESULT, ("str", "float", "str", "int"), strict=True))
    return {**found, **dict.fromkeys(job.metrics, "float")}


def _column(entries: list[Any], kind: str) -> Any:
    import numpy as np

    if kind == "float":
        return np.array([np.nan if each is None else each for each in entries], dtype=np.float64)
    if kind == "str":
        return [each if isinstance(each, str) else json.dumps(each) for each in entries]
    return np.array(entries, dtype={"int": np.int64, "bool": np.bool_}[kind])


def _batches(rows: Iterator[Row]) -> Iterator[list[Row]]:
    while batch := list(islice(rows, BATCH)):
        yield batch
