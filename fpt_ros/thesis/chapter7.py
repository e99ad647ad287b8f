"""Chapter 7, the conclusions: noise and delay that the feedback brings into the loop."""

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from fpt_ros.analysis import signals, style
from fpt_ros.analysis.sizes import finite
from fpt_ros.analysis.tables import number_text
from fpt_ros.runs.run import Run
from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Drawn, Picture, Runs, Setup, Verdict
from fpt_ros.thesis.claim import Table as Rows
from fpt_ros.thesis.measures import (
    because,
    chatter,
    complete,
    end,
    factor_text,
    listed,
    rms,
    settled_rms,
)

TITLE = "Conclusions: noise and delay in the loop"

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


def _label(method: str, value: float) -> str:
    return f"{method}, {value:g}"


def _with(method: str, sigma: float, cycles: int = 0) -> Setup:
    """The loop with noise and delay."""
    late = (f"{DELAY}={cycles}",) * (cycles > 0)
    setup = METHODS[method]
    return replace(setup, settings=(*setup.settings, f"{NOISE}={sigma:g}", *late))


def _effort(run: Run) -> float:
    """Rms of the settled generalised forces, all together."""
    command = run.topics["command"]
    late = signals.settled(run, signals.seconds(run, command.stamps))
    return rms(np.sqrt(np.sum(command.vectors["effort"][late] ** 2, axis=1)))


def _cells(run: Run) -> tuple[str, ...]:
    """q3, q2, chatter and effort, or when control was lost."""
    if not complete(run):
        return (f"lost at {end(run):.2f} s", "", "", "")
    found = (settled_rms(run, "q3"), settled_rms(run, "q2"), chatter(run), _effort(run))
    return tuple(number_text(x) for x in found)


COLUMNS = ("q3, rms [m]", "q2, rms [rad]", "chatter", "effort, rms")


def _noise(runs: Runs) -> Verdict:
    rows = tuple(
        (f"{method}; sigma = {sigma:g}", *_cells(runs[_label(method, sigma)]))
        for method in METHODS
        for sigma in SIGMAS
    )
    lost = [s for s in SIGMAS if not complete(runs[_label(RAW, s)])]
    holds = [s for s in SIGMAS if complete(runs[_label(SYNCHRONISED, s)])]
    quiet, thesis = (settled_rms(runs[_label(m, 0.0)], "q3") for m in (SYNCHRONISED, RAW))
    measured: dict[str, float | str | None] = {
        "finite differences, sigma = 0.0001": _fate(runs[_label(RAW, 1e-4)]),
        "synchronised, sigma = 0.0001: q3 [m]": finite(
            settled_rms(runs[_label(SYNCHRONISED, 1e-4)], "q3")
        ),
        "without noise: q3, thesis / synchronised": thesis / quiet,
        "best filter for estimating alone, no noise": _fate(runs[_label(BEST, 0.0)]),
    }
    least = min(lost, default=math.inf)
    held = bool(lost) and len(holds) == len(SIGMAS)
    return Verdict(
        YES if held else NO,
        measured,
        because(
            held,
            f"Adaptive, with finite differences, the loop is lost from a noise of {least:g} on: "
            "the deformation feeds it back. A filter holds it, but the one that estimates best is "
            "too slow for the iteration, unless the deformation is based on r seen through the "
            "same filter (synchronised). Then a fast filter allows sixteen times the gain, and is "
            f"{factor_text(thesis / quiet)} times as precise as A = -0.1 of the thesis.",
        ),
        Rows(("loop; seed 1", *COLUMNS), rows),
    )


def _fate(run: Run) -> str | float | None:
    return finite(settled_rms(run, "q3")) if complete(run) else f"lost at {end(run):.2f} s"


THESIS = "thesis's law, no noise"
FAST = "fast Kalman filter"
LATE = [m for m in METHODS if m not in (RAW, BEST, FAST, f"{FAST}, not adaptive")]


def _delay(runs: Runs) -> Verdict:
    methods = [THESIS, *LATE]
    rows = tuple(
        (f"{method}; {cycles}", *_cells(runs[_label(method, cycles)]))
        for method in methods
        for cycles in DELAYS
    )
    last = {
        m: max((d for d in DELAYS if complete(runs[_label(m, d)])), default=-1) for m in methods
    }
    loss = {
        m: settled_rms(runs[_label(m, 1)], "q3") / settled_rms(runs[_label(m, 0)], "q3")
        for m in (THESIS, SYNCHRONISED)
    }
    lost = [m for m in methods if last[m] < max(DELAYS)]
    held = not lost and max(loss.values()) < 1.5
    return Verdict(
        YES if held else ONLY_IF if last[THESIS] == max(DELAYS) else NO,
        {
            **{f"{m}: holds up to [cycles]": d for m, d in last.items()},
            "q3 with one cycle of delay / without, thesis": loss[THESIS],
            "q3 with one cycle of delay / without, synchronised": loss[SYNCHRONISED],
        },
        "Only if precision may suffer: the state is taken to be newer than it is, so that the "
        "error grows by what the motion does in the delay, one cycle doubling that of the thesis's "
        f"law. Its low gain keeps it stable up to {last[THESIS]} cycles; {listed(lost)} are lost "
        "before. A synchronised deformation corrects for the filter's lag, not for this delay.",
        Rows(("loop; sigma = 0.0001; measurements late by [cycles]", *COLUMNS), rows),
    )


CURVES = (*style.COORDINATES, style.DEFORMED, style.INK, style.WANTED)


def _chart(runs: Runs, methods: list[str], values: tuple[float, ...]) -> list[draw.Curve]:
    """Settled error of q3 over noise or delay; a curve ends where control is lost."""
    curves = []
    for method, colour in zip(methods, CURVES, strict=False):
        found = [settled_rms(runs[_label(method, x)], "q3") for x in values]
        y = np.array([x if math.isfinite(x) else math.nan for x in found])
        line = {**style.thin(colour), "marker": "o", "markersize": 4}
        curves.append((np.array(values, dtype=np.float64), y, method, line))
    return curves


def noise_figure(runs: Runs) -> Drawn:
    """Errors over the noise."""
    shown = [m for m in METHODS if m not in (BEST, FAST, f"{FAST}, not adaptive")]
    title = "settled error; a curve ends where control is lost"
    floor = np.array([max(s, 1e-6) for s in SIGMAS])
    curves = [(floor, y, label, how) for _, y, label, how in _chart(runs, shown, SIGMAS)]
    cell = (title, "noise of the positions (leftmost: none)", "q3, rms [m]", curves)
    return draw.charts(cell, height=3.8, log="xy", aside=True)


def delay_figure(runs: Runs) -> Drawn:
    """Errors over the delay."""
    curves = _chart(runs, [THESIS, *LATE], DELAYS)
    title = "settled error; a curve ends where control is lost"
    cell = (title, "delay of the measurements [cycles of 1 ms]", "q3, rms [m]", curves)
    return draw.charts(cell, height=3.8, log="y", aside=True)


UPON = "The curve of the wavelet lies upon that of Savitzky-Golay."

CLAIMS: tuple[Claim[Run], ...] = (
    Claim(
        "7",
        "",
        "Sensor noise is brought into the system by the feedback, so that noisy measurements have "
        "to be addressed first.",
        {_label(m, s): _with(m, s) for m in METHODS for s in SIGMAS},
        _noise,
        (
            Picture("", "Noise and filters", noise_figure, UPON),
            Picture(
                "",
                "Tracking error with noise of 0.0001",
                draw.errors(
                    _label(RAW, 1e-4),
                    _label("Savitzky-Golay (31, 2)", 1e-4),
                    _label(SYNCHRONISED, 1e-4),
                ),
            ),
        ),
    ),
    Claim(
        "7",
        "",
        "The methods cope with imperfect, delayed measurements.",
        {
            **{_label(THESIS, d): Setup("tora", settings=(f"{DELAY}={d}",)) for d in DELAYS},
            **{_label(m, d): _with(m, 1e-4, d) for m in LATE for d in DELAYS},
        },
        _delay,
        (Picture("", "Delay and filters", delay_figure, UPON),),
    ),
)
