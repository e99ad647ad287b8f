"""Chapter 6: adaptive multi-round smoothing with Savitzky-Golay filters."""

from itertools import pairwise

import numpy as np

from fpt_ros.analysis import style
from fpt_ros.denoising.noisy import Noisy
from fpt_ros.denoising.offline import Signal, weighting
from fpt_ros.denoising.offline.adaptive_savgol import divide, extrema, relation, rule
from fpt_ros.denoising.offline.joined_lines import joined_lines
from fpt_ros.denoising.offline.savgol import kernel, smooth
from fpt_ros.denoising.signals import CHAPTER6, rmse
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Drawn, Picture, Table, Verdict
from fpt_ros.thesis.drawings import charts
from fpt_ros.thesis.measures import because
from fpt_ros.thesis.trials import LABELS, PEERS, Results, Scores, Trial, curves

TITLE = "Adaptive multi-round smoothing based on the Savitzky-Golay filter"

SIGMAS = (0.05, 0.2)
CELLS = {f"{s}, {x:g}": Noisy(s, sigma=x) for s in CHAPTER6 for x in SIGMAS}
SAVGOL = "Savitzky-Golay (35, 3)"

# --- 6.1: the filter

TABLE61 = {
    (9, 2): (-0.0909, 0.0606, 0.1688, 0.2338, 0.2554),
    (9, 4): (0.0350, -0.1282, 0.0699, 0.3147, 0.4172),
    (11, 3): (-0.0839, 0.0210, 0.1026, 0.1608, 0.1958, 0.2075),
    (11, 5): (0.0420, -0.1049, -0.0233, 0.1399, 0.2797, 0.3333),
}
"""Table 6.1, the first half of each row, which is symmetric."""


def _coefficients(results: Results) -> Verdict:
    found = {key: kernel(*key) for key in TABLE61}
    worst = {
        key: float(np.max(np.abs(found[key][: len(printed)] - printed)))
        for key, printed in TABLE61.items()
    }
    rows = tuple(
        (f"M = {M}, k = {k}", ", ".join(f"{c:.4f}" for c in found[M, k][: M // 2 + 1]))
        for M, k in TABLE61
    )
    return Verdict(
        YES if max(worst.values()) <= 5.0001e-5 else NO,
        {f"M = {M}, k = {k}: largest difference": x for (M, k), x in worst.items()},
        "All are the printed ones, rounded to four decimals. G of (6.9) lacks the inverse: it is "
        "J (J^T J)^-1; and (6.8) has no modulus.",
        Table(("filter", "coefficients up to the centre"), rows),
    )


def _by_pace(results: Results) -> dict[str, float]:
    """RMSE of the first seed in the half of the samples where the signal bends more, and less."""
    scores = results[SAVGOL]
    bend = np.abs(np.gradient(np.gradient(scores.clean)))
    fast = bend > np.median(bend)
    error = scores.estimate - scores.clean
    return {
        "where it bends more": float(np.sqrt(np.mean(error[fast] ** 2))),
        "where it bends less": float(np.sqrt(np.mean(error[~fast] ** 2))),
    }


def _not_precise(results: Results) -> Verdict:
    found = _by_pace(results)
    more, less = found.values()
    best = results["best"].mean("rmse")
    return Verdict(
        YES if more > 1.5 * less else NO,
        {
            **{f"rms error {where}": value for where, value in found.items()},
            "rms error, mean of 20 seeds": results[SAVGOL].mean("rmse"),
            "auto": best,
        },
        "One window for all of the signal rounds off the fast part, and leaves noise in the slow "
        "one.",
    )


# --- 6.2.1: the relation


def _relation(results: Results) -> Verdict:
    difference = np.array([0.0, 1.0, 2.0, 2.2, 3.0, 10.0])
    literal = [relation(20.0 + d, 20.0, literal=True) for d in difference]
    shares = []
    for noisy in CELLS.values():
        y = noisy.samples()
        result = smooth(y, 35, 3)
        parts = divide(result, extrema(result), "literal", noisy.sigma)
        samples = sum(part.end - part.begin for part in parts)
        shares.append(sum(p.end - p.begin for p in parts if p.degree == 5) / samples)
    reached = {rule(g, 20.0, 100)[0] for g in literal}
    rows = tuple(
        (f"{d:g}", f"{a:.3f}", str(rule(a, 20.0, 100)[0]), f"{relation(20.0 + d, 20.0):.3f}")
        for d, a in zip(difference, literal, strict=True)
    )
    held = reached >= {1, 2, 3, 4, 5}
    return Verdict(
        YES if held else NO,
        {
            "least g": min(literal),
            "share of samples that get k = 5, mean of all signals": float(np.mean(shares)),
        },
        because(
            not held,
            "It takes a difference of lengths in samples, which is never negative: g >= 0.5, so "
            "that the rules for k = 1 and 2 are never reached, and g > 0.9 as soon as the longest "
            "section is 2.2 samples longer. With the ratio of the lengths all rules are.",
        ),
        Table(("d_max - d_R, d_R = 20", "g as printed", "k", "g by ratio"), rows),
    )


SPIKES = {s: Noisy(s, sigma=0.1, spikes=1) for s in CHAPTER6}


def _independent(results: Results) -> Verdict:
    methods = ("literal", "corrected", "savgol_bank", "auto")
    errors = {(s, m): results[f"{s}, {m}"].mean("rmse") for s in SPIKES for m in methods}
    white = {s: results[f"{s}, literal, white"].mean("rmse") for s in SPIKES}
    ratio = [errors[s, "literal"] / white[s] for s in SPIKES]
    rows = tuple((s, *(f"{errors[s, m]:.4f}" for m in methods), f"{white[s]:.4f}") for s in SPIKES)
    held = max(ratio) < 1.2
    return Verdict(
        YES if held else NO,
        {
            "impulses raise the error, literal rules, at least": min(ratio),
            "literal rules / auto, with impulses, at least": min(
                errors[s, "literal"] / errors[s, "auto"] for s in SPIKES
            ),
        },
        because(
            not held,
            "It has no rejection of outliers: with impulses in 2 % of the samples its error is a "
            f"multiple of that without ({min(ratio):.2g} to {max(ratio):.2g} times).",
        ),
        Table(
            ("rms error, sigma 0.1, 2 % impulses", *methods, "literal, without impulses"),
            rows,
        ),
    )


# --- 6.2.2: joined lines, weights


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


# --- 6.2.3: the results

METHODS: dict[str, tuple[str, tuple[str, ...]]] = {
    SAVGOL: ("savgol", ()),
    "adaptive, as printed, 1 round": ("adaptive_savgol", ("rules=literal", "rounds=1")),
    "adaptive, as printed, 2 rounds": ("adaptive_savgol", ("rules=literal", "rounds=2")),
    "adaptive, corrected, 2 rounds": ("adaptive_savgol", ("rules=corrected", "rounds=2")),
    "adaptive, window by amplitude": ("adaptive_savgol", ("rules=scale", "rounds=1")),
    "bank with local risk": ("savgol_bank", ()),
    "auto (default)": ("auto", ()),
    **{LABELS[peer]: (peer, ()) for peer in PEERS},
}
WINDOWS = (5, 7, 9, 11, 15, 19, 25, 31, 41, 53, 69, 89, 115, 151)


def best_fixed(noisy: Noisy, seeds: range) -> float:
    """Mean RMSE of the fixed filter that is best for the signal, which one has to know."""
    clean = noisy.clean()
    draws = [noisy.with_seed(seed).samples() for seed in seeds]
    errors = [
        np.mean([rmse(clean, smooth(y, window, degree)) for y in draws])
        for degree in (1, 3, 5)
        for window in WINDOWS
        if window >= degree + 2
    ]
    return float(min(errors))


def _recovers(results: Results) -> Verdict:
    errors = {m: [results[f"{cell}, {m}"].mean("rmse") for cell in CELLS] for m in METHODS}
    fixed = [best_fixed(noisy, range(10, 15)) for noisy in CELLS.values()]
    one, two = errors["adaptive, as printed, 1 round"], errors["adaptive, as printed, 2 rounds"]
    classical = errors[SAVGOL]
    corrected = errors["adaptive, corrected, 2 rounds"]
    ahead = {
        m: sum(a < b for a, b in zip(errors[m], fixed, strict=True))
        for m in ("adaptive, window by amplitude", "bank with local risk", "auto (default)")
    }
    wins = sum(a < b for a, b in zip(one, classical, strict=True))
    loses = sum(a > b for a, b in zip(one, fixed, strict=True))
    harmed = sum(a > b for a, b in zip(two, one, strict=True))
    rows = [(m, *(_four(x) for x in found)) for m, found in errors.items()]
    rows.insert(1, ("best fixed filter (one has to know it)", *(f"{x:.4f}" for x in fixed)))
    status = YES if wins == len(CELLS) and not loses else ONLY_IF if wins > len(CELLS) / 2 else NO
    return Verdict(
        status,
        {
            f"better than {SAVGOL}, of {len(CELLS)} cases": wins,
            "worse than the best fixed filter": loses,
            "the second round makes it worse": harmed,
            "corrected, worse than the best fixed filter": sum(
                a > b for a, b in zip(corrected, fixed, strict=True)
            ),
            **{f"{m}, better than the best fixed filter": n for m, n in ahead.items()},
        },
        f"Only if compared with {SAVGOL}: as printed nearly everything gets k = 5 and M = 0.3 d, a "
        "weak smoothing, which harms fast signals less. To the best fixed filter it loses in "
        f"{loses} of {len(CELLS)} cases, and the second round does harm in {harmed}.",
        Table(("rms error: signal, sigma", *CELLS), tuple(rows)),
    )


def _four(value: float) -> str:
    return f"{value:.4f}" if np.isfinite(value) else "–"


FIRST = "doppler6, 0.05"


def rounds_figure(results: Results) -> Drawn:
    """Noise, first and second round."""
    return curves(
        results,
        [
            (f"{FIRST}, {SAVGOL}", ""),
            (f"{FIRST}, adaptive, as printed, 1 round", "after the first round"),
            (f"{FIRST}, adaptive, as printed, 2 rounds", "after two rounds"),
            (f"{FIRST}, auto (default)", "auto (default)"),
        ],
        rows=2,
    )


CLAIMS: tuple[Claim[Scores], ...] = (
    Claim("6.1", "", "The coefficients are those of Table 6.1.", {}, _coefficients),
    Claim(
        "6.1",
        "6.1",
        "The smoothing by the original Savitzky-Golay filter (k = 3, M = 35) is not precise.",
        {SAVGOL: Trial(CELLS[FIRST], "savgol"), "best": Trial(CELLS[FIRST])},
        _not_precise,
        (
            Picture(
                "6.1",
                "The original filter",
                lambda results: curves(results, [(SAVGOL, ""), (SAVGOL, "k = 3, M = 35")]),
            ),
        ),
    ),
    Claim(
        "6.2.1",
        "",
        "The relation (6.10) tells parts of high and low frequency apart, (6.11) gives each its "
        "degree and window.",
        {},
        _relation,
    ),
    Claim(
        "6.2.1",
        "",
        "The method gives efficient results independently of the type of the contaminating noise.",
        {
            **{
                f"{s}, {m}": Trial(noisy, m)
                for s, noisy in SPIKES.items()
                for m in ("savgol_bank", "auto")
            },
            **{
                f"{s}, {m}": Trial(noisy, "adaptive_savgol", (f"rules={m}",))
                for s, noisy in SPIKES.items()
                for m in ("literal", "corrected")
            },
            **{
                f"{s}, literal, white": Trial(
                    Noisy(s, sigma=0.1), "adaptive_savgol", ("rules=literal",)
                )
                for s in SPIKES
            },
        },
        _independent,
    ),
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
    Claim(
        "6.2.3",
        "6.3-6.5",
        "The adaptive multi-round smoothing efficiently recovers the signal, in two rounds.",
        {
            f"{cell}, {label}": Trial(noisy, method, settings)
            for cell, noisy in CELLS.items()
            for label, (method, settings) in METHODS.items()
        },
        _recovers,
        (Picture("6.3, 6.4, 6.5", "A noisy signal, and its rounds", rounds_figure),),
    ),
)
