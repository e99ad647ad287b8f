"""What a cell of a text is: a number, a time, missing, a word."""

import math
import re
from enum import StrEnum

from fpt_ros.tables import times

MISSING = frozenset(
    (
        *("", "-", "--", "---", "?", ".", "*", "missing", "null", "none", "nil"),
        *("nan", "na", "n/a", "#n/a", "#na", "<na>", "nat", "-nan", "+nan", "-nan(ind)"),
        *("1.#qnan", "-1.#ind", "#value!", "#div/0!", "#num!", "#ref!", "#name?"),
    )
)
"""Words for a missing sample, in small letters."""

ERRORS = frozenset(
    (
        *("ERR", "ERROR", "FAULT", "FAIL", "FAILED", "BAD", "INVALID", "TIMEOUT", "LOST"),
        *("OL", "OVER", "OVERFLOW", "OVERRANGE", "UNDER", "UNDERFLOW", "NODATA"),
    )
)
"""Words of instruments in the place of a number. Any other word among numbers counts as missing
too, but a row of these is not taken for a header."""

TRUE = frozenset(("true", "yes", "on"))
FALSE = frozenset(("false", "no", "off"))

NUMBER = re.compile(r"[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?|[+-]?inf(inity)?", re.ASCII | re.I)
EXPONENT = re.compile(r"(?<=[\d.])[dD](?=[+-]?\d)")
"""Of Fortran's double precision, as in 1.5D-03."""


class Cell(StrEnum):
    """Kinds of cells."""

    NUMBER = "number"
    TIME = "time"
    CLOCK = "time of day"
    BOOL = "true or false"
    MISSING = "missing"
    WORD = "word"
    GARBLED = "digits, but no number"


def number(cell: str, decimal: str) -> float:
    """The number that a cell is; NaN if it is none.

    Stricter than ``float``: no underscores, and a point only if it is the decimal mark.
    """
    text = cell.strip()
    if decimal == ",":
        if "." in text:
            return math.nan
        text = text.replace(",", ".")
    if not NUMBER.fullmatch(text):
        text = EXPONENT.sub("e", text.replace("\u2212", "-"))
        if not NUMBER.fullmatch(text):
            return math.nan
    return float(text)


def truth(cell: str) -> float:
    """1 for true, 0 for false; NaN if it is neither."""
    word = cell.strip().casefold()
    return 1.0 if word in TRUE else 0.0 if word in FALSE else math.nan


def missing(cell: str) -> bool:
    """Whether the cell says that its sample is missing."""
    return cell.strip().casefold() in MISSING


def kind(cell: str, decimal: str) -> Cell:
    """What a cell is."""
    text = cell.strip()
    if text.casefold() in MISSING:
        return Cell.MISSING
    if not math.isnan(number(text, decimal)):
        return Cell.NUMBER
    if not math.isnan(truth(text)):
        return Cell.BOOL
    if times.is_time(text):
        return Cell.TIME
    if times.is_clock(text):
        return Cell.CLOCK
    return Cell.GARBLED if any(c.isdigit() for c in text) else Cell.WORD


SHOWN = 24
"""Characters of a cell that a message shows."""


def quoted(cell: str) -> str:
    """A cell for a message: in quotes, not too long, what cannot be printed as an escape."""
    text = cell.strip()
    text = text if len(text) <= SHOWN else f"{text[:SHOWN]}..."
    plain = (c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)
    return f"'{''.join(plain)}'"
