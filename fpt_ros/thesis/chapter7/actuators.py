"""Chapter 7: commands that come late, are lost or limited, with and without anti-windup."""

import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from fpt_ros.analysis import style
from fpt_ros.runs.run import Run
from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Drawn, Picture, Table, Verdict
from fpt_ros.thesis.measures import complete, end, settled_rms
from fpt_ros.thesis.setup import Runs, Setup
from fpt_ros.thesis.words import text

ACTUATORS = "plant_simulator.actuators"
LAWS: Mapping[str, tuple[str, ...]] = {
    "thesis's law": (),
    "acted": ("fpt_deformer.anti_windup=acted",),
    "not adaptive": ("fpt_deformer.adaptive_from=1e9",),
}
THESIS, ACTED, PLAIN = LAWS

LATE = (0, 1, 2, 5, 10, 20)
"""Cycles of 1 ms by which all commands come late."""

LOST = (0.003, 0.01, 0.03, 0.1)
"""Mean length of bursts in which commands are lost, twice a second [s]."""

LIMITS = (8.0, 7.0, 6.5, 6.0, 5.0)
"""Of the effort of the van der Pol oscillator; the first one does not matter."""

SHORT = 5
"""Cycles that a network makes late, if it does."""


def _late(cycles: int, law: str) -> Setup:
    own = (f"{ACTUATORS}.kinds=[late]", f"{ACTUATORS}.late.cycles={cycles}") if cycles else ()
    return Setup("tora", settings=(*own, *LAWS[law]))


def _lost(length: float, law: str) -> Setup:
    own = f"{ACTUATORS}.kinds=[dropouts]", f"{ACTUATORS}.dropouts.length={length:g}"
    return Setup("tora", settings=(*own, *LAWS[law]))


def _limited(limit: float, law: str) -> Setup:
    own = f"{ACTUATORS}.kinds=[saturation]", f"{ACTUATORS}.saturation.limit={limit:g}"
    return Setup("vdp_second_order", settings=(*own, *LAWS[law]))


def _key(law: str, what: str, size: float) -> str:
    return f"{law}, {what} {size:g}"


WHAT = {"late": ("q3", LATE), "lost": ("q3", LOST), "limited": ("q1", LIMITS)}
HEADINGS = {
    "late": "TORA, all commands late by {:g} cycles: q3 [m]",
    "lost": "TORA, commands lost in bursts of {:g} s: q3 [m]",
    "limited": "van der Pol, effort limited to {:g}: q1",
}


def _error(runs: Runs, law: str, what: str, size: float) -> float:
    run = runs[_key(law, what, size)]
    return settled_rms(run, WHAT[what][0]) if complete(run) else math.inf


def _cell(runs: Runs, law: str, what: str, size: float) -> str:
    run = runs[_key(law, what, size)]
    return text(_error(runs, law, what, size)) if complete(run) else f"lost at {end(run):.2f} s"


def _copes(runs: Runs) -> Verdict:
    rows = tuple(
        (HEADINGS[what].format(size), *(_cell(runs, law, what, size) for law in LAWS))
        for what, (_, sizes) in WHAT.items()
        for size in sizes
    )
    whole = _error(runs, THESIS, "late", 0)
    late = {law: _error(runs, law, "late", SHORT) / whole for law in (THESIS, ACTED)}
    lost = {law: _error(runs, law, "lost", LOST[1]) / whole for law in (THESIS, ACTED)}
    hard = min(LIMITS)
    limited = {law: _error(runs, law, "limited", hard) for law in LAWS}
    bears = max(*late.values(), *lost.values()) < 1.5
    needs = limited[THESIS] > 2.0 * limited[PLAIN]
    helps = limited[ACTED] < 1.2 * limited[PLAIN]
    return Verdict(
        ONLY_IF if bears and needs and helps else YES if bears and not needs else NO,
        {
            **{f"q3, late by {SHORT} cycles / in time, {law}": x for law, x in late.items()},
            **{f"q3, bursts of 10 ms / none, {law}": x for law, x in lost.items()},
            **{
                f"q3, bursts of {1e3 * length:g} ms, {law} [m]": text(
                    _error(runs, law, "lost", length)
                )
                for length in LOST[2:]
                for law in LAWS
            },
            **{f"van der Pol, q1, |u| < {hard:g}, {law}": text(x) for law, x in limited.items()},
        },
        "Only if the effort is not limited. Late commands, and ones that are lost for some cycles, "
        "leave the thesis's law as it is: it goes on from its own last r. Where the effort is cut "
        "that r runs away, and the error with it; anti_windup: acted goes on from what the model "
        "makes of the effort that acted, and is no worse than no adaptation.",
        Table(("circumstance", *LAWS), rows),
    )


Cell = tuple[str, str, str, Sequence[draw.Curve]]


def _chart(runs: Runs, what: str, title: str, label: str) -> Cell:
    sizes: Sequence[float] = WHAT[what][1]
    curves: list[draw.Curve] = []
    for law, colour in zip(LAWS, style.COORDINATES, strict=False):
        found = np.array([_error(runs, law, what, size) for size in sizes])
        found[np.isinf(found)] = math.nan
        line = {**style.thin(colour), "marker": "o", "markersize": 4}
        curves.append((np.array(sizes, dtype=np.float64), found, law, line))
    return title, label, "error, rms", curves


def figure(runs: Runs) -> Drawn:
    """Errors over latency, length of bursts, and limit."""
    return draw.charts(
        _chart(runs, "late", "TORA, q3 [m]", "commands late by [cycles of 1 ms]"),
        _chart(runs, "lost", "TORA, q3 [m]", "bursts of lost commands [s]"),
        _chart(runs, "limited", "van der Pol, q1", "limit of the effort"),
        height=3.8,
        log="y",
    )


SETUPS: Mapping[str, Callable[..., Setup]] = {"late": _late, "lost": _lost, "limited": _limited}

CLAIMS: tuple[Claim[Run], ...] = (
    Claim(
        "7",
        "",
        "The methods cope with commands that come late, are lost, or are limited.",
        {
            _key(law, what, size): SETUPS[what](size, law)
            for what, (_, sizes) in WHAT.items()
            for law in LAWS
            for size in sizes
        },
        _copes,
        (
            Picture(
                "",
                "Late, lost and limited commands",
                figure,
                "On the left the curves of the two laws lie upon each other. A curve ends where "
                "control is lost.",
            ),
        ),
    ),
)
