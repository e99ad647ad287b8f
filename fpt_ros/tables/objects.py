"""Tables of JSON: one document, or one object a line."""

import json
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np

from fpt_ros.errors import BadInput
from fpt_ros.tables import headings
from fpt_ros.tables.arrays import from_arrays
from fpt_ros.tables.cells import kind
from fpt_ros.tables.encoding import encoding, text
from fpt_ros.tables.filling import Filling
from fpt_ros.tables.opening import Opened
from fpt_ros.tables.table import Table

CHUNK = 20_000
"""Objects that are converted at a time."""


def is_objects(head: str) -> bool:
    """Whether a text begins like JSON with objects or lists."""
    start = head.lstrip("\ufeff \t\r\n")
    if not start.startswith(("{", "[")):
        return False
    inner = start[1:].lstrip()
    return inner[:1] in ('"', "{", "[", "}", "]") or (start[0] == "[" and "," in inner)


def read_objects(opened: Opened) -> Table:
    """Read JSON: a list of objects, of lists or of numbers, an object of lists, or JSON lines.

    Raises:
        BadInput: it is not JSON (names the line), or not a table.
    """
    stream = text(opened.file, encoding(opened.file))
    try:
        first = next((line for line in stream if line.strip()), "")
        stream.seek(0)
        if _is_whole(first):
            rest = [line for line in stream if line.strip()][1:2]
            stream.seek(0)
            if rest or first.strip().startswith("{"):
                one = _parse(first, opened.name, 1)
                if rest or not any(isinstance(each, list | dict) for each in one.values()):
                    return _lines(opened, stream)
        return _document(opened, stream.read())
    finally:
        stream.detach()


def _is_whole(line: str) -> bool:
    try:
        return isinstance(json.loads(line), dict)
    except ValueError:
        return False


def _parse(line: str, name: str, number: int) -> Any:
    try:
        return json.loads(line)
    except ValueError as error:
        raise BadInput(f"{name}: line {number} is not JSON: {error}") from error


def _document(opened: Opened, content: str) -> Table:
    try:
        found = json.loads(content)
    except json.JSONDecodeError as error:
        raise BadInput(
            f"{opened.name}: line {error.lineno} is not JSON: {error.msg} at column {error.colno}"
        ) from error
    except RecursionError as error:
        raise BadInput(f"{opened.name} is nested too deeply for a table") from error
    if isinstance(found, dict) and {"columns", "data"} <= found.keys():  # pandas, orient=split
        found = [dict(zip(found["columns"], row, strict=False)) for row in found["data"]]
    if isinstance(found, list):
        if all(isinstance(row, dict) for row in found):
            return _table(opened, ((at, row) for at, row in enumerate(found, 1)), "object")
        rows = [row if isinstance(row, list) else [row] for row in found]
        return _table(opened, ((at, _numbered(row)) for at, row in enumerate(rows, 1)), "element")
    columns = {
        key: list(value.values()) if isinstance(value, dict) else value
        for key, value in found.items()
        if isinstance(value, list | dict)
    }
    if not columns:
        raise BadInput(f"{opened.name} holds no lists: it takes one list of numbers a column")
    if len({len(column) for column in columns.values()}) == 1:
        names, cells = list(columns), zip(*columns.values(), strict=True)
        rows_of = ((at, dict(zip(names, row, strict=True))) for at, row in enumerate(cells, 1))
        return _table(opened, rows_of, "element")
    arrays = {key: np.array([_number(x) for x in column]) for key, column in columns.items()}
    return from_arrays(arrays, opened.name, "JSON")


def _number(value: Any) -> float:
    return float(value) if isinstance(value, int | float) else float("nan")


def _numbered(row: list[Any]) -> dict[str, Any]:
    return {str(at): value for at, value in enumerate(row)}


def _lines(opened: Opened, stream: Iterable[str]) -> Table:
    def objects() -> Iterator[tuple[int, Any]]:
        for at, line in enumerate(stream, 1):
            if line.strip():
                row = _parse(line, opened.name, at)
                if not isinstance(row, dict):
                    raise BadInput(f"{opened.name}: line {at} is no object like the others")
                yield at, row

    return _table(opened, objects(), "line")


def _table(opened: Opened, rows: Iterable[tuple[int, Mapping[str, Any]]], of: str) -> Table:
    """A table of objects; a key that an object lacks is a missing cell."""
    fillings: dict[str, Filling] = {}
    pending: list[dict[str, str]] = []
    numbers: list[int] = []
    done = 0

    def convert() -> None:
        nonlocal done
        for name in dict.fromkeys(key for row in pending for key in row):
            if name not in fillings:
                first = next((row[name] for row in pending if row.get(name)), "")
                fillings[name] = Filling(kind(first, "."), ".")
                if done:
                    fillings[name].add([""] * done, [0] * done)
        for name, filling in fillings.items():
            filling.add([row.get(name, "") for row in pending], numbers)
        done += len(pending)
        pending.clear()
        numbers.clear()

    for at, row in rows:
        pending.append({name: _cell(value) for name, value in _flat(row)})
        numbers.append(at)
        if len(pending) == CHUNK:
            convert()
    convert()
    if not done:
        raise BadInput(f"{opened.name} is empty: it takes a table with one signal a column")
    columns = []
    remarks = []
    for heading, filling in fillings.items():
        name, unit = headings.split(heading)
        words = filling.words
        columns.append(filling.column(heading if not unit else name, heading, unit))
        if words and not columns[-1].refusal:
            more = f" and {len(words) - 1} more" if len(words) > 1 else ""
            remarks.append(f"{name}: {of} {words[0].line} is {words[0]}{more}: taken as missing")
    layout = "JSON lines" if of == "line" else "JSON"
    return Table(tuple(columns), opened.name, layout, tuple(remarks))


def _flat(row: Mapping[str, Any], front: str = "") -> Iterator[tuple[str, Any]]:
    """Keys and values; ``a.b`` and ``a[0]`` for what is inside of others."""
    for key, value in row.items():
        name = f"{front}{key}"
        if isinstance(value, dict):
            yield from _flat(value, f"{name}.")
        elif isinstance(value, list):
            inside = {f"{name}[{at}]": each for at, each in enumerate(value)}
            yield from _flat(inside)
        else:
            yield name, value


def _cell(value: Any) -> str:
    if value is None:
        return ""
    return repr(value) if isinstance(value, int | float) else str(value)
