"""The loops of chapter 7: a noisy TORA with different filters."""

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from fpt_ros.analysis import signals, style
from fpt_ros.analysis.sizes import finite
from fpt_ros.analysis.tables import number_text
from fpt_ros.runs.run import Run
from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.measures import chatter, complete, end, rms, settled_rms
from fpt_ros.thesis.setup import Runs, Setup

LOOP = "noisy_tora"
NOISE = "plant_simulator.noise.position"
DELAY = "plant_simulator.measurement_delay"
SIGMAS = (0.0, 1e-5, 1e-4, 1e-3)
"""Standard deviation of the noise of all three positions [rad, m]."""

DELAYS = (0, 1, 2, 3, 5, 10, 20)
"""Cycles of 1 ms by which measurements come late."""

BANK = ("denoiser.states=[3, 4, 5, 6]", "denoiser.densities=[1e2, 1e4, 1e6, 1e8]")
PLAIN = ("fpt_deformer.synchronised=false", "denoiser.synchronised=false")
METHODS: Mapping[str, Setup] = {
    "finite differences": Setup(LOOP, "raw", ()),
    "finite differences, not adaptive": Setup(
        "tora",
        "nonadaptive",
        ("plant_simulator.measured=position", "denoiser.method=finite_difference"),
    ),
    "Savitzky-Golay (31, 2)": Setup(LOOP, "savgol", ()),
    "wavelet, window of 64": Setup(LOOP, "wavelet", ()),
    "bank of four Kalman filters": Setup(
        LOOP, "adaptive", (*BANK, *PLAIN, "fpt_deformer.A=-0.126")
    ),
    "bank of four, synchronised": Setup(LOOP, "adaptive", BANK),
    "fast Kalman filter": Setup(LOOP, "adaptive", (*PLAIN, "fpt_deformer.A=-0.126")),
    "fast Kalman filter, not adaptive": Setup(LOOP, "nonadaptive"),
    "fast Kalman filter, synchronised": Setup(LOOP, "adaptive", ()),
}
"""A = -0.126 of the stretched sigmoid is the gain of A = -0.1 of the thesis."""

RAW, BEST, SYNCHRONISED = "finite differences", "bank of four Kalman filters", [*METHODS][-1]


def loop_key(method: str, value: float) -> str:
    """The key of a loop with a noise or a delay."""
    return f"{method}, {value:g}"


def loop_with(method: str, sigma: float, cycles: int = 0) -> Setup:
    """The loop with noise and delay."""
    late = (f"{DELAY}={cycles}",) * (cycles > 0)
    setup = METHODS[method]
    return replace(setup, settings=(*setup.settings, f"{NOISE}={sigma:g}", *late))


def _effort(run: Run) -> float:
    """Rms of the settled generalised forces, all together."""
    command = run.topics["command"]
    late = signals.settled(run, signals.seconds(run, command.stamps))
    return rms(np.sqrt(np.sum(command.vectors["effort"][late] ** 2, axis=1)))


def table_cells(run: Run) -> tuple[str, ...]:
    """q3, q2, chatter and effort, or when control was lost."""
    if not complete(run):
        return (f"lost at {end(run):.2f} s", "", "", "")
    found = (settled_rms(run, "q3"), settled_rms(run, "q2"), chatter(run), _effort(run))
    return tuple(number_text(x) for x in found)


COLUMNS = ("q3, rms [m]", "q2, rms [rad]", "chatter", "effort, rms")


def fate_of(run: Run) -> str | float | None:
    """Settled error of q3 [m], or when control was lost."""
    return finite(settled_rms(run, "q3")) if complete(run) else f"lost at {end(run):.2f} s"


FAST = "fast Kalman filter"
CURVES = (*style.COORDINATES, style.DEFORMED, style.INK, style.WANTED)


def error_curves(runs: Runs, methods: list[str], values: tuple[float, ...]) -> list[draw.Curve]:
    """Settled error of q3 over noise or delay; a curve ends where control is lost."""
    curves = []
    for method, colour in zip(methods, CURVES, strict=False):
        found = [settled_rms(runs[loop_key(method, x)], "q3") for x in values]
        y = np.array([x if math.isfinite(x) else math.nan for x in found])
        line = {**style.thin(colour), "marker": "o", "markersize": 4}
        curves.append((np.array(values, dtype=np.float64), y, method, line))
    return curves


UPON = "The curve of the wavelet lies upon that of Savitzky-Golay."
