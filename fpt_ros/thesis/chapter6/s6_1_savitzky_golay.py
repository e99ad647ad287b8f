"""Section 6.1: the Savitzky-Golay filter, and the noisy signals of the chapter."""

import numpy as np

from fpt_ros.denoising.noisy import Noisy
from fpt_ros.denoising.offline.savgol import kernel
from fpt_ros.denoising.signals import CHAPTER6
from fpt_ros.thesis.claim import NO, YES, Claim, Picture, Table, Verdict
from fpt_ros.thesis.trials import Results, Scores, Trial, curves

SIGMAS = (0.05, 0.2)
CELLS = {f"{s}, {x:g}": Noisy(s, sigma=x) for s in CHAPTER6 for x in SIGMAS}
SAVGOL = "Savitzky-Golay (35, 3)"
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


FIRST = "doppler6, 0.05"

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
)
