"""Tables of Apache Arrow: Parquet and Feather."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from fpt_ros.errors import BadInput
from fpt_ros.tables import headings
from fpt_ros.tables.opening import Opened
from fpt_ros.tables.table import Column, Kind, Table, distinct


def read_arrow(opened: Opened, parquet: bool) -> Table:
    """Read a Parquet or Feather file; structures are flattened to ``a.b``.

    Raises:
        BadInput: it is damaged, or has no rows.
    """
    import pyarrow

    what = "Parquet file" if parquet else "Feather file"
    try:
        if parquet:
            from pyarrow.parquet import ParquetFile

            table = ParquetFile(opened.file).read()
        else:
            from pyarrow.feather import read_table

            table = read_table(opened.file)
    except (pyarrow.ArrowException, OSError) as error:
        why = str(error).splitlines()[0]
        raise BadInput(f"{opened.name} cannot be read as a {what}: {why}") from error
    while any(pyarrow.types.is_struct(each.type) for each in table.schema):
        table = table.flatten()
    if not table.num_rows:
        raise BadInput(f"{opened.name} is empty: it has no rows")
    names = distinct(table.schema.names)
    columns = [_column(table.column(at), name) for at, name in enumerate(names)]
    return Table(tuple(columns), opened.name, what)


def _column(chunked: Any, heading: str) -> Column:
    import pyarrow
    from pyarrow import types

    name, unit = headings.split(heading)
    kind = chunked.type
    if types.is_dictionary(kind):
        chunked = chunked.cast(kind.value_type)
        kind = chunked.type
    if types.is_integer(kind) and not chunked.null_count and str(kind) != "uint64":
        return Column(name, Kind.NUMBER, chunked.to_numpy().astype(np.int64), unit)
    if types.is_integer(kind) or types.is_floating(kind) or types.is_decimal(kind):
        return Column(name, Kind.NUMBER, _floats(chunked), unit)
    if types.is_boolean(kind):
        return Column(name, Kind.BOOL, _floats(chunked.cast(pyarrow.int8())), unit)
    if types.is_timestamp(kind) or types.is_date(kind):
        values = chunked.cast(pyarrow.timestamp("ns")).to_numpy()
        zone = "UTC" if types.is_timestamp(kind) and kind.tz else ""
        return Column(name, Kind.TIME, values.astype("datetime64[ns]"), zone)
    if types.is_duration(kind):
        values = chunked.cast(pyarrow.duration("ns")).to_numpy() / np.timedelta64(1, "s")
        return Column(name, Kind.NUMBER, values.astype(np.float64), "s")
    refusal = f"column '{name}' is not numbers: it is of type {kind}"
    words = ["" if x is None else str(x) for x in chunked.to_pylist()]
    return Column(name, Kind.TEXT, np.array(words, dtype=object), unit, "", refusal)


def _floats(chunked: Any) -> NDArray[np.float64]:
    import pyarrow

    values = chunked.cast(pyarrow.float64(), safe=False)
    found: NDArray[np.float64] = np.array(values.to_numpy(), dtype=np.float64)
    return found
