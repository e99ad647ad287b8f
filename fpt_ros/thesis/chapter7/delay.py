"""Chapter 7: measurements that come late."""

from fpt_ros.runs.run import Run
from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.chapter7.loops import (
    BEST,
    COLUMNS,
    DELAY,
    DELAYS,
    FAST,
    METHODS,
    RAW,
    SYNCHRONISED,
    UPON,
    error_curves,
    loop_key,
    loop_with,
    table_cells,
)
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Drawn, Picture, Verdict
from fpt_ros.thesis.claim import Table as Rows
from fpt_ros.thesis.measures import complete, settled_rms
from fpt_ros.thesis.setup import Runs, Setup
from fpt_ros.thesis.words import listed

THESIS = "thesis's law, no noise"
LATE = [m for m in METHODS if m not in (RAW, BEST, FAST, f"{FAST}, not adaptive")]


def _delay(runs: Runs) -> Verdict:
    methods = [THESIS, *LATE]
    rows = tuple(
        (f"{method}; {cycles}", *table_cells(runs[loop_key(method, cycles)]))
        for method in methods
        for cycles in DELAYS
    )
    last = {
        m: max((d for d in DELAYS if complete(runs[loop_key(m, d)])), default=-1) for m in methods
    }
    loss = {
        m: settled_rms(runs[loop_key(m, 1)], "q3") / settled_rms(runs[loop_key(m, 0)], "q3")
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


def delay_figure(runs: Runs) -> Drawn:
    """Errors over the delay."""
    curves = error_curves(runs, [THESIS, *LATE], DELAYS)
    title = "settled error; a curve ends where control is lost"
    cell = (title, "delay of the measurements [cycles of 1 ms]", "q3, rms [m]", curves)
    return draw.charts(cell, height=3.8, log="y", aside=True)


CLAIMS: tuple[Claim[Run], ...] = (
    Claim(
        "7",
        "",
        "The methods cope with imperfect, delayed measurements.",
        {
            **{loop_key(THESIS, d): Setup("tora", settings=(f"{DELAY}={d}",)) for d in DELAYS},
            **{loop_key(m, d): loop_with(m, 1e-4, d) for m in LATE for d in DELAYS},
        },
        _delay,
        (Picture("", "Delay and filters", delay_figure, UPON),),
    ),
)
