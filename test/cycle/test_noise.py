"""The measurement noise in blocks is that of one long table."""

import numpy as np
import pytest

from fpt_ros.cycle.noise import BLOCK, Noise

CYCLES = 3 * BLOCK + 5


@pytest.fixture
def table():
    """What a generator gives at once, a row a cycle."""
    return np.random.default_rng(11).standard_normal(4 * CYCLES).reshape(CYCLES, 4)


def test_any_cycle_in_any_order(table):
    noise = Noise(11, 4)
    for cycle in (0, 1, BLOCK - 1, BLOCK, 3 * BLOCK + 1, 5, 2 * BLOCK, 2 * BLOCK - 1):
        assert noise.of(cycle) == table[cycle].tolist()


@pytest.mark.parametrize("size", [1, 7, BLOCK, BLOCK + 1, CYCLES])
def test_rows_of_any_length(table, size):
    noise, out = Noise(11, 4), np.empty((CYCLES, 4))
    for first in range(0, CYCLES, size):
        noise.rows(first, out[first : first + size])
    assert np.array_equal(out, table)
