"""Tables of arrays: NumPy's NPY and NPZ, MATLAB's MAT, and WAV."""

import warnings
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fpt_ros.errors import BadInput
from fpt_ros.tables import headings
from fpt_ros.tables.opening import Opened
from fpt_ros.tables.table import Column, Kind, Table, distinct

DAMAGED = Exception
"""What the libraries raise where a file is cut or damaged: anything, struct.error and zlib.error
among others."""

FEW = 4
"""An array of fewer rows than this, and more columns, holds its signals in rows."""


def from_array(values: NDArray[Any], name: str = "") -> Iterator[Column]:
    """The columns of one array: one-dimensional, two-dimensional, or with named fields.

    Args:
        values: (n,), (n, columns), (1, n), or fewer than four rows of n.
        name: of the array; its columns are ``name[0]``, ``name[1]``; without it ``0``, ``1``.
    """
    if values.dtype.names:
        for each in values.dtype.names:
            yield from from_array(values[each], f"{name}.{each}" if name else each)
        return
    if values.ndim == 2 and values.shape[0] < min(FEW, values.shape[1]):
        values = values.T
    if values.ndim == 2 and values.shape[1] == 1:
        values = values[:, 0]
    if values.ndim == 1:
        yield _column(values, name or "0")
    elif values.ndim == 2:
        for at in range(values.shape[1]):
            yield _column(values[:, at], f"{name}[{at}]" if name else str(at))


def _column(values: NDArray[Any], heading: str) -> Column:
    name, unit = headings.split(heading)
    kind = values.dtype.kind
    if kind == "b":
        return Column(name, Kind.BOOL, values.astype(np.float64), unit)
    if kind in "iu":
        fits = kind == "i" or values.dtype.itemsize < 8 or not np.any(values > 2**63 - 1)
        return Column(name, Kind.NUMBER, values.astype(np.int64 if fits else np.float64), unit)
    if kind == "f":
        return Column(name, Kind.NUMBER, values.astype(np.float64), unit)
    if kind == "M":
        return Column(name, Kind.TIME, values.astype("datetime64[ns]"))
    if kind == "m":
        return Column(name, Kind.NUMBER, values / np.timedelta64(1, "s"), "s")
    what = "complex numbers" if kind == "c" else "words or objects"
    refusal = f"column '{name}' holds {what}: real numbers are needed"
    return Column(name, Kind.TEXT, values.astype(object), unit, "", refusal)


def from_arrays(
    arrays: Mapping[str, NDArray[Any]], name: str, layout: str, wanted: str | None = None
) -> Table:
    """A table of those arrays that have as many samples as the wanted one.

    Args:
        arrays: by name; single numbers among them are passed over.
        name: of the file.
        layout: what it is.
        wanted: name of a column; without it the arrays must agree.

    Raises:
        BadInput: no signals, or of several lengths and none is wanted.
    """
    columns = [one for key, array in arrays.items() for one in from_array(np.asarray(array), key)]
    columns = [one for one in columns if len(one.values) > 1]
    lengths = {len(one.values) for one in columns if one.numeric}
    if not lengths:
        raise BadInput(f"{name} holds no signal: it takes arrays of numbers of one dimension")
    chosen = {len(one.values) for one in columns if wanted in (one.name, one.title)}
    if len(lengths) > 1 and not chosen:
        listed = ", ".join(f"{one.name} ({len(one.values)})" for one in columns if one.numeric)
        raise BadInput(f"{name} holds signals of several lengths, --column says which: {listed}")
    length = (chosen or lengths).pop()
    columns = [one for one in columns if len(one.values) == length]
    names = distinct([one.name for one in columns])
    named = [
        Column(new, one.kind, one.values, one.unit, refusal=one.refusal)
        for new, one in zip(names, columns, strict=True)
    ]
    return Table(tuple(named), name, layout)


def read_npy(opened: Opened) -> Table:
    """Read an array of NumPy."""
    try:
        values = np.load(opened.file, allow_pickle=False)
    except DAMAGED as error:
        raise BadInput(_unreadable(opened, "NumPy array", error)) from error
    if values.ndim not in (1, 2):
        raise BadInput(f"{opened.name}: {values.ndim} dimensions, 1 or 2 are needed")
    if not values.size:
        raise BadInput(f"{opened.name} is empty: it takes a table with one signal a column")
    return Table(tuple(from_array(values)), opened.name, "NumPy array")


def read_npz(opened: Opened, wanted: str | None) -> Table:
    """Read an archive of arrays of NumPy."""
    try:
        with np.load(opened.file, allow_pickle=False) as archive:
            arrays = {key: archive[key] for key in archive.files}
    except DAMAGED as error:
        raise BadInput(_unreadable(opened, "NumPy archive", error)) from error
    return from_arrays(arrays, opened.name, "NumPy archive", wanted)


def read_mat(opened: Opened, wanted: str | None) -> Table:
    """Read a MAT file; fields of structures are ``structure.field``."""
    from scipy.io import loadmat

    if opened.head(512).startswith(b"MATLAB 7.3") or b"HDF" in opened.head(600)[510:]:
        raise BadInput(f"{opened.name} is of MATLAB 7.3 (HDF5): save it with -v7")
    try:
        found = loadmat(opened.file, simplify_cells=True)
    except DAMAGED as error:
        raise BadInput(_unreadable(opened, "MAT file", error)) from error
    arrays = dict(_inside({key: x for key, x in found.items() if not key.startswith("__")}))
    return from_arrays(arrays, opened.name, "MAT file", wanted)


def _inside(found: Mapping[str, Any], front: str = "") -> Iterator[tuple[str, NDArray[Any]]]:
    for key, value in found.items():
        if isinstance(value, dict):
            yield from _inside(value, f"{front}{key}.")
        elif isinstance(value, np.ndarray) and value.dtype.kind in "biufc":
            yield f"{front}{key}", value


def read_wav(opened: Opened) -> Table:
    """Read a WAV file: a column a channel, in the numbers of the file, and the times [s]."""
    from scipy.io import wavfile

    remarks = []
    try:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            rate, values = wavfile.read(opened.file)
        remarks = [str(one.message) for one in caught if "non-data" not in str(one.message)]
    except DAMAGED as error:
        raise BadInput(_unreadable(opened, "WAV file", error)) from error
    if not values.size:
        raise BadInput(f"{opened.name} is empty: it has no samples")
    values = values[:, np.newaxis] if values.ndim == 1 else values
    time = Column("t", Kind.NUMBER, np.arange(len(values)) / rate, "s")
    names = ["y"] if values.shape[1] == 1 else [f"channel{at}" for at in range(values.shape[1])]
    columns = [_column(values[:, at], name) for at, name in enumerate(names)]
    layout = f"WAV, {values.dtype}, {rate} Hz"
    return Table((time, *columns), opened.name, layout, tuple(remarks))


def _unreadable(opened: Opened, what: str, error: BaseException) -> str:
    why = str(error).splitlines()[0] if str(error) else "it ends early"
    return f"{opened.name} cannot be read as a {what}: {why}"
