"""Section 3.2.2: TORA with and without adaptation."""

from fpt_ros.analysis import signals
from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.claim import NO, YES, Claim, Picture, Verdict
from fpt_ros.thesis.judges import follows, precise
from fpt_ros.thesis.measures import rms, settled_rms
from fpt_ros.thesis.setup import Runs, Setup

TORA = "tora"
PAIR = {"nonadaptive": Setup(TORA, "nonadaptive"), "adaptive": Setup(TORA)}


def driving_arm(runs: Runs) -> Verdict:
    """Judge of: the arm that nothing prescribes moves alike with and without adaptation."""
    positions = {
        key: signals.topic(run, "joint_states", "position", "q1") for key, run in runs.items()
    }
    (time, plain), (_, adaptive) = positions["nonadaptive"], positions["adaptive"]
    late = signals.settled(runs["adaptive"], time)
    apart, size = rms((plain - adaptive)[late]), rms(plain[late])
    return Verdict(
        YES if 0.0 < apart < 0.1 * size else NO,
        {"q1, rms [rad]": size, "difference of the two, rms [rad]": apart},
        f"They differ by {apart / size:.1%}: momentum ties q1 to q3.",
    )


def _larger_gain(runs: Runs) -> Verdict:
    measured: dict[str, float | str | None] = {}
    ratios = []
    for name in ("q3", "q2"):
        found = {key: settled_rms(run, name) for key, run in runs.items()}
        measured |= {f"{name}, rms error, {key}": value for key, value in found.items()}
        ratios.append(found["A = -0.1"] / found["A = -3.125"])
    return Verdict(
        YES if min(ratios) > 2.0 else NO,
        measured,
        f"The errors become another {min(ratios):.3g} to {max(ratios):.3g} times smaller.",
    )


CLAIMS = (
    Claim(
        "3.2.2",
        "3.21-3.23",
        "The adaptive approach significantly improves trajectory and phase trajectory tracking "
        "(A = -0.1).",
        PAIR,
        precise("adaptive", "nonadaptive", 10.0),
        (
            Picture("3.21", "Trajectory tracking", draw.tracking("nonadaptive", "adaptive")),
            Picture("3.22", "Tracking error", draw.errors("nonadaptive", "adaptive")),
            Picture("3.23", "Phase trajectories", draw.phases("nonadaptive", "adaptive")),
        ),
    ),
    Claim(
        "3.2.2",
        "3.24-3.25",
        "Desired and realised second derivatives are in close vicinity, and the deformed ones "
        "considerably different.",
        PAIR,
        follows("adaptive", "nonadaptive", 10.0),
        (
            Picture("3.24", "Second derivatives", draw.responses("nonadaptive", "adaptive")),
            Picture("3.25", "Second derivatives, excerpt", draw.zoomed("nonadaptive", "adaptive")),
        ),
    ),
    Claim(
        "3.2.2",
        "3.26",
        "The trajectory of the driving arm q1 shows subtle differences only.",
        PAIR,
        driving_arm,
        (Picture("3.26", "The driving arm", draw.uncontrolled("nonadaptive", "adaptive")),),
    ),
    Claim(
        "3.2.2",
        "3.27",
        "Increasing |A| from 0.1 to 3.125 still improves the precision.",
        {"A = -0.1": Setup(TORA), "A = -3.125": Setup(TORA, "strong")},
        _larger_gain,
        (Picture("3.27", "Second derivatives, excerpt", draw.zoomed("A = -0.1", "A = -3.125")),),
    ),
)
