"""Section 5.1.3: which signals and which noise the methods suit, and how success is measured."""

import math

import numpy as np

from fpt_ros.denoising.noisy import Noisy
from fpt_ros.thesis.chapter5.s5_1_1_supervisor import SIGNALS
from fpt_ros.thesis.chapter5.s5_1_3_table_5_1 import THESIS
from fpt_ros.thesis.chapter5.s5_1_threshold_rules import SINES
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Drawn, Picture, Verdict
from fpt_ros.thesis.trials import Results, Scores, Trial, curves
from fpt_ros.thesis.words import because, factor_text, listed


def _precise(results: Results) -> Verdict:
    found = {name: scores.mean("snr") for name, scores in results.items()}
    good = [name for name, snr in found.items() if snr > 15.0]
    bad = [name for name, snr in found.items() if snr < 5.0]
    return Verdict(
        YES if len(good) == len(found) else ONLY_IF if good else NO,
        {f"{name}: SNR after [dB]": snr for name, snr in found.items()},
        f"Only if the signal is smooth at the scale of the window: precise on {listed(good)}. "
        f"Narrow peaks are rejected as outliers{f' ({listed(bad)})' if bad else ''}.",
    )


def _cannot_cope(results: Results) -> Verdict:
    fast = {m: results[f"{m}, impulses"].mean("seconds") for m in THESIS}
    loss = {
        m: results[f"{m}, white"].mean("snr") - results[f"{m}, impulses"].mean("snr")
        for m in ("heursure", "minimax")
    }
    ratio = fast["improved"] / max(fast["heursure"], fast["minimax"])
    gain = results["improved, impulses"].mean("snr") - results["improved, white"].mean("snr")
    held = ratio > 1.0 and min(loss.values()) > 5.0
    return Verdict(
        YES if held else NO,
        {
            "CPU time, improved / slower of the two": ratio,
            "HeurSure loses by impulses in the place of white noise [dB]": loss["heursure"],
            "minimax loses [dB]": loss["minimax"],
            "improved gains [dB]": gain,
        },
        because(
            held,
            f"They are {factor_text(ratio)} times as fast, remove white noise, and leave the "
            "impulses standing; the robust fit removes impulses best of all.",
        ),
    )


def _measures_success(results: Results) -> Verdict:
    f, y = SINES.clean(), SINES.samples()
    perfect = 10.0 * math.log10(float(np.var(f) / np.var(y - f)))
    zero = 10.0 * math.log10(float(np.var(0.5 * f) / np.var(y - 0.5 * f)))
    return Verdict(
        NO,
        {
            "a perfect estimate scores [dB]": perfect,
            "the noisy signal as it is scores": "infinity",
            "half of the signal scores [dB]": zero,
            "before denoising [dB]": 2.2294,
        },
        "It divides the estimate's variance by that of what was taken away. A perfect denoiser "
        "scores what the input had, doing nothing scores infinity. On this page SNR is the "
        "variance of the signal over the mean square of the error.",
    )


def figure_53(results: Results) -> Drawn:
    """What impulses do to the others."""
    return curves(results, [("heursure, impulses", "HeurSure"), ("minimax, impulses", "minimax")])


CLAIMS: tuple[Claim[Scores], ...] = (
    Claim(
        "5.1.3",
        "",
        "The procedure precisely removes the noise and smooths the signal.",
        {s: Trial(Noisy(s, rho=0.9), "improved") for s in SIGNALS},
        _precise,
        (
            Picture(
                "",
                "A smooth signal, and one with peaks",
                lambda results: curves(results, [("heavisine", "heavisine"), ("bumps", "bumps")]),
            ),
        ),
    ),
    Claim(
        "5.1.3",
        "5.3",
        "HeurSure and minimax are faster and eliminate additive noise, but cannot cope with "
        "impulses.",
        {
            f"{m}, {kind}": Trial(Noisy("sines", rho=rho), m)
            for m in THESIS
            for kind, rho in (("white", 0.0), ("impulses", 0.9))
        },
        _cannot_cope,
        (Picture("5.3", "Noise of rho = 0.9", figure_53),),
    ),
    Claim(
        "5.1.3",
        "",
        "The performance is measured by the ratio of the variances of the signal after denoising "
        "and of the eliminated noise.",
        {},
        _measures_success,
    ),
)
