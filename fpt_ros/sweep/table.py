"""The tables of a sweep, from its journal: ``runs.csv`` and ``runs.parquet``."""

import csv
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from fpt_ros.errors import BadInput
from fpt_ros.sweep.definition import Sweep
from fpt_ros.sweep.grid import is_number
from fpt_ros.sweep.job import RESULT, Job
from fpt_ros.sweep.journal import Journal


def write_tables(sweep: Sweep, journal: Journal, directory: Path) -> tuple[Path, Path]:
    """Write both, by the number of the run; no more than a part of the rows is in memory.

    Raises:
        BadInput: they cannot be written.
    """
    types = _types(sweep.job)
    paths = directory / "runs.csv", directory / "runs.parquet"
    halves = [path.with_name("." + path.name) for path in paths]
    try:
        with halves[0].open("w", encoding="utf-8", newline="") as text:
            lines = csv.writer(text, lineterminator="\n")
            lines.writerow(types)
            for row in journal.rows():
                lines.writerow(map(_entry, row, types.values()))
        _convert(halves[0], halves[1], types)
        for half, path in zip(halves, paths, strict=True):
            half.replace(path)
    except OSError as error:
        raise BadInput(f"{directory} cannot be written: {error.strerror}") from error
    return paths


def _convert(text: Path, binary: Path, types: Mapping[str, str]) -> None:
    """Write a CSV file as Parquet; from lists of Python's pyarrow would import pandas, 50 MB."""
    import pyarrow
    from pyarrow import csv as format
    from pyarrow import parquet

    kinds = {"int": pyarrow.int64(), "float": pyarrow.float64(), "bool": pyarrow.bool_()}
    schema = pyarrow.schema(
        [(name, kinds.get(kind, pyarrow.string())) for name, kind in types.items()]
    )
    batches = format.open_csv(
        text,
        format.ReadOptions(use_threads=False),
        format.ParseOptions(newlines_in_values=True),
        format.ConvertOptions(column_types=schema, null_values=[""]),
    )
    with batches, parquet.ParquetWriter(binary, schema) as writer:
        for batch in batches:
            writer.write_batch(batch)


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


def _entry(value: Any, kind: str) -> Any:
    """What stands in a column of this kind; ``None``: nothing."""
    if kind == "float":
        return None if value is None else float(value)
    if kind == "str":
        return value if isinstance(value, str) else json.dumps(value)
    return value
