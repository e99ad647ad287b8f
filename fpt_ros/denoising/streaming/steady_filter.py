"""The steady Kalman filter of a motion that is an integrated Wiener process."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fpt_ros.errors import BadInput


def riccati(transition: NDArray[np.float64], noise: NDArray[np.float64]) -> NDArray[np.float64]:
    """The steady covariance of the prediction, position measured with unit variance.

    Solves P = F P F' - F P c (1 + c' P c)^-1 c' P F' + Q with c = (1, 0, ..), by doubling: step k
    is 2^k iterations of the equation at once.

    Raises:
        BadInput: no convergence in floating point.
    """
    size = len(noise)
    A, H = transition.T.copy(), noise.copy()
    G = np.zeros((size, size))
    G[0, 0] = 1.0
    for _ in range(60):
        W = np.linalg.inv(np.eye(size) + G @ H)
        step = A.T @ H @ W @ A
        A, G, H = A @ W @ A, G + A @ W @ G @ A.T, H + 0.5 * (step + step.T)
        if not np.all(np.isfinite(H)):
            break
        if np.max(np.abs(step)) <= 1e-15 * np.max(np.abs(H)):
            return H
    raise BadInput("the Riccati equation of a Kalman filter has no solution in floating point")


class Prediction(NamedTuple):
    """A steady filter in its own unit of time, where all numbers are of order one.

    ``covariance`` of the prediction, ``noise`` of a step and ``transition`` are of the states
    q^(i) unit^i / i!, position measured with unit variance; ``h`` is dt / unit.
    """

    covariance: NDArray[np.float64]
    noise: NDArray[np.float64]
    transition: NDArray[np.float64]
    h: float


def steady_prediction(states: int, density: float, sigma: float, dt: float) -> Prediction:
    """The steady filter; its unit of time is (sigma^2 dt / density)^(1/(2 states))."""
    unit = (sigma * sigma * dt / density) ** (0.5 / states)
    if not 0.0 < unit < math.inf:
        raise BadInput(f"sigma = {sigma:g} and density = {density:g}: out of the range of numbers")
    h = dt / unit
    order = np.arange(states)
    power = order[None, :] - order[:, None]
    choose = np.array([[math.comb(j, i) for j in range(states)] for i in range(states)])
    transition = np.where(power >= 0, choose * h ** np.maximum(power, 0), 0.0)
    factorial = np.array([math.factorial(i) for i in range(states)], dtype=float)
    back = factorial * factorial[::-1]  # i! (states - 1 - i)!
    exponent = 2 * states - 1 - order[:, None] - order[None, :]
    noise = h**exponent / (exponent * back[:, None] * back[None, :]) * h
    return Prediction(riccati(transition, noise), noise, transition, h)


def steady_gains(states: int, density: float, sigma: float, dt: float) -> NDArray[np.float64]:
    """Gains of the scaled states, by which the innovation corrects them."""
    P, _, _, h = steady_prediction(states, density, sigma, dt)
    gains: NDArray[np.float64] = P[:, 0] / (1.0 + P[0, 0]) * h ** np.arange(states)
    return gains
