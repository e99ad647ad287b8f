"""Recordings as files of other programs: CSV, Parquet, MATLAB, NumPy."""

import io
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from fpt_ros.bags.tables import Tables
from fpt_ros.errors import BadInput

if TYPE_CHECKING:
    import pandas as pd

_LONGEST = 63
"""Characters of a name in MATLAB."""


def joined(tables: Mapping[str, "pd.DataFrame"]) -> "pd.DataFrame":
    """All topics on one time axis: a row a time at which any of them has a message.

    Columns are ``TOPIC.NAME [UNIT]``; a topic without a message at a time has no number there.
    Several messages of a topic at one time are rows of their own.
    """
    import pandas as pd

    parts = []
    for topic, table in tables.items():
        known = table.attrs["units"]
        own = table.rename(columns={name: _label(topic, name, known[name]) for name in table})
        repeated = own.groupby(level=0).cumcount()
        own.index = pd.MultiIndex.from_arrays([own.index, repeated], names=["time [s]", "repeat"])
        parts.append(own)
    if not parts:
        return pd.DataFrame(index=pd.Index([], name="time [s]"))
    whole = pd.concat(parts, axis=1, sort=True) if len(parts) > 1 else parts[0].sort_index()
    return whole.droplevel("repeat")


def _label(topic: str, name: str, unit: str) -> str:
    return f"{topic.lstrip('/')}.{name}" + (f" [{unit}]" if unit else "")


def csv(tables: Tables) -> bytes:
    """One table of text."""
    text: str = joined(tables.tables).to_csv()
    return text.encode()


def parquet(tables: Tables) -> bytes:
    """One table with types; its units are in the names of the columns."""
    out = io.BytesIO()
    joined(tables.tables).to_parquet(out)
    return out.getvalue()


def npz(tables: Tables) -> bytes:
    """Arrays ``TOPIC.NAME`` of each topic as it is, with ``TOPIC.time`` [s] and ``units``."""
    arrays: dict[str, Any] = {}
    known = {}
    for topic, table in tables.tables.items():
        for name, column, unit in _columns(table):
            arrays[_label(topic, name, "")] = column
            known[_label(topic, name, "")] = unit
    arrays["units"] = np.array(list(known.items()), dtype=str).reshape(-1, 2)
    out = io.BytesIO()
    np.savez_compressed(out, **arrays)
    return out.getvalue()


def mat(tables: Tables) -> bytes:
    """A structure a topic, with a field a number, and ``units`` of the same form."""
    from scipy.io import savemat

    content: dict[str, Any] = {}
    for topic, table in tables.tables.items():
        values: dict[str, Any] = {}
        known: dict[str, str] = {}
        for name, column, unit in _columns(table):
            key = _identifier(name, values)
            values[key] = column.astype(object) if column.dtype.kind == "U" else column
            known[key] = unit
        content[_identifier(topic, content)] = {**values, "units": known}
    out = io.BytesIO()
    savemat(out, content, long_field_names=True, oned_as="column")
    return out.getvalue()


def _columns(table: "pd.DataFrame") -> list[tuple[str, Any, str]]:
    known = table.attrs["units"]
    found: list[tuple[str, Any, str]] = [("time", table.index.to_numpy(), "s")]
    for name in table:
        column = table[name].to_numpy()
        if column.dtype == object:
            column = column.astype(str)
        found.append((str(name), column, known[name]))
    return found


def _identifier(name: str, taken: Mapping[str, Any]) -> str:
    """A name that MATLAB takes, not one of those that are taken."""
    plain = re.sub(r"\W+", "_", name, flags=re.ASCII).strip("_") or "x"
    plain = (plain if plain[0].isalpha() else f"x{plain}")[:_LONGEST]
    unique, number = plain, 2
    while unique in taken:
        unique = f"{plain[: _LONGEST - 4]}_{number}"
        number += 1
    return unique


FORMATS: dict[str, Callable[[Tables], bytes]] = {
    "csv": csv,
    "parquet": parquet,
    "mat": mat,
    "npz": npz,
}

FLAT = "mcap"
"""Not of tables: :mod:`fpt_ros.bags.flat`."""


def target(path: Path, form: str, out: Path | None) -> Path:
    """The file to write: what was asked for, or NAME.FORM (NAME-flat.mcap) beside the recording.

    Raises:
        BadInput: the format is not known, or the file is the recording itself.
    """
    if form not in (*FORMATS, FLAT):
        raise BadInput(f"--format {form}: formats are {', '.join((*FORMATS, FLAT))}")
    whole = path.absolute()
    name = whole.name if whole.is_dir() else whole.stem
    chosen = out or whole.with_name(f"{name}{'-flat' if form == FLAT else ''}.{form}")
    if chosen.absolute() == whole or chosen.is_dir():
        raise BadInput(f"--out {chosen} is the recording or a folder: give the name of a file")
    return chosen
