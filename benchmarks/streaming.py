"""Filters of the loop: time a sample, and errors, against the naive way on NumPy.

One coordinate at 1 kHz, noise of 1e-3. The filters run as in the engine, compiled, and called by
pointer. The naive way computes the same estimates as one writes them down: a polynomial fitted by
np.polyfit to every window, matrix Kalman filters whose covariances are propagated at every sample,
and PyWavelets on every window. That both give the same is checked before anything is timed.
"""

import math
from collections.abc import Callable
from time import perf_counter
from typing import Any

import numpy as np
import pywt
from measure import alternate, arguments, median, show
from numba import njit
from numpy.typing import NDArray

from fpt_ros.denoising import streaming
from fpt_ros.engine import compiled
from fpt_ros.parameters import Value, resolve

Array = NDArray[np.float64]
DT = SIGMA = 1e-3
SEEDS = range(10)
SETTLED = 1000


@njit
def filtered(update: Any, constants: Array, state: Array, q: Array, v: Array, out: Array) -> None:
    """All samples through a filter; ``out``, shape (samples, 3, 1)."""
    for k in range(1, len(q)):
        update(constants, state, DT, q[k], v, out[k, 0], out[k, 1], out[k, 2])


def run_filter(name: str, q: Array, settings: dict[str, Value]) -> tuple[Array, float]:
    """Estimates of q, v and response (samples, 3), and seconds a sample."""
    law = streaming.FILTERS[name]
    values = resolve((streaming.ORDER, *law.parameters), settings, name)
    constants = np.array(law.prepare(values, 1, DT))
    state = np.zeros(law.state_size(constants, 1))
    samples, v = q.reshape(-1, 1), np.array([math.nan])
    out = np.full((len(q), 3, 1), math.nan)
    update = compiled.law(law.update, streaming.Update)
    for rest in (samples[:2], samples):  # the first time it is compiled
        state[:] = 0.0
        law.start(constants, state, q[:1], v)
        started = perf_counter()
        filtered(update, constants, state, rest, v, out)
        took = perf_counter() - started
    return out[:, :, 0], took / len(q)


def naive_savgol(q: Array, window: int, degree: int) -> Array:
    """A polynomial through every window, at its newest sample."""
    x = (np.arange(window) - (window - 1)) * DT
    out = np.full((len(q), 3), math.nan)
    for k in range(window - 1, len(q)):
        p = np.polynomial.polynomial.polyfit(x, q[k - window + 1 : k + 1], degree)
        out[k] = p[0], p[1], 2 * p[2]
    return out


def naive_kalman(q: Array, states: tuple[int, ...], densities: tuple[float, ...]) -> Array:
    """Matrix Kalman filters mixed by likelihood; without the gate of impulses."""
    filters = []
    for n, density in zip(states, densities, strict=True):
        F, Q = np.eye(n), np.empty((n, n))
        for i in range(n):
            for j in range(n):
                if j > i:
                    F[i, j] = DT ** (j - i) / math.factorial(j - i)
                a, b = n - 1 - i, n - 1 - j
                Q[i, j] = density * DT ** (a + b + 1)
                Q[i, j] /= math.factorial(a) * math.factorial(b) * (a + b + 1)
        x = np.zeros(n)
        x[0] = q[0]
        filters.append([F, Q, np.eye(n) * 1e3, x, 0.0])
    out = np.full((len(q), 3), math.nan)
    for k in range(1, len(q)):
        for each in filters:
            F, Q, P, x, loglik = each
            x, P = F @ x, F @ P @ F.T + Q
            S = P[0, 0] + SIGMA**2
            r = q[k] - x[0]
            K = P[:, 0] / S
            each[2:] = (
                P - np.outer(K, P[0]),
                x + K * r,
                0.99 * loglik - 0.5 * (min(r * r / S, 16.0) + math.log(S)),
            )
        weight = np.array([each[4] for each in filters])
        weight = np.exp(weight - weight.max())
        out[k] = weight @ np.array([each[3][:3] for each in filters]) / weight.sum()
    return out


def naive_wavelet(q: Array, window: int, fit: int, degree: int) -> Array:
    """PyWavelets on every window, and a polynomial through its newest samples."""
    x = (np.arange(fit) - (fit - 1)) * DT
    bound = SIGMA * math.sqrt(2 * math.log(window))
    out = np.full((len(q), 3), math.nan)
    for k in range(window - 1, len(q)):
        bands = pywt.wavedec(q[k - window + 1 : k + 1], "sym4", "antireflect", level=3)
        bands[1:] = [pywt.threshold(band, bound, "soft") for band in bands[1:]]
        smooth = pywt.waverec(bands, "sym4", "antireflect")[:window]
        p = np.polynomial.polynomial.polyfit(x, smooth[-fit:], degree)
        out[k] = p[0], p[1], 2 * p[2]
    return out


BANK = (3, 4, 5, 6), (1e2, 1e4, 1e6, 1e8)
CASES: dict[str, tuple[str, dict[str, Value], Callable[[Array], Array], float]] = {
    "savgol, window 35, degree 3": (
        "savgol",
        {"window": 35, "degree": 3},
        lambda q: naive_savgol(q, 35, 3),
        1e-9,
    ),
    "savgol, window 141, degree 3": (
        "savgol",
        {"window": 141, "degree": 3},
        lambda q: naive_savgol(q, 141, 3),
        1e-9,
    ),
    "kalman_bank of four": ("kalman_bank", {"sigma": SIGMA}, lambda q: naive_kalman(q, *BANK), 0.2),
    "wavelet, window 256": (
        "wavelet",
        {"window": 256},
        lambda q: naive_wavelet(q, 256, 141, 3),
        0.1,
    ),
}
"""Filter, settings, the naive way, and how far apart the accelerations may be, relative to their
rms: steady-state gains are not those of the start, and windows are extended otherwise."""


def two_sines(n: int) -> tuple[Array, Array, Array]:
    """Position, velocity and acceleration of sin 2t + 0.3 sin 7t."""
    t = np.arange(n) * DT
    return (
        np.sin(2 * t) + 0.3 * np.sin(7 * t),
        2 * np.cos(2 * t) + 2.1 * np.cos(7 * t),
        -4 * np.sin(2 * t) - 14.7 * np.sin(7 * t),
    )


def bang_bang(n: int) -> tuple[Array, Array, Array]:
    """The same of an acceleration of 5 that changes its sign every 0.5 s."""
    at = np.arange(n) * DT
    half = np.floor(at / 0.5 + 1e-9)
    tau, sign = at - 0.5 * half, np.where(half % 2, -1.0, 1.0)
    return sign * 2.5 * tau * (tau - 0.5), sign * 5 * (tau - 0.25), sign * 5.0


def errors(name: str, settings: dict[str, Value]) -> list[float]:
    """Rms errors of velocity and acceleration, sine and bang-bang, mean of ten seeds."""
    found = []
    for motion in (two_sines, bang_bang):
        q, v, a = motion(10_000)
        squares = []
        for seed in SEEDS:
            noisy = q + SIGMA * np.random.default_rng(seed).standard_normal(len(q))
            out, _ = run_filter(name, noisy, settings)
            late = slice(SETTLED, None)
            squares.append([np.mean((out[late, i] - x[late]) ** 2) for i, x in ((1, v), (2, a))])
        found += np.mean(np.sqrt(squares), axis=0).tolist()
    return found


def main() -> None:
    """Check, measure, and print the table."""
    options = arguments(__doc__ or "", samples=100_000)
    q = two_sines(options.samples)[0]
    q += SIGMA * np.random.default_rng(0).standard_normal(len(q))
    few = q[:4000]
    rows = []
    for title, (name, settings, naive, tolerance) in CASES.items():
        late = slice(SETTLED, None)
        ours, other = run_filter(name, few, settings)[0][late, 2], naive(few)[late, 2]
        apart = float(np.sqrt(np.mean((ours - other) ** 2)) / np.std(other))
        if not apart <= tolerance:
            raise RuntimeError(f"{title}: engine and naive way differ by {apart:.2g}")

        def timed(name: str = name, settings: dict[str, Value] = settings) -> float:
            return 1e6 * run_filter(name, q, settings)[1]

        def timed_naive(naive: Callable[[Array], Array] = naive) -> float:
            started = perf_counter()
            naive(few)
            return 1e6 * (perf_counter() - started) / len(few)

        found = median(
            alternate({title: timed, f"{title}, naive": timed_naive}, options.runs, options.json)
        )
        velocity, acceleration, velocity_bang, acceleration_bang = errors(name, settings)
        rows.append(
            {
                "filter": title,
                "us a sample": found[title],
                "naive, us": found[f"{title}, naive"],
                "times faster": found[f"{title}, naive"] / found[title],
                "q', sine": velocity,
                "q'', sine": acceleration,
                "q', bang-bang": velocity_bang,
                "q'', bang-bang": acceleration_bang,
            }
        )
    show("Filters at 1 kHz, one coordinate, noise 1e-3", rows, options.json)


if __name__ == "__main__":
    main()
