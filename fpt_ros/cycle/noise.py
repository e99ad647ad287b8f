"""The measurement noise: unit normal numbers for each cycle, the same whoever asks when."""

from typing import TYPE_CHECKING

from fpt_ros.laws import Vector

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

BLOCK = 1024
"""Cycles whose numbers are drawn at once."""


class Noise:
    """Numbers for cycle after cycle, ``width`` each, from one seed.

    They are drawn block by block, in the order of the cycles: one that lies behind means to begin
    again, one far ahead to draw all that is between.
    """

    def __init__(self, seed: int, width: int) -> None:
        self._seed, self._width = seed, width
        self._drawn = 0  # blocks
        self._block: NDArray[np.float64] | None = None

    def of(self, cycle: int) -> Vector:
        """The numbers of a cycle."""
        numbers: list[float] = self._of_block(cycle // BLOCK)[cycle % BLOCK].tolist()
        return numbers

    def rows(self, first: int, out: "NDArray[np.float64]") -> None:
        """Write those of the cycles from ``first`` on, a row a cycle."""
        at = 0
        while at < len(out):
            block = self._of_block((first + at) // BLOCK)
            piece = block[(first + at) % BLOCK :][: len(out) - at]
            out[at : at + len(piece)] = piece
            at += len(piece)

    def at(self, cycles: "NDArray[np.int64]") -> "NDArray[np.float64]":
        """(N, width) numbers of N cycles."""
        import numpy as np

        blocks, found = cycles // BLOCK, np.empty((len(cycles), self._width))
        for number in np.unique(blocks).tolist():
            inside = blocks == number
            found[inside] = self._of_block(number)[cycles[inside] % BLOCK]
        return found

    def _of_block(self, number: int) -> "NDArray[np.float64]":
        import numpy as np

        if self._block is None or number < self._drawn - 1:
            self._generator, self._drawn = np.random.default_rng(self._seed), 0
        while self._drawn <= number:
            self._block = self._generator.standard_normal((BLOCK, self._width))
            self._drawn += 1
        assert self._block is not None
        return self._block
