"""Section 2.5: deformation and tuning together on the coupled masses."""

from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Verdict
from fpt_ros.thesis.measures import settled_rms
from fpt_ros.thesis.setup import Runs, Setup

MASSES = "coupled_masses"


def _both_together(runs: Runs) -> Verdict:
    measured = {
        f"{name}, rms error, {key} [m]": settled_rms(run, name)
        for name in ("q1", "q2")
        for key, run in runs.items()
    }
    best = [
        min(runs, key=lambda key: settled_rms(runs[key], name)) == "both" for name in ("q1", "q2")
    ]
    gains = [settled_rms(runs["neither"], n) / settled_rms(runs["both"], n) for n in ("q1", "q2")]
    return Verdict(
        YES if all(best) and min(gains) > 20.0 else ONLY_IF if min(gains) > 20.0 else NO,
        measured,
        f"Both together are {min(gains):.3g} and {max(gains):.3g} times as precise as neither, "
        "and better than either of them alone.",
    )


CLAIMS = (
    Claim(
        "2.5",
        "2.20-2.21",
        "The sigmoid generated transformation coexists well with the MAIDRC design and its tuning.",
        {
            "neither": Setup(MASSES, "nonadaptive"),
            "tuning alone": Setup(MASSES, "tune_only"),
            "deformation alone": Setup(MASSES, "deform_only"),
            "both": Setup(MASSES),
        },
        _both_together,
    ),
)
