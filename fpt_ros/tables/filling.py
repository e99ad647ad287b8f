"""Columns that are filled chunk by chunk with the cells of a text."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fpt_ros.tables import times
from fpt_ros.tables.cells import Cell, kind, number, quoted, truth
from fpt_ros.tables.table import Column, Kind


@dataclass(frozen=True)
class Odd:
    """A cell that is not of its column's kind."""

    line: int
    cell: str

    def __str__(self) -> str:
        """The cell for a message, on one line."""
        return quoted(self.cell)


@dataclass
class Filling:
    """A column in the making.

    Attributes:
        kind: of its cells, as the head of the file has them.
        decimal: the decimal mark.
        parts: what has been converted.
        words: cells that are words: their samples count as missing.
        garbled: the first cells with digits that are no numbers.
        spoiled: how many of those there are.
        odd: the first cell of a column of words.
        whole: whether all numbers are whole.
        zone: whether times name their zone.
    """

    kind: Cell
    decimal: str
    parts: list[NDArray[Any]] = field(default_factory=list)
    words: list[Odd] = field(default_factory=list)
    garbled: list[Odd] = field(default_factory=list)
    spoiled: int = 0
    whole: bool = True
    zone: bool = False
    odd: Odd | None = None

    def add(self, cells: Sequence[str], lines: Sequence[int]) -> None:
        """Convert the cells of the next rows; ``lines``: theirs in the file."""
        if self.kind in (Cell.NUMBER, Cell.MISSING):
            part = self._numbers(cells)
        elif self.kind is Cell.BOOL:
            part = np.array([truth(cell) for cell in cells])
        elif self.kind is Cell.TIME:
            part, zone = times.times(cells)
            self.zone |= zone
        elif self.kind is Cell.CLOCK:
            part = times.clocks(cells)
        else:
            part = np.array(cells, dtype=object)
            if self.odd is None:
                self.odd = self._first_odd(cells, lines)
        if part.dtype.kind in "fmM":
            lost = np.isnan(part) if part.dtype.kind == "f" else np.isnat(part)
            for at in np.flatnonzero(lost).tolist():
                self._look(Odd(lines[at], cells[at]))
        self.parts.append(part)

    def _first_odd(self, cells: Sequence[str], lines: Sequence[int]) -> Odd | None:
        for cell, line in zip(cells, lines, strict=False):
            if kind(cell, self.decimal) not in (Cell.MISSING, Cell.NUMBER):
                return Odd(line, cell)
        return None

    def _numbers(self, cells: Sequence[str]) -> NDArray[Any]:
        joined = "".join(cells)
        if not ("_" in joined or (self.decimal == "," and "." in joined)):
            if self.whole:
                try:
                    return np.array(list(map(int, cells)), dtype=np.int64)
                except (ValueError, OverflowError):
                    pass
            try:
                plain = [c.replace(",", ".") for c in cells] if self.decimal == "," else cells
                return self._floats(np.array(list(map(float, plain)), dtype=np.float64))
            except ValueError:
                pass
        return self._floats(np.array([number(cell, self.decimal) for cell in cells]))

    def _floats(self, part: NDArray[np.float64]) -> NDArray[np.float64]:
        self.whole = False
        return part

    def _look(self, odd: Odd) -> None:
        """Note a cell that did not become what its column is."""
        what = kind(odd.cell, self.decimal)
        if what is Cell.MISSING:
            return
        if (
            what is Cell.WORD
            or (what is Cell.BOOL and self.kind is Cell.NUMBER)
            or ("\0" in odd.cell)
        ):
            self.words.append(odd)
            return
        self.spoiled += 1
        if len(self.garbled) < 3:
            self.garbled.append(odd)

    @property
    def comma(self) -> bool:
        """Whether a cell that is garbled is a number with a decimal comma."""
        return any(kind(odd.cell, ",") is Cell.NUMBER for odd in self.garbled)

    def column(self, name: str, heading: str, unit: str) -> Column:
        """The column, now that all its cells are there."""
        values = _joined(self.parts)
        if self.kind in (Cell.WORD, Cell.GARBLED):
            where = f": line {self.odd.line} is {self.odd}" if self.odd else ""
            plain = ", write plain numbers" if self.kind is Cell.GARBLED else ""
            refusal = f"column '{name}' is not numbers{where}{plain}"
            return Column(name, Kind.TEXT, values, unit, heading, refusal)
        if self.kind is Cell.TIME:
            unit = "UTC" if self.zone else ""
        kinds = {Cell.TIME: Kind.TIME, Cell.CLOCK: Kind.CLOCK, Cell.BOOL: Kind.BOOL}
        refusal = ""
        if self.garbled:
            more = f", and {self.spoiled - 1} more are like it" if self.spoiled > 1 else ""
            need = "a time" if self.kind in (Cell.TIME, Cell.CLOCK) else "a number"
            odd = self.garbled[0]
            refusal = f"line {odd.line}: {name} is {odd}, no {need[2:]}{more}: write {need} there"
        elif 2 * len(self.words) > len(values):
            odd = self.words[0]
            refusal = f"column '{name}' is not numbers: line {odd.line} is {odd}"
        return Column(name, kinds.get(self.kind, Kind.NUMBER), values, unit, heading, refusal)


def _joined(parts: list[NDArray[Any]]) -> NDArray[Any]:
    """The parts as one array; they are let go one by one."""
    if not parts:
        return np.empty(0)
    found = np.empty(sum(map(len, parts)), dtype=np.result_type(*{part.dtype for part in parts}))
    at = 0
    parts.reverse()
    while parts:
        part = parts.pop()
        found[at : at + len(part)] = part
        at += len(part)
    return found
