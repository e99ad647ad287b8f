"""Section 3.2.2: at which gain TORA begins to chatter, and how suddenly."""

import math
from collections.abc import Mapping
from itertools import pairwise

import numpy as np

from fpt_ros.analysis import signals, style
from fpt_ros.runs.run import Run
from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.chapter3.s3_2_2_tora import TORA
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Drawn, Picture, Verdict
from fpt_ros.thesis.learning import tuned
from fpt_ros.thesis.measures import chatter, settled_rms
from fpt_ros.thesis.setup import Runs, Setup

SCAN = (-2.0, -2.4, -2.8, *(round(-3.2 - 0.01 * i, 2) for i in range(71)))
CHATTERS = 0.1
"""Settled mean step [1/s²] of r from which a run counts as chattering: ten times a quiet one's."""


def scanned(runs: Runs) -> Mapping[float, float]:
    """Chatter of the runs of the scan, by A."""
    return {A: chatter(runs[f"A = {A:g}"]) for A in SCAN}


def onset(found: Mapping[float, float]) -> tuple[float, float]:
    """The last A that is quiet before the first that chatters, and that one."""
    for before, after in pairwise(SCAN):
        if found[after] > CHATTERS:
            return before, after
    return SCAN[-1], -math.inf


def _threshold(runs: Runs) -> Verdict:
    found = scanned(runs)
    quiet, loud = onset(found)
    islands = [A for A in SCAN if loud > A and found[A] < CHATTERS]
    here = -3.9 <= loud <= -3.3
    printed = -3.2375 <= loud <= -3.2275
    return Verdict(
        YES if printed else ONLY_IF if here else NO,
        {
            "last quiet A": quiet,
            "first chattering A": loud,
            "chatter at the last quiet A": found[quiet],
            "chatter at the first chattering A": found[loud],
            "scanned A beyond it that are quiet again": float(len(islands)),
        },
        "Only if the nominal trajectory is the thesis's own, which is not printed; with this one "
        f"strong chattering begins just as suddenly, at {loud:g}. From -2.947 to -4.66 quiet "
        "tracking and a cycle of two exist side by side, and the transient decides which of them "
        "comes: that is why some A beyond the onset are quiet again.",
    )


def scan_figure(runs: Runs) -> Drawn:
    """Chatter and error over A."""
    found = scanned(runs)
    A = np.array(SCAN)
    errors = np.array([settled_rms(runs[f"A = {value:g}"], "q3") for value in SCAN])
    dots = {"marker": "o", "markersize": 3, "linewidth": 1.0}
    mark = {"color": style.DEFORMED, "linewidth": 1.2, "linestyle": (0, (4.0, 1.6))}
    printed = np.array([-3.23, -3.23])
    steps = np.array([found[value] for value in SCAN])
    return draw.charts(
        (
            "Chatter",
            "A",
            "mean settled step of r",
            (
                (A, steps, "", {"color": style.COORDINATES[0], **dots}),
                (printed, np.array([steps.min(), steps.max()]), "the thesis's onset", mark),
            ),
        ),
        (
            "Tracking",
            "A",
            "settled rms error of q3 [m]",
            ((A, errors, "", {"color": style.COORDINATES[1], **dots}),),
        ),
        log="y",
    )


ALARM = -0.3
"""Precursor index below which the response alternates: that of the guard."""

RFPT_GAINS = tuple(round(2.8 + 0.01 * i, 2) for i in range(33))


def _sudden(runs: Runs) -> Verdict:
    found = {key: (chatter(run), _least_index(run)) for key, run in runs.items()}
    quiet = found["SGFPT, A = -3.2"][0]
    warned = {
        kind: sum(
            index < ALARM and size < 2.0 * quiet
            for key, (size, index) in found.items()
            if key.startswith(kind)
        )
        for kind in ("SGFPT", "RFPT")
    }
    jump = {kind: _largest_step(kind, found) for kind in warned}
    held = warned["SGFPT"] == 0 and jump["SGFPT"] > 20.0, warned["RFPT"] > 0
    return Verdict(
        YES if all(held) else ONLY_IF if any(held) else NO,
        {
            "largest growth of the chatter within 0.01 of A": jump["SGFPT"],
            "the same of RFPT, within 0.01 of |Kc| A": jump["RFPT"],
            "A with precursors and less than twice the quiet chatter": float(warned["SGFPT"]),
            "the same of RFPT": float(warned["RFPT"]),
        },
        f"Within 0.01 of A the chatter grows {jump['SGFPT']:.3g} times, and no A shows precursor "
        "oscillations without it: the loss of stability is hard. RFPT in its place (Kc = -100, "
        f"tried here; the thesis refers to [43]) loses it softly: with {warned['RFPT']} of the "
        "gains r already alternates while there is hardly any chatter.",
    )


def _least_index(run: Run) -> float:
    time, index = tuned(run, "precursor")
    return float(index[signals.settled(run, time)].min(initial=1.0))


def _largest_step(kind: str, found: Mapping[str, tuple[float, float]]) -> float:
    sizes = np.array([size for key, (size, _) in found.items() if key.startswith(kind)])
    return float(np.max(sizes[1:] / sizes[:-1]))


def onset_figure(runs: Runs) -> Drawn:
    """Chatter and precursor index of both transformations over their gains."""
    cells = []
    for kind, label in (("SGFPT", "A"), ("RFPT", "|Kc| A")):
        keys = [key for key in runs if key.startswith(kind)]
        gain = np.array([float(key.rpartition("= ")[2]) for key in keys])
        size = np.array([chatter(runs[key]) for key in keys])
        index = np.array([_least_index(runs[key]) for key in keys])
        dots = {"marker": "o", "markersize": 3, "linewidth": 1.0}
        curves = (
            (gain, np.log10(size), "log10 of the chatter", {"color": style.COORDINATES[0], **dots}),
            (gain, index, "precursor index", {"color": style.DEFORMED, **dots}),
        )
        cells.append((kind, label, "", curves))
    return draw.charts(*cells)


def _scan(A: float) -> Setup:
    return Setup(TORA, settings=(f"fpt_deformer.A={A:g}",), duration=10.0)


def _observed(*deformer: str) -> Setup:
    settings = (*(f"fpt_deformer.{each}" for each in deformer), "parameter_tuner.precursor=true")
    return Setup(TORA, settings=settings, duration=10.0)


CLAIMS = (
    Claim(
        "3.2.2",
        "",
        "Somewhere between A = -3.23 and A = -3.235 strong chattering appears.",
        {f"A = {A:g}": _scan(A) for A in SCAN},
        _threshold,
        (Picture("", "Chatter and error of all gains", scan_figure),),
    ),
    Claim(
        "3.2.2",
        "",
        "Unlike RFPT, where precursor oscillations appear slowly, this transformation turns into "
        "an oscillating regime very quickly.",
        {
            **{f"SGFPT, A = {A:g}": _observed(f"A={A:g}") for A in SCAN[3:44]},
            **{
                f"RFPT, |Kc| A = {gain:g}": _observed(
                    f"A={gain / 100:g}", "transformation=rfpt", "B=1", "K=-100"
                )
                for gain in RFPT_GAINS
            },
        },
        _sudden,
        (Picture("", "Two kinds of onset", onset_figure),),
    ),
)
