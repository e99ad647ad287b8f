"""Section 1.1, tried on TORA: the observer of precursor oscillations, and its guard."""

import numpy as np

from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.chapter3.s3_2_2_tora import TORA
from fpt_ros.thesis.claim import NO, YES, Claim, Picture, Verdict
from fpt_ros.thesis.learning import tuned
from fpt_ros.thesis.measures import chatter, complete, settled_rms
from fpt_ros.thesis.setup import Runs, Setup
from fpt_ros.thesis.words import because


def _guarded(runs: Runs) -> Verdict:
    loud, quiet = chatter(runs["A = -4.2"]), chatter(runs["A = -4.2, guarded"])
    time, factor = tuned(runs["A = -4.2, guarded"], "gain_factor")
    steps = np.diff(factor)
    changes = time[1:][steps != 0.0]
    return Verdict(
        YES if quiet < 0.1 * loud and complete(runs["A = -4.2, guarded"]) else NO,
        {
            "chatter, A = -4.2": loud,
            "chatter, A = -4.2, guarded": quiet,
            "A that the guard ends with": -4.2 * float(factor[-1]),
            "last intervention [s]": float(changes[-1]) if len(changes) else None,
        }
        | {
            f"{name}, rms error, {key}": settled_rms(run, name)
            for name in ("q3", "q2")
            for key, run in runs.items()
        },
        because(
            quiet < 0.1 * loud,
            "The observer sees the deformed response alone; the guard lowers |A| until that is "
            "smooth.",
        ),
    )


CLAIMS = (
    Claim(
        "1.1",
        "",
        "A model-independent observer detects precursor oscillations of the control signal "
        "before control is lost [43]; here it also holds A below the onset by itself.",
        {
            "A = -4.2": Setup(TORA, "chatter"),
            "A = -4.2, guarded": Setup(TORA, "guarded"),
        },
        _guarded,
        (
            Picture(
                "",
                "Started where it chatters",
                draw.zoomed("A = -4.2", "A = -4.2, guarded"),
            ),
            Picture(
                "",
                "Precursor index, and the factor of A",
                draw.parameters("A = -4.2, guarded", names=("precursor", "gain_factor")),
            ),
        ),
    ),
)
