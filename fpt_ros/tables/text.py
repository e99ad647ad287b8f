"""Tables of text: CSV and its kin."""

import csv
from array import array
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from fpt_ros.errors import BadInput
from fpt_ros.tables import headings
from fpt_ros.tables.dialect import Dialect, Rows, is_comment, named_separator, sniff
from fpt_ros.tables.encoding import encoding, shown, text
from fpt_ros.tables.filling import Filling
from fpt_ros.tables.layout import Layout, lay_out
from fpt_ros.tables.opening import Opened
from fpt_ros.tables.table import Column, Table, distinct

HEAD = 2000
"""Lines that separator, decimal mark, header and kinds of columns are found from."""

CHUNK = 200_000
"""Cells that are converted at a time."""

Done = Callable[[int], None]
"""Is told how many bytes have been read."""


@dataclass
class _Body:
    """The rows of data, checked one by one."""

    name: str
    dialect: Dialect
    layout: Layout
    fillings: list[Filling]
    lines: "array[int]" = field(default_factory=lambda: array("Q"))
    all_lines: list[NDArray[np.uint32]] = field(default_factory=list)
    blank: list[int] = field(default_factory=list)
    repeated: list[int] = field(default_factory=list)
    comments: list[int] = field(default_factory=list)
    cut: int = 0

    def read(self, lines: Iterable[str], done: Callable[[], None]) -> None:
        """Read all rows; ``lines`` begin at the first row of data."""
        size = max(CHUNK // self.layout.width, 1000)
        rows: list[list[str]] = []
        for row in self._rows(lines):
            rows.append(row)
            if len(rows) == size:
                self._convert(rows)
                done()
                rows = []
        self._convert(rows)

    def _convert(self, rows: list[list[str]]) -> None:
        if rows:
            for filling, cells in zip(self.fillings, zip(*rows, strict=True), strict=True):
                filling.add(cells, self.lines)
        self.all_lines.append(np.array(self.lines, dtype=np.uint32))
        self.lines = array("Q")

    def _rows(self, lines: Iterable[str]) -> Iterator[list[str]]:
        """Rows of the right width; ``self.lines`` gets their lines."""
        width, before = self.layout.width, self.layout.first - 1
        source = _Watched(lines)
        reader = Rows(source, self.dialect.separator)
        header = list(self.layout.header or ())
        pending: list[int] = []
        comments: list[int] = []
        last = before
        try:
            for row in reader:
                line = reader.line + before
                if line > last + 1:
                    self._check_quoted(last + 1, row)
                last = line
                if len(row) == width and row[0][:1] not in "#%/" and (row[0] or width > 1):
                    if row == header:
                        self.repeated.append(line)
                        continue
                elif not row or (len(row) == 1 and not row[0].strip()):
                    pending.append(line)
                    continue
                elif is_comment(row[0]):
                    comments.append(line)
                    continue
                elif len(row) == width + 1 and not row[-1].strip():
                    row.pop()
                elif len(row) != width:
                    if len(row) < width and not source.ended:
                        self.cut = line
                        continue
                    raise BadInput(self._ragged(line, row))
                if pending or comments:
                    yield from self._fill(pending)
                    self.comments += comments
                    pending, comments = [], []
                self.lines.append(line)
                yield row
        except csv.Error as error:
            raise BadInput(
                f"{self.name}: line {last + 1}: a quote is not where it should be ({error}): close "
                "it, or take it out"
            ) from error

    def _check_quoted(self, line: int, row: list[str]) -> None:
        """A cell over several lines must not have rows in it.

        Raises:
            BadInput: it has, so a quote was not closed.
        """
        separators = self.layout.width - 1
        inside = [each for cell in row for each in cell.split("\n")[1:-1]]
        if any(each.count(self.dialect.separator) >= max(separators, 1) for each in inside):
            raise BadInput(
                f"{self.name}: line {line}: a quote is opened, and closed {len(inside) + 1} lines "
                "later: close it, or take it out"
            )

    def _fill(self, blank: list[int]) -> Iterator[list[str]]:
        """Empty lines between rows: missing samples of a single column, else nothing."""
        if self.layout.width > 1:
            self.blank += blank
            return
        for line in blank:
            self.lines.append(line)
            yield [""]

    def _ragged(self, line: int, row: list[str]) -> str:
        width = self.layout.width
        what = f"{self.name}: line {line} has {len(row)} cell{'s' * (len(row) != 1)}"
        if "\0" in row[0]:
            return f"{what}, of NUL bytes: data was lost there; take the line out"
        return f"{what}, all others have {width}: mend the line, or take it out"

    def remarks(self) -> Iterator[str]:
        """What was passed over, and words among numbers."""
        if self.layout.passed:
            yield f"{_lines(self.layout.passed)} above the table passed over"
        if self.blank:
            are = "are" if len(self.blank) > 1 else "is"
            yield f"{_lines(self.blank)} {are} empty: passed over"
        if self.comments:
            are = "are comments" if len(self.comments) > 1 else "is a comment"
            yield f"{_lines(self.comments)} {are} among the rows: passed over"
        if self.repeated:
            yield f"header repeated in {_lines(self.repeated)}: passed over"
        if self.cut:
            yield f"the last line, {self.cut}, is cut: left out"


class _Watched:
    """Lines, and whether the last one ended with a line break."""

    def __init__(self, lines: Iterable[str]) -> None:
        self._lines = iter(lines)
        self.ended = True

    def __iter__(self) -> Iterator[str]:
        for line in self._lines:
            if not line.endswith("\n"):
                self.ended = False
            yield line


def _lines(lines: Iterable[int]) -> str:
    """As in ``line 3`` or ``lines 3, 7 and 12 more``."""
    few = list(lines)
    more = f" and {len(few) - 5} more" if len(few) > 5 else ""
    return f"line{'s' * (len(few) > 1)} {', '.join(map(str, few[:5]))}{more}"


def read_text(opened: Opened, done: Done = lambda _: None) -> Table:
    """Read a table of text.

    Raises:
        BadInput: what is there is no table with a column of numbers, or a row has too many or too
            few cells.
    """
    code = encoding(opened.file)
    stream = text(opened.file, code)
    try:
        head = list(islice(stream, HEAD))
    finally:
        stream.detach()
    separator = named_separator(head[0]) if head else ""
    if separator:
        head[0] = "\n"
    if not any(line.strip() for line in head):
        raise BadInput(f"{opened.name} is empty: it takes a table with one signal a column")
    dialect = sniff(head, separator)
    table, comma = _read(opened, code, head, dialect, done)
    if comma and not dialect.certain:  # the head had whole numbers only
        table, _ = _read(opened, code, head, replace(dialect, decimal=","), done)
    return table


def _read(
    opened: Opened, code: str, head: list[str], dialect: Dialect, done: Done
) -> tuple[Table, bool]:
    """The table, and whether some numbers have decimal commas against the dialect."""
    layout = lay_out(head, dialect, opened.name)
    fillings = [Filling(kind, dialect.decimal) for kind in layout.kinds]
    body = _Body(opened.name, dialect, layout, fillings)
    stream = text(opened.file, code)
    try:
        body.read(islice(stream, layout.first - 1, None), lambda: done(opened.file.tell()))
    finally:
        stream.detach()
    comma = any(filling.comma for filling in fillings)
    columns = _columns(layout, fillings)
    remarks = [
        f"{column.name}: {_lines(odd.line for odd in filling.words)} {_are(filling)}: "
        "taken as missing"
        for column, filling in zip(columns, fillings, strict=True)
        if filling.words and not column.refusal
    ]
    lines = np.concatenate(body.all_lines)
    told = [str(dialect), str(layout)] + [shown(code)] * (shown(code) != "UTF-8")
    table = Table(columns, opened.name, ", ".join(told), (*body.remarks(), *remarks), lines)
    return table, comma


def _are(filling: Filling) -> str:
    """As in ``is 'ERR'``."""
    words = list(dict.fromkeys(str(odd) for odd in filling.words))
    return f"{'is' if len(filling.words) == 1 else 'are'} {', '.join(words[:3])}"


def _columns(layout: Layout, fillings: list[Filling]) -> tuple[Column, ...]:
    given = layout.header or tuple(map(str, range(layout.width)))
    split = [headings.split(heading) for heading in given]
    names = distinct([name for name, _ in split])
    units = [own or row for (_, own), row in zip(split, layout.units, strict=True)]
    titles = distinct(given)
    return tuple(
        filling.column(name, title if own else "", unit)
        for filling, name, title, unit, (_, own) in zip(
            fillings, names, titles, units, split, strict=True
        )
    )
