"""Section 6.2.1: the relation that chooses degree and window of each part."""

import numpy as np

from fpt_ros.denoising.noisy import Noisy
from fpt_ros.denoising.offline.adaptive_savgol import divide, extrema, relation, rule
from fpt_ros.denoising.offline.savgol import smooth
from fpt_ros.denoising.signals import CHAPTER6
from fpt_ros.thesis.chapter6.s6_1_savitzky_golay import CELLS
from fpt_ros.thesis.claim import NO, YES, Claim, Table, Verdict
from fpt_ros.thesis.trials import Results, Scores, Trial
from fpt_ros.thesis.words import because


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


CLAIMS: tuple[Claim[Scores], ...] = (
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
)
