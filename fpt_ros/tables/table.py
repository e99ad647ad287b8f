"""A table: columns of equal length, and remarks on how they were read."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fpt_ros.errors import BadInput


class Kind(StrEnum):
    """What the cells of a column are."""

    NUMBER = "numbers"
    BOOL = "true or false"
    TIME = "times"
    CLOCK = "times of day"
    TEXT = "words"


@dataclass(frozen=True)
class Column:
    """One column.

    Attributes:
        name: without the unit.
        kind: of the cells.
        values: (n,): numbers as float64 (NaN: missing) or int64, times as datetime64[ns], times of
            day as timedelta64[ns] since the first midnight (NaT: missing), words as objects.
        unit: of the numbers; empty where none is given. Of times ``UTC`` or empty.
        heading: as it stood in the file; by default made of name and unit.
        refusal: why the column cannot be taken as a signal; empty if it can.
    """

    name: str
    kind: Kind
    values: NDArray[Any]
    unit: str = ""
    heading: str = ""
    refusal: str = ""

    @property
    def numeric(self) -> bool:
        """Whether the column holds a signal: numbers, or true and false."""
        return self.kind in (Kind.NUMBER, Kind.BOOL)

    @property
    def title(self) -> str:
        """The heading with its unit."""
        return self.heading or titled(self.name, "" if self.kind is Kind.TIME else self.unit)

    def numbers(self) -> NDArray[np.float64]:
        """The values as floats (n,), NaN where one is missing.

        Raises:
            BadInput: the column holds no numbers, or a cell that can be no number.
        """
        if self.refusal:
            raise BadInput(self.refusal)
        return self.values.astype(np.float64)


@dataclass(frozen=True)
class Table:
    """Columns of equal length.

    Attributes:
        columns: each with another name.
        name: of the file.
        layout: how the file was read, as in ``separated by ';', decimal commas``.
        remarks: what a user should know: cells and lines that were not taken as they stood.
        lines: (n,) of the rows in a file of text; elsewhere ``None``.
    """

    columns: tuple[Column, ...]
    name: str
    layout: str = ""
    remarks: tuple[str, ...] = ()
    lines: NDArray[np.uint32] | None = None

    def __len__(self) -> int:
        """Number of rows."""
        return len(self.columns[0].values) if self.columns else 0

    def column(self, name: str) -> Column:
        """The column of this name or heading.

        Raises:
            BadInput: there is none; lists those of numbers.
        """
        for same in (
            lambda each: name in (each.title, each.heading),
            lambda each: name == each.name,
            lambda each: name.casefold() == each.name.casefold(),
        ):
            found = [each for each in self.columns if same(each)]
            if len(found) == 1:
                return found[0]
        names = ", ".join(each.title for each in self.columns if each.numeric) or "none"
        raise BadInput(f"{self.name} has no column '{name}': columns of numbers are {names}")

    def where(self, row: int) -> str:
        """A row in words, from 0: ``line 5`` of the file where it is text, else ``row 3``."""
        return f"row {row + 1}" if self.lines is None else f"line {self.lines[row]}"


def titled(name: str, unit: str) -> str:
    """A name with its unit, where there is one."""
    return f"{name} [{unit}]" if unit else name


def distinct(names: Sequence[str]) -> list[str]:
    """The names with ``.1``, ``.2`` behind those that were there before."""
    taken: set[str] = set()
    found = []
    for name in names:
        new, count = name, 0
        while new in taken or (count and new in names):
            count += 1
            new = f"{name}.{count}"
        taken.add(new)
        found.append(new)
    return found
