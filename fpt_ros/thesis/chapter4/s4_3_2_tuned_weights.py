"""Section 4.3.2: weights of the coordinates that a forgetting buffer tunes."""

from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.chapter4.s4_3_3_affine_model import SPHERE
from fpt_ros.thesis.chapter4.weights_figure import weights_figure
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Picture, Verdict
from fpt_ros.thesis.learning import tuned
from fpt_ros.thesis.measures import chatter, settled_rms
from fpt_ros.thesis.setup import Runs, Setup
from fpt_ros.thesis.words import times

LIMIT = 5.60


def _tuned_weights(runs: Runs) -> Verdict:
    run, plain, loud = runs["tuned"], runs["weights 1"], runs["weights 8"]
    time, first = tuned(run, "weight.q1")
    late = first[time >= 6.0]
    measured: dict[str, float | str | None] = {
        "weight of q1 after 6 s, least": float(late.min()),
        "weight of q1 after 6 s, largest": float(late.max()),
    }
    better = {}
    for name in ("q1", "q2"):
        found = {key: settled_rms(each, name) for key, each in runs.items()}
        better[name] = found["tuned"] < found["weights 1"]
        measured |= {f"{name}, rms error, {key} [rad]": value for key, value in found.items()}
    for key, each in runs.items():
        measured[f"chatter, {key}"] = chatter(each)
    bounded = late.max() < 10.0 and chatter(run) < 0.3 * chatter(loud)
    helps = [name for name, is_better in better.items() if is_better]
    status = YES if len(helps) == 2 else ONLY_IF if helps else NO
    part = {
        YES: "Both coordinates become more precise",
        ONLY_IF: f"Only if {' and '.join(helps)} is what counts, which becomes more precise; the "
        "other does not",
        NO: "Neither coordinate becomes more precise",
    }[status]
    return Verdict(
        status if bounded else NO,
        measured,
        f"{part} (against weights of one; chatter {times(chatter(plain), chatter(run))}). As the "
        f"buffer turns negative there, the weights saw about the limit of {LIMIT:.2f} of the "
        "first row, without the persistent chatter of weights of 8.",
    )


CLAIMS = (
    Claim(
        "4.3.2",
        "4.19",
        "The diagonal weights can be tuned to improve the convergence: fluctuations show as a "
        "negative content of a forgetting buffer.",
        {
            "weights 1": Setup(SPHERE, "fixed_weights"),
            "tuned": Setup(SPHERE),
            "weights 8": Setup(SPHERE, "fixed_weights", ("fpt_deformer.weights=[8, 8]",)),
        },
        _tuned_weights,
        (
            Picture("4.19", "Tuned weights, forgetting buffer", weights_figure("tuned")),
            Picture("", "Tracking error", draw.errors("weights 1", "tuned", "weights 8")),
        ),
    ),
)
