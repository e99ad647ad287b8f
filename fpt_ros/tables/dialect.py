"""The separator and the decimal mark of a text, found from its lines."""

import csv
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from fpt_ros.tables.cells import Cell, kind

BLANKS = " "
ONE = "\x1f"
"""The separator of a single column: a control character that no table has in its cells."""

SEPARATORS = (";", "\t", "|", ",", BLANKS, ONE)
"""Those that are tried, of equals the first."""

NAMES = {"\t": "tabs", BLANKS: "blanks", ONE: ""}
MARKS = ("#", "%", "//")
"""That begin a comment."""

GOOD = (Cell.NUMBER, Cell.TIME, Cell.CLOCK, Cell.BOOL)
FIRST, LAST = 50, 250
"""Lines that are looked at, at the beginning and the end of the head of a file."""


@dataclass(frozen=True)
class Dialect:
    """How cells are separated, and their decimal mark.

    Attributes:
        separator: one character; a blank stands for any number of blanks and tabs.
        decimal: ``.`` or ``,``.
        certain: whether any cell showed the decimal mark.
    """

    separator: str
    decimal: str
    certain: bool = True

    def __str__(self) -> str:
        name = NAMES.get(self.separator, f"'{self.separator}'")
        parts = [f"separated by {name}" if name else "one column"]
        return ", ".join(parts + ["decimal commas"] * (self.decimal == ","))


class Rows:
    """Lines split into cells, with the number of the line that was read last.

    Raises:
        csv.Error: a quote that is opened and not closed.
    """

    def __init__(self, lines: Iterable[str], separator: str, strict: bool = True) -> None:
        self._lines = lines
        self._blanks = separator == BLANKS
        self._count = 0
        self._csv = csv.reader(lines, delimiter=separator, strict=strict, skipinitialspace=True)

    @property
    def line(self) -> int:
        """Lines read so far."""
        return self._count if self._blanks else self._csv.line_num

    def __iter__(self) -> Iterator[list[str]]:
        return self._split() if self._blanks else self._csv

    def _split(self) -> Iterator[list[str]]:
        for line in self._lines:
            self._count += 1
            yield (
                next(csv.reader([line], delimiter=" ", skipinitialspace=True), [])
                if ('"' in line)
                else line.split()
            )


def is_comment(line: str) -> bool:
    """Whether a line is a comment. ``#N/A`` is a missing cell."""
    text = line.lstrip()
    return text.startswith(MARKS) and not text.upper().startswith(("#N", "#VALUE!", "#DIV"))


def named_separator(line: str) -> str:
    """The separator that a first line like ``sep=;`` names; else empty."""
    text = line.strip().strip('"')
    if text[:4].casefold() != "sep=":
        return ""
    return {"\\t": "\t", "": "\t"}.get(text[4:], text[4:5])


def sniff(lines: list[str], separator: str = "") -> Dialect:
    """The dialect of the head of a text.

    Every pair of separator and decimal mark is tried. The best one splits the most lines into the
    same number of cells, and makes the largest part of them numbers or times.

    Args:
        lines: of the head.
        separator: where it is known.
    """
    lines = [line for line in lines if line.strip() and not is_comment(line)]
    if len(lines) > FIRST + LAST:
        lines = lines[:FIRST] + lines[-LAST:]
    best, best_score = Dialect(separator or ONE, "."), 0.0
    for each in (separator,) if separator else SEPARATORS:
        rows = [row for row in Rows(lines, each, strict=False) if row]
        width, count = Counter(map(len, rows)).most_common(1)[0] if rows else (0, 0)
        if width < 2 and each not in (separator, ONE):
            continue
        even = [row for row in rows if len(row) == width]
        for decimal in ".,":
            score = _score(even, decimal) * count / len(rows)
            if score > best_score + 1e-9:
                best, best_score = Dialect(each, decimal, _shown(even, decimal)), score
    return best


def _score(rows: list[list[str]], decimal: str) -> float:
    """The part of the cells that are numbers or times; missing ones do not count."""
    counts = [_good(row, decimal) for row in rows]
    some = [each for each in counts if each[0]]  # the others may be headers
    if 2 * len(some) >= len(rows):
        counts = some
    good, bad = (sum(each) for each in zip(*counts, strict=True))
    return good / (good + bad) if good else 0.0


def _good(row: list[str], decimal: str) -> tuple[int, int]:
    """How many cells are numbers or times, and how many are something else."""
    kinds = [(cell, kind(cell, decimal)) for cell in row]
    good = sum(what in GOOD and not _zeros_in_front(cell) for cell, what in kinds)
    missing = sum(what is Cell.MISSING for _, what in kinds)
    return good, len(row) - missing - good


def _zeros_in_front(cell: str) -> bool:
    """Whether it looks like the digits behind a decimal comma: 00012."""
    text = cell.strip()
    return len(text) > 1 and text[0] == "0" and text.isdigit()


def _shown(rows: list[list[str]], decimal: str) -> bool:
    return any(
        decimal in cell and kind(cell, decimal) is Cell.NUMBER for row in rows for cell in row
    )
