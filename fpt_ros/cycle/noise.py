"""The noise of a run piece by piece: the numbers of the whole table, without the table."""

import numpy as np
from numpy.typing import NDArray

BLOCK = 8192
"""Cycles whose numbers are kept."""


class Noise:
    """Unit normal numbers of any cycles, as :meth:`PlantSimulator.noise` has them.

    Quick for cycles in ascending order: numbers of a cycle before the kept block are drawn again
    from the seed on.

    Args:
        seed: of the run.
        width: numbers a cycle: n for the positions, then n for the velocities.
        cycles: of the run; behind the last one the first comes again.

    Example:
        >>> Noise(seed=0, width=2, cycles=1000).rows(np.array([0, 1])).shape
        (2, 2)
    """

    def __init__(self, seed: int, width: int, cycles: int) -> None:
        self._seed, self._width, self._cycles = seed, width, cycles
        self._restart()

    def _restart(self) -> None:
        self._generator = np.random.default_rng(self._seed)
        self._block = -1
        self._table = np.empty((0, self._width))

    def rows(self, cycles: NDArray[np.int64]) -> NDArray[np.float64]:
        """(N, width) numbers of N cycles."""
        cycles = cycles % self._cycles
        blocks = cycles // BLOCK
        found = np.empty((len(cycles), self._width))
        for block in np.unique(blocks).tolist():
            self._seek(block)
            inside = blocks == block
            found[inside] = self._table[cycles[inside] - block * BLOCK]
        return found

    def _seek(self, block: int) -> None:
        if block < self._block:
            self._restart()
        while self._block < block:
            self._table = self._generator.standard_normal((BLOCK, self._width))
            self._block += 1
