"""Section 5.1.1: the fuzzy choice of level, rule and wavelet."""

import numpy as np

from fpt_ros.denoising.noisy import Noisy
from fpt_ros.thesis.chapter5.s5_1_3_table_5_1 import THESIS
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Drawn, Picture, Table, Verdict
from fpt_ros.thesis.trials import LABELS, PEERS, Results, Scores, Trial, curves, decibels
from fpt_ros.thesis.words import listed

SIGNALS = ("sines", "doppler", "heavisine", "bumps", "blocks")


def _key(signal: str, method: str) -> str:
    return f"{signal}, {method}"


CHOSEN = (*THESIS, "universal", "fuzzy", "auto", *PEERS)


def _suitable(results: Results) -> Verdict:
    found = {m: [results[_key(s, m)].mean("snr") for s in SIGNALS] for m in CHOSEN}
    better = [
        s for s, a, b in zip(SIGNALS, found["fuzzy"], found["heursure"], strict=True) if a > b
    ]
    rivals = np.array([found[m] for m in CHOSEN if m != "auto"])
    lead = np.array(found["auto"]) - np.nanmax(rivals, axis=0)
    measured: dict[str, float | str | None] = {
        "signals on which the fuzzy choice beats fixed HeurSure": len(better),
        "least lead of auto over all others [dB]": float(lead.min()),
        "auto, CPU time of 1024 samples [ms]": 1e3 * results[_key("sines", "auto")].mean("seconds"),
    }
    rows = tuple((LABELS.get(m, m), *decibels(*values)) for m, values in found.items())
    held = len(better) == len(SIGNALS)
    leads = "leads on all of them" if lead.min() > 0 else "does not lead everywhere"
    return Verdict(
        YES if held else ONLY_IF if better else NO,
        measured,
        "Only for some signals: with a rule base of our own (the thesis prints none) the choice is "
        f"better than HeurSure with 4 levels on {listed(better) if better else 'none of them'}. "
        f"The choice by risk, auto, {leads}.",
        Table(("SNR after [dB], rho = 0.5", *SIGNALS), rows),
    )


def estimates_figure(results: Results) -> Drawn:
    """The supervisors on two signals."""
    panels = [(_key(s, m), f"{s}, {m}") for s in ("doppler", "blocks") for m in ("fuzzy", "auto")]
    return curves(results, panels, rows=2)


CLAIMS: tuple[Claim[Scores], ...] = (
    Claim(
        "5.1.1",
        "",
        "The fuzzy expert selects the resolution level, the thresholding rule and the wavelet that "
        "suit the signal.",
        {_key(s, m): Trial(Noisy(s), m) for s in SIGNALS for m in CHOSEN},
        _suitable,
        (Picture("", "Estimates of the two supervisors, rho = 0.5", estimates_figure),),
    ),
)
