"""How certain the ladder of Kalman filters is of what it estimates."""

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from fpt_ros.denoising.streaming.ladder import (
    BANDWIDTH,
    BEST,
    COST,
    GAP,
    HEADER,
    MEMBER,
    MEMBERS,
    SHARED,
    SIGMA,
    STATES,
    memory,
    weight_of,
)
from fpt_ros.denoising.streaming.steady_filter import steady_prediction
from fpt_ros.laws import Vector

LONGEST_GAP = 1000
"""Missing samples [1] over which the deviation grows."""


def weights(constants: Vector, state: Vector, c: int) -> list[float]:
    """Weight of each member in the estimates of coordinate c, the slowest first."""
    members = int(constants[0])
    believed = c * memory(members) + SHARED
    costs = believed + MEMBERS + COST * members
    found = [weight_of(state[costs + m] - state[believed + BEST]) for m in range(members)]
    return [w / math.fsum(found) for w in found]


@lru_cache(maxsize=4096)
def covariance(h: float, gap: int) -> NDArray[np.float64]:
    """Of the scaled states in noise of variance 1, ``gap`` samples after the newest one."""
    P, noise, F, _ = steady_prediction(STATES, h ** (2 * STATES), 1.0, 1.0)
    P = P - np.outer(P[:, 0], P[0]) / (1.0 + P[0, 0])
    for _ in range(gap):
        P = F @ P @ F.T + noise
    scale = h ** np.arange(STATES)
    scaled: NDArray[np.float64] = P * np.outer(scale, scale)
    return scaled


def deviation(constants: Vector, state: Vector, c: int) -> tuple[float, float, float]:
    """Standard deviations of position, velocity and response of coordinate c, as they are now.

    The variance of the mixture: the mean of the members', and their spread.
    """
    members, rate = int(constants[0]), constants[3]
    first = c * memory(members)
    gap = min(int(state[first + GAP]), LONGEST_GAP)
    sigma, w = state[first + SHARED + SIGMA], np.array(weights(constants, state, c))
    found = []
    for i, unit in enumerate((1.0, rate, 2.0 * rate * rate)):
        at = first + SHARED + MEMBERS + i * members
        x = np.array([state[at + m] for m in range(members)])
        own = [
            covariance(constants[HEADER + MEMBER * m + BANDWIDTH], gap)[i, i]
            for m in range(members)
        ]
        spread = float(w @ (x - w @ x) ** 2)
        found.append(unit * math.sqrt(sigma * sigma * float(w @ np.array(own)) + spread))
    return found[0], found[1], found[int(constants[2])]
