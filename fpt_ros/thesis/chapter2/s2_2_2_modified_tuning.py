"""Section 2.2.2: what the modified tuning learns."""

from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Picture, Verdict
from fpt_ros.thesis.judges import precise
from fpt_ros.thesis.learning import coefficient_table, coefficients, last, learned
from fpt_ros.thesis.measures import settled_rms
from fpt_ros.thesis.setup import Runs, Setup
from fpt_ros.thesis.words import because


def _well_learned(runs: Runs) -> Verdict:
    found = coefficients(runs["alpha = 10"])
    parts = {name: learned(*found[name]) for name in ("mu", "mu_c", "beta", "lambda")}
    good = {name: part >= 0.9 for name, part in parts.items()}
    short = [name for name, well in good.items() if not well]
    longer = coefficients(runs["alpha = 10, 1200 s"])
    eventually = all(learned(*longer[name]) >= 0.9 for name in parts)
    after = ", ".join(f"{name} {longer[name][1]:.4g}" for name in parts)
    status = YES if not short else ONLY_IF if eventually else NO
    missing = f" Only if there is time: {', '.join(short)} takes longer than 60 s." if short else ""
    return Verdict(
        status,
        {f"{name}, part of its error that is gone after 60 s": p for name, p in parts.items()},
        f"At least 90 % of the initial error of each counts as well learned.{missing} After 1200 "
        f"s they are {after} (exact 1, 3, 1, 2).",
        coefficient_table({"60 s": runs["alpha = 10"], "1200 s": runs["alpha = 10, 1200 s"]}),
    )


def _slowly_approximated(runs: Runs) -> Verdict:
    measured: dict[str, float | str | None] = {}
    for key, run in runs.items():
        measured[f"Theta1 = m^, {key} (exact 10)"] = last(run, "m")
        measured[f"Theta4 = k^, {key} (exact 100)"] = last(run, "k")
    final = runs["alpha = 10, 1200 s"]
    m, k = last(final, "m"), last(final, "k")
    measured["Theta4 - 4 Theta1 at the end (exact 60)"] = k - 4.0 * m
    moved = abs(m - last(runs["alpha = 10, 300 s"], "m"))
    stalled = abs(m - 10.0) > 1.0 and moved < 0.1
    return Verdict(
        ONLY_IF if stalled else YES if abs(m - 10.0) < 1.0 else NO,
        measured,
        f'Only if "slowly" is read as "hardly": they stall at {m:.3g} and {k:.4g}; from 300 s to '
        f"1200 s m^ moves by {moved:.2g}. On a motion of a single tone q'' = -4 q, so that only "
        "Theta4 - 4 Theta1 can be identified, and that is exact.",
    )


def _precise_without_knowing(runs: Runs) -> Verdict:
    run = runs["alpha = 10"]
    found = settled_rms(run, "q1")
    away = {name: abs(x - exact) / exact for name, (_, x, exact) in coefficients(run).items()}
    held = away["m"] > 0.1 and found < 1e-3
    return Verdict(
        YES if held else NO,
        {
            "rms error": found,
            "m^, part by which it is wrong": away["m"],
            "k^, part by which it is wrong": away["k"],
        },
        because(
            held, "The motion does not tell m and k apart, and so the control need not know them."
        ),
    )


MODIFIED = Setup("vdp_modified")

CLAIMS = (
    Claim(
        "2.2.2",
        "2.5",
        "The modified tuning (alpha = 10) learns fast, and the tracking becomes precise.",
        {"not tuned": Setup("vdp_aidc", "fixed"), "alpha = 10": MODIFIED},
        precise("alpha = 10", "not tuned", 20.0),
        (Picture("2.5", "Tracking error", draw.errors("alpha = 10")),),
    ),
    Claim(
        "2.2.2",
        "2.6-2.7",
        "Theta2, Theta3, Theta5 and Theta6 are well learned.",
        {
            "alpha = 10": MODIFIED,
            "alpha = 10, 1200 s": Setup("vdp_modified", duration=1200.0),
        },
        _well_learned,
        (Picture("2.6, 2.7", "Tuning of the parameters", draw.parameters("alpha = 10")),),
    ),
    Claim(
        "2.2.2",
        "2.6-2.7",
        "Theta1 and Theta4 are only slowly approximated.",
        {
            "alpha = 10, 60 s": MODIFIED,
            "alpha = 10, 300 s": Setup("vdp_modified", duration=300.0),
            "alpha = 10, 1200 s": Setup("vdp_modified", duration=1200.0),
        },
        _slowly_approximated,
    ),
    Claim(
        "2.2.2",
        "2.5-2.7",
        "Exact knowledge of the parameters that the motion tells nothing about is not necessary "
        "for precise tracking.",
        {"alpha = 10": MODIFIED},
        _precise_without_knowing,
    ),
)
