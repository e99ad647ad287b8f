"""Writing tables: as bytes, chunk by chunk, in the kind that the file's name says."""

import csv
import io
import zlib
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from fpt_ros.errors import BadInput
from fpt_ros.tables import times
from fpt_ros.tables.opening import STDIN
from fpt_ros.tables.table import Column, Kind

ROWS = 20_000
"""Rows that are converted at a time."""

SEPARATORS = {".csv": ",", ".txt": ",", ".dat": ",", ".tsv": "\t"}
KINDS = (*SEPARATORS, ".parquet", ".npz")


def check_target(option: str, path: Path) -> None:
    """The name says a kind that can be written.

    Raises:
        BadInput: it does not; lists those that can.
    """
    if str(path) != STDIN and _kind(path) not in KINDS:
        raise BadInput(f"{option} {path}: it takes a name that ends in {', '.join(KINDS)} (or .gz)")


def _kind(path: Path) -> str:
    plain = path.with_suffix("") if path.suffix.lower() == ".gz" else path
    return plain.suffix.lower()


def encoded(columns: Sequence[Column], path: Path) -> Iterator[bytes]:
    """A table as the bytes of a file of this name; ``-`` gets CSV."""
    kind = ".csv" if str(path) == STDIN else _kind(path)
    if kind == ".parquet":
        chunks: Iterable[bytes] = [_parquet(columns)]
    elif kind == ".npz":
        chunks = [_npz(columns)]
    else:
        chunks = _text(columns, SEPARATORS[kind])
    return _gzipped(chunks) if path.suffix.lower() == ".gz" else iter(chunks)


def _text(columns: Sequence[Column], separator: str) -> Iterator[bytes]:
    buffer = io.StringIO()
    writer = csv.writer(buffer, delimiter=separator, lineterminator="\n")
    writer.writerow([column.title for column in columns])
    for start in range(0, len(columns[0].values), ROWS):
        cells = [_cells(column, slice(start, start + ROWS)) for column in columns]
        if any(column.kind is Kind.TEXT for column in columns) or len(columns) == 1:
            writer.writerows(zip(*cells, strict=True))
        else:  # nothing to quote
            lines = map(separator.join, zip(*cells, strict=True))
            buffer.write("\n".join(lines) + "\n")
        yield buffer.getvalue().encode()
        buffer.seek(0)
        buffer.truncate()


def _cells(column: Column, part: slice) -> list[str]:
    values: Any = column.values[part]
    if column.kind in (Kind.TIME, Kind.CLOCK):
        return times.text(values, column.unit)
    if column.kind is Kind.TEXT:
        return [str(value) for value in values]
    if column.kind is Kind.BOOL:
        words = {1.0: "True", 0.0: "False"}
        return [words.get(value, "") for value in values.tolist()]
    if values.dtype.kind in "iu":
        return list(map(str, values.tolist()))
    cells = list(map(repr, values.tolist()))
    for at in np.flatnonzero(np.isnan(values)):
        cells[at] = ""
    return cells


def _gzipped(chunks: Iterable[bytes]) -> Iterator[bytes]:
    packer = zlib.compressobj(6, zlib.DEFLATED, 31)
    for chunk in chunks:
        yield packer.compress(chunk)
    yield packer.flush()


def _parquet(columns: Sequence[Column]) -> bytes:
    import pyarrow
    from pyarrow import parquet

    arrays = [
        pyarrow.array(column.values, from_pandas=column.kind is not Kind.TEXT) for column in columns
    ]
    buffer = io.BytesIO()
    table = pyarrow.Table.from_arrays(arrays, names=[column.title for column in columns])
    parquet.write_table(table, buffer)
    return buffer.getvalue()


def _npz(columns: Sequence[Column]) -> bytes:
    buffer = io.BytesIO()
    arrays = {
        column.title: column.values.astype(str) if column.kind is Kind.TEXT else column.values
        for column in columns
    }
    np.savez(buffer, **arrays)  # type: ignore[arg-type]  # keys are names of columns
    return buffer.getvalue()
