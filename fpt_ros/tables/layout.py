"""Where a text's data begin, and which of the rows above them are header and units."""

from collections import Counter
from dataclasses import dataclass

from fpt_ros.errors import BadInput
from fpt_ros.tables import headings
from fpt_ros.tables.cells import ERRORS, Cell, kind, quoted
from fpt_ros.tables.dialect import BLANKS, MARKS, Dialect, Rows, is_comment

Row = tuple[int, list[str]]
"""The number of its (last) line, and its cells."""

SAMPLE = 250
"""Rows that tell what the columns are."""


@dataclass(frozen=True)
class Layout:
    """The parts of a text.

    Attributes:
        kinds: of the columns' cells, each the most frequent one; as many as rows have cells.
        header: the names, as they stand there, or ``None`` where there is no header.
        header_line: its line.
        units: of the columns; empty strings where there is no row of units.
        first: line of the first row of data, from 1.
        passed: numbers of lines above it that are neither header, units, comments nor empty.
    """

    kinds: tuple[Cell, ...]
    header: tuple[str, ...] | None
    header_line: int
    units: tuple[str, ...]
    first: int
    passed: tuple[int, ...]

    @property
    def width(self) -> int:
        """Number of columns."""
        return len(self.kinds)

    def __str__(self) -> str:
        if self.header is None:
            return "no header"
        units = f", units in line {self.header_line + 1}" if any(self.units) else ""
        return f"header in line {self.header_line}{units}"


def lay_out(lines: list[str], dialect: Dialect, name: str) -> Layout:
    """The layout of a text, from its head.

    Raises:
        BadInput: there are no data, or the header does not fit to them.
    """
    rows, comments = _rows(lines, dialect)
    if not rows:
        raise BadInput(f"{name} is empty: it takes a table with one signal a column")
    widths = Counter(len(row) for _, row in rows[-SAMPLE:])
    width = max(widths, key=lambda each: (widths[each], each))
    even = [row for _, row in rows[-SAMPLE:] if len(row) == width]
    kinds = [_majority([row[at] for row in even], dialect) for at in range(width)]
    first = _first(rows, kinds, dialect)
    if first is None:
        raise BadInput(
            f"{name} has no column of numbers: line {rows[-1][0]} begins with "
            f"{quoted(rows[-1][1][0])}, needed is a table with one signal a column"
        )
    start, even = rows[first][0], [row for _, row in rows[first:] if len(row) == width]
    kinds = [_majority([row[at] for row in even], dialect) for at in range(width)]
    above = _above(rows[:first], width) or _in_comments(comments, start, kinds, dialect)
    header, units, line = _names(above)
    nameless = header is None or len(header) < width or not header[width - 1]
    if nameless and width > 1 and all(not row[-1].strip() for row in even):
        kinds.pop()  # rows end with a separator
        header = header[: len(kinds)] if header is not None else None
    if header is None and first:
        line, row = rows[first - 1]
        if len(row) > 1 and start - line == 1:  # right above the data, of another width
            raise BadInput(_misfit(name, tuple(row), line, rows[first], dialect))
    if header is not None and len(header) == len(kinds) + 1 and not header[-1]:
        header = header[:-1]
    if header is not None and len(header) == len(kinds) - 1 and _numbered(even):
        header, units = ("", *header), ("", *units)  # names of the rows, as R writes them
    if header is not None and len(header) != len(kinds):
        raise BadInput(_misfit(name, header, line, rows[first], dialect))
    used = [each for each, _ in above]
    passed = tuple(each for each, _ in rows[:first] if each not in used)
    units = (*units, *[""] * len(kinds))[: len(kinds)]
    return Layout(tuple(kinds), header, line, units, start, passed)


def _rows(lines: list[str], dialect: Dialect) -> tuple[list[Row], list[Row]]:
    """Rows of data and above them; comments without their marks, split as rows are."""
    rows: list[Row] = []
    comments: list[Row] = []
    reader = Rows(lines, dialect.separator, strict=False)
    for row in reader:
        if not any(cell.strip() for cell in row):
            continue
        text = row[0]
        if is_comment(text):
            whole = lines[reader.line - 1].lstrip().lstrip("#%/").strip()
            cells = next(iter(Rows([whole], dialect.separator, strict=False)), [])
            comments.append((reader.line, cells))
        else:
            rows.append((reader.line, _joined(row) if dialect.separator == BLANKS else row))
    return rows, comments


def _joined(row: list[str]) -> list[str]:
    """Words of a row separated by blanks: a unit in brackets belongs to the name before it."""
    found: list[str] = []
    for word in row:
        if found and word[:1] in "[(" and word[-1:] in "])":
            found[-1] += f" {word}"
        else:
            found.append(word)
    return found


def _majority(cells: list[str], dialect: Dialect) -> Cell:
    """What most cells of a column are; those that are missing do not count."""
    counts = Counter(kind(cell, dialect.decimal) for cell in cells)
    del counts[Cell.MISSING]
    if not counts:
        return Cell.MISSING
    if 2 * counts[Cell.NUMBER] >= counts.total():
        return Cell.NUMBER
    return counts.most_common(1)[0][0]


VALUES = (Cell.NUMBER, Cell.TIME, Cell.CLOCK, Cell.BOOL)


def _first(rows: list[Row], kinds: list[Cell], dialect: Dialect) -> int | None:
    """The first row of data.

    It is the first whose cells are all of their column's kind. Rows right above it that have
    numbers among words belong to the data too: a bad cell in the first row does not make a header.
    """
    whole = all(cell.strip().isdigit() for cell in rows[-1][1])
    at = 0
    for at, (_, row) in enumerate(rows):  # noqa: B007 used behind the loop
        found = [kind(cell, dialect.decimal) for cell in row]
        fits = len(row) == len(kinds) and all(
            own in (theirs, Cell.MISSING) or theirs not in VALUES
            for own, theirs in zip(found, kinds, strict=True)
        )
        if fits and any(cell in VALUES for cell in found) and not _counts(row, whole):
            break
    else:
        return None
    while at and _is_data(rows[at - 1][1], kinds, dialect, topmost=at == 1):
        at -= 1
    return at


def _is_data(row: list[str], kinds: list[Cell], dialect: Dialect, topmost: bool) -> bool:
    """Whether a row above the first one without fault is one of data with a fault."""
    if len(row) != len(kinds) or _counts(row, False):
        return False
    if headings.is_time_name(headings.split(row[0])[0]):
        return False
    if all(cell.strip() in ERRORS for cell in row):
        return True
    found = [kind(cell, dialect.decimal) for cell in row]
    if all(cell is Cell.MISSING for cell in found):
        return topmost or any(cell.strip() not in ("", "-") for cell in row)
    return any(own in VALUES and own is theirs for own, theirs in zip(found, kinds, strict=True))


def _numbered(rows: list[list[str]]) -> bool:
    """Whether the first column counts the rows."""
    first = [row[0].strip() for row in rows]
    if not all(cell.isdigit() for cell in first):
        return False
    return [int(cell) for cell in first] == list(range(int(first[0]), int(first[0]) + len(first)))


def _counts(row: list[str], whole: bool) -> bool:
    """Whether a row counts its columns, 0, 1, 2 ..., with at most a word in front: a header.

    Args:
        whole: rows of data are whole numbers too; then there has to be a word, or an empty cell.
    """
    words = [cell.strip() for cell in row]
    front = not words[0].isdigit()
    digits = words[1:] if front else words
    if (whole and not front) or len(digits) < 3 - front or not all(w.isdigit() for w in digits):
        return False
    numbers = [int(word) for word in digits]
    return numbers[0] in (0, 1) and numbers == list(range(numbers[0], numbers[0] + len(numbers)))


def _above(rows: list[Row], width: int) -> list[Row]:
    """Header, and units if there are, among the rows right above the data."""
    found: list[Row] = []
    for line, row in reversed(rows[-3:]):
        near = len(row) in (width, width - 1) or (len(row) == width + 1 and not row[-1].strip())
        if not near or (found and len(row) != len(found[0][1])):
            break
        found.insert(0, (line, row))
    units = [headings.are_units(row) for _, row in found]
    if len(found) > 1 and any(units[1:]):
        last = max(at for at, each in enumerate(units) if each)
        while last > 1 and units[last - 1]:
            last -= 1
        return found[last - 1 : last + 1]
    return found[-1:]


def _in_comments(comments: list[Row], first: int, kinds: list[Cell], dialect: Dialect) -> list[Row]:
    """A header in the last comment above the data, as of ``numpy.savetxt`` and ``rostopic``."""
    for line, row in reversed([each for each in comments if each[0] < first]):
        cells = _joined(row) if dialect.separator == BLANKS else row
        if len(cells) != len(kinds) or (len(kinds) == 1 and " " in cells[0].strip()):
            return []
        if any(kind(cell, dialect.decimal) is Cell.NUMBER for cell in cells):
            return []
        return [(line, cells)]
    return []


def _names(above: list[Row]) -> tuple[tuple[str, ...] | None, tuple[str, ...], int]:
    """Header, units, and the line of the header."""
    if not above:
        return None, (), 0
    line, header = above[0]
    units = tuple(headings.bare(cell) for cell in above[1][1]) if len(above) > 1 else ()
    return tuple(cell.strip().lstrip("".join(MARKS)) for cell in header), units, line


def _misfit(name: str, header: tuple[str, ...], line: int, first: Row, dialect: Dialect) -> str:
    width = len(first[1])
    hint = "give each column one name"
    if dialect.separator == "," and width == 2 * len(header):
        hint = "are its decimal marks commas? separate by ; or write points"
    return (
        f"{name}: the header in line {line} names {len(header)} columns, line {first[0]} has "
        f"{width} cells: {hint}"
    )
