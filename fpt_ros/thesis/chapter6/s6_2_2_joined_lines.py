"""Section 6.2.2: regression lines that join, and weights."""

from itertools import pairwise

import numpy as np

from fpt_ros.analysis import style
from fpt_ros.denoising.offline import Signal, weighting
from fpt_ros.denoising.offline.adaptive_savgol import extrema
from fpt_ros.denoising.offline.joined_lines import joined_lines
from fpt_ros.denoising.offline.savgol import smooth
from fpt_ros.thesis.chapter6.s6_1_savitzky_golay import CELLS
from fpt_ros.thesis.claim import ONLY_IF, YES, Claim, Drawn, Picture, Table, Verdict
from fpt_ros.thesis.drawings import charts
from fpt_ros.thesis.trials import Results, Scores


def _lines(y: Signal, knots: np.ndarray) -> tuple[Signal, Signal]:
    """Regression lines of each section alone, and joined."""
    n = len(y)
    at = np.unique(np.concatenate(([0], knots, [n])))
    alone = np.empty(n)
    for a, b in pairwise(at):
        x = np.arange(a, b)
        fit = np.polyfit(x, y[a:b], 1) if b - a > 1 else (0.0, y[a])
        alone[a:b] = np.polyval(fit, x)
    return alone, joined_lines(y, knots)


def _section() -> tuple[Signal, np.ndarray]:
    y = smooth(CELLS["twotone, 0.2"].samples(), 35, 3)[:520]
    return y, extrema(y, 0.3)


def _joined(results: Results) -> Verdict:
    y, knots = _section()
    alone, joined = _lines(y, knots)
    at = knots[(knots > 0) & (knots < len(y) - 1)]
    jump = float(np.max(np.abs(alone[at] - alone[at - 1])))
    slopes = np.diff(joined)
    rest = float(np.max(np.abs(joined[at + 1] - joined[at] - slopes[at])))
    return Verdict(
        ONLY_IF,
        {"largest jump of separate lines": jump, "largest jump of joined ones": rest},
        "Only if (6.13) is an equation: the print has a minus in the place of its sign, and the "
        "second sum of (6.12) has to run over [x2, x3]. Then the multipliers give the least "
        "squares on hat functions with knots at the extrema.",
    )


def lines_figure(results: Results) -> Drawn:
    """The problem of joining regression lines."""
    y, knots = _section()
    x = np.arange(len(y), dtype=np.float64)
    alone, joined = _lines(y, knots)
    signal = (x, y, "signal", style.BAND)
    dots = {"color": style.INK, "linestyle": "", "marker": "o", "markersize": 4, "zorder": 5}
    marks = (knots.astype(np.float64), y[knots], "extrema", dots)
    return charts(
        (
            "each line by itself",
            "sample",
            "",
            (signal, (x, alone, "lines", style.thin(style.DEFORMED)), marks),
        ),
        (
            "joined",
            "sample",
            "",
            (signal, (x, joined, "lines", style.thin(style.COORDINATES[1])), marks),
        ),
    )


def _printed_dombi(u: Signal, exponent: float) -> Signal:
    total = float(np.sum(((1.0 - u) / u) ** exponent))
    return np.asarray(1.0 / (1.0 + (u / (1.0 - u)) ** 2 * total))


EXPONENTS = (1.0, 1.7, 2.0, 3.0)


def _dombi(results: Results) -> Verdict:
    u = np.array([0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875])
    rows, away = [], []
    for exponent in EXPONENTS:
        right = weighting.dombi(u, exponent)
        difference = float(np.max(np.abs(right - weighting.shepard(u, exponent))))
        printed = float(np.sum(_printed_dombi(u, exponent)))
        away.append(abs(printed - 1.0))
        rows.append((f"{exponent:g}", f"{printed:.3f}", f"{right.sum():.3f}", f"{difference:.1e}"))
    return Verdict(
        ONLY_IF if max(away) > 1e-9 else YES,
        {"printed weights add up to 1 within": max(away)},
        "Only if the first exponent is lambda, not 2, and the sum leaves i out. Then it is the "
        "weight of Shepard for every lambda, and nothing new; as printed the weights do not add "
        "up to 1.",
        Table(("lambda", "sum as printed", "sum corrected", "difference to Shepard"), tuple(rows)),
    )


CLAIMS: tuple[Claim[Scores], ...] = (
    Claim(
        "6.2.2",
        "6.2",
        "With Lagrange multipliers, (6.12) and (6.13), the regression lines join continuously.",
        {},
        _joined,
        (Picture("6.2", "Regression lines between extrema", lines_figure),),
    ),
    Claim(
        "6.2.2",
        "",
        "The similarity of Shepard's weights with the Dombi operator gives a new parametric "
        "weighting function (6.16).",
        {},
        _dombi,
    ),
)
