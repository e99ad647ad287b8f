"""What a table of runs tells: its columns, its best runs, the onset of chattering."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from fpt_ros.sweep.job import COMPLETE

JUMP = 2.0
"""Chatter that is so many times what it was before is called the onset of chattering."""

KINDS = {"double": np.float64, "int64": np.int64, "bool": np.bool_, "string": object}
"""Types of columns in a table of runs, and of their arrays."""

Table = Mapping[str, Any]
"""Columns as arrays."""


def read(parquet: Path, columns: Sequence[str]) -> dict[str, Any]:
    """Some columns of a table of runs as arrays; NaN where there is no number.

    Column by column, as pyarrow's own ways to an array import pandas, 50 MB.
    """
    from pyarrow import parquet as format

    found: dict[str, Any] = {}
    with format.ParquetFile(parquet) as file:
        for name in dict.fromkeys(columns):
            (column,) = file.read(columns=[name]).columns
            found[name] = np.array(column.to_pylist(), dtype=KINDS[str(column.type)])
    return found


def best(parquet: Path) -> dict[str, dict[str, Any]]:
    """The complete run with the least value of each settled rms: its value, and where it is."""
    from pyarrow import parquet as format

    names = format.read_schema(parquet).names
    inputs = names[1 : names.index("outcome")]
    metrics = [name for name in names if name.startswith("rms_settled.")]
    table = read(parquet, [*inputs, "outcome", *metrics])
    found = {}
    for metric in metrics:
        column = np.where(table["outcome"] == COMPLETE, table[metric], np.nan)
        if not np.isnan(column).all():
            at = int(np.nanargmin(column))
            where = {name: table[name][at] for name in inputs}
            plain = {k: v.item() if hasattr(v, "item") else v for k, v in where.items()}
            found[metric] = {"value": float(column[at]), "at": plain}
    return found


def onset(table: Table, name: str) -> tuple[float, float] | None:
    """Last quiet and first chattering value of a parameter.

    Going from the quieter end, it is where the chatter becomes :data:`JUMP` times the median of
    what it was up to there; section 3.2.2 of the thesis: it jumps. ``None``: nowhere.
    """
    if "chatter" not in table:
        return None
    x = np.asarray(table[name], dtype=np.float64)
    known = (table["outcome"] == COMPLETE) & ~np.isnan(table["chatter"])
    order = np.argsort(x[known], kind="stable")
    at, chatter = x[known][order], np.asarray(table["chatter"][known][order], dtype=np.float64)
    if len(at) < 2:
        return None
    if chatter[0] > chatter[-1]:
        at, chatter = at[::-1], chatter[::-1]
    for i in range(1, len(at)):
        if chatter[i] > JUMP * float(np.median(chatter[:i])) and at[i] != at[i - 1]:
            return float(at[i - 1]), float(at[i])
    return None
