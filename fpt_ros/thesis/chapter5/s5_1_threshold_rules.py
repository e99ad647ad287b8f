"""Section 5.1: the threshold rules as printed."""

import numpy as np

from fpt_ros.denoising.noisy import Noisy
from fpt_ros.denoising.offline.noise import mad
from fpt_ros.denoising.offline.thresholding import decompose
from fpt_ros.denoising.signals import snr_db
from fpt_ros.thesis import printed_rules
from fpt_ros.thesis.claim import ONLY_IF, YES, Claim, Table, Verdict
from fpt_ros.thesis.trials import Results, Scores, Trial, decibels
from fpt_ros.thesis.words import listed

SINES = Noisy("sines")


def _as_printed(results: Results) -> Verdict:
    y = SINES.samples()
    finest = decompose(y, "sym8", 4)[-1]
    sigma = mad(finest)
    measured: dict[str, float | str | None] = {}
    rows, losses = [], {}
    for label, rule in printed_rules.RULES.items():
        found = []
        for seed in results[label].seeds:
            noisy = SINES.with_seed(seed)
            found.append(snr_db(noisy.clean(), rule.denoise(noisy.samples())))
        threshold = rule.printed(finest, y, printed_rules.sigma(finest)) / sigma
        corrected = rule.corrected(finest / sigma, len(y))
        literal, right = float(np.mean(found)), results[label].mean("snr")
        losses[label] = right - literal
        measured[f"{label}: as printed [dB]"] = literal
        measured[f"{label}: corrected [dB]"] = right
        rows.append((label, f"{threshold:.3g}", f"{corrected:.3g}", *decibels(literal, right)))
    harmful = [label for label, loss in losses.items() if loss > 1.0]
    return Verdict(
        ONLY_IF if harmful else YES,
        measured,
        "Only if misprints are corrected: the logarithm of (5.1) belongs under the root; the sum "
        "of (5.2) ends at i, and omega is the coefficient at the smallest risk; (5.3) lacks "
        "1/sqrt(k); (5.4) has log2 s; and the median is one of absolute values. As printed "
        f"{listed(harmful)} lose up to {max(losses.values()):.1f} dB, and what (5.4) removes are "
        "all details, whatever they are.",
        Table(
            (
                "rule",
                "threshold of d1 as printed [sigma]",
                "corrected [sigma]",
                "SNR as printed [dB]",
                "corrected [dB]",
            ),
            tuple(rows),
        ),
    )


CLAIMS: tuple[Claim[Scores], ...] = (
    Claim(
        "5.1",
        "",
        "The threshold rules are (5.1) universal, (5.2) SureShrink, (5.3) HeurSure and (5.4) "
        "minimax.",
        {label: Trial(SINES, rule.method) for label, rule in printed_rules.RULES.items()},
        _as_printed,
    ),
)
