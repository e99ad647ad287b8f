"""Chapter 7: noise of the measurements in the loop."""

import math

import numpy as np

from fpt_ros.analysis.sizes import finite
from fpt_ros.runs.run import Run
from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.chapter7.loops import (
    BEST,
    COLUMNS,
    FAST,
    METHODS,
    RAW,
    SIGMAS,
    SYNCHRONISED,
    UPON,
    error_curves,
    fate_of,
    loop_key,
    loop_with,
    table_cells,
)
from fpt_ros.thesis.claim import NO, YES, Claim, Drawn, Picture, Verdict
from fpt_ros.thesis.claim import Table as Rows
from fpt_ros.thesis.measures import complete, settled_rms
from fpt_ros.thesis.setup import Runs
from fpt_ros.thesis.words import because, factor_text


def _noise(runs: Runs) -> Verdict:
    rows = tuple(
        (f"{method}; sigma = {sigma:g}", *table_cells(runs[loop_key(method, sigma)]))
        for method in METHODS
        for sigma in SIGMAS
    )
    lost = [s for s in SIGMAS if not complete(runs[loop_key(RAW, s)])]
    holds = [s for s in SIGMAS if complete(runs[loop_key(SYNCHRONISED, s)])]
    quiet, thesis = (settled_rms(runs[loop_key(m, 0.0)], "q3") for m in (SYNCHRONISED, RAW))
    measured: dict[str, float | str | None] = {
        "finite differences, sigma = 0.0001": fate_of(runs[loop_key(RAW, 1e-4)]),
        "synchronised, sigma = 0.0001: q3 [m]": finite(
            settled_rms(runs[loop_key(SYNCHRONISED, 1e-4)], "q3")
        ),
        "without noise: q3, thesis / synchronised": thesis / quiet,
        "best filter for estimating alone, no noise": fate_of(runs[loop_key(BEST, 0.0)]),
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


def noise_figure(runs: Runs) -> Drawn:
    """Errors over the noise."""
    shown = [m for m in METHODS if m not in (BEST, FAST, f"{FAST}, not adaptive")]
    title = "settled error; a curve ends where control is lost"
    floor = np.array([max(s, 1e-6) for s in SIGMAS])
    curves = [(floor, y, label, how) for _, y, label, how in error_curves(runs, shown, SIGMAS)]
    cell = (title, "noise of the positions (leftmost: none)", "q3, rms [m]", curves)
    return draw.charts(cell, height=3.8, log="xy", aside=True)


CLAIMS: tuple[Claim[Run], ...] = (
    Claim(
        "7",
        "",
        "Sensor noise is brought into the system by the feedback, so that noisy measurements have "
        "to be addressed first.",
        {loop_key(m, s): loop_with(m, s) for m in METHODS for s in SIGMAS},
        _noise,
        (
            Picture("", "Noise and filters", noise_figure, UPON),
            Picture(
                "",
                "Tracking error with noise of 0.0001",
                draw.errors(
                    loop_key(RAW, 1e-4),
                    loop_key("Savitzky-Golay (31, 2)", 1e-4),
                    loop_key(SYNCHRONISED, 1e-4),
                ),
            ),
        ),
    ),
)
