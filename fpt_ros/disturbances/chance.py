"""Chance as a law may have it: numbers that follow from its state, the same bits everywhere.

The generator x <- 48271 x mod (2^31 - 1) of Park and Miller (1988, revised 1993) is exact in
doubles, so nodes, engine and replay draw the same numbers, and what was drawn lies in the state.
"""

import math

from fpt_ros.laws import MutableVector

MODULUS = 2147483647.0
MULTIPLIER = 48271.0


def seed_of(seed: int, stream: int) -> float:
    """A first state for a stream of the run's seed: neighbours have nothing in common."""
    import numpy as np

    return float(np.random.default_rng((seed, stream)).integers(1, int(MODULUS)))


def uniform(state: MutableVector, first: float) -> float:
    """The next number in (0, 1); ``state[0]`` is zero before the first one, then ``first``."""
    x = state[0] if state[0] > 0.0 else first
    state[0] = x = MULTIPLIER * x % MODULUS
    return x / MODULUS


def normal(state: MutableVector, first: float) -> float:
    """The next number of a normal distribution of variance 1 (Box and Muller 1958)."""
    u = uniform(state, first)
    return math.sqrt(-2.0 * math.log(u)) * math.cos(2.0 * math.pi * uniform(state, first))
