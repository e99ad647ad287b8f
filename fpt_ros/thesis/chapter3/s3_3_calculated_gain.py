"""Section 3.3: the gain that is calculated in every cycle."""

import numpy as np

from fpt_ros.analysis import signals
from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.chapter3.s3_2_2_tora import TORA, driving_arm
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Picture, Table, Verdict
from fpt_ros.thesis.judges import follows, precise
from fpt_ros.thesis.learning import tuned
from fpt_ros.thesis.measures import chatter, complete, end, settled_rms
from fpt_ros.thesis.setup import Runs, Setup
from fpt_ros.thesis.words import because, text

AUTO = {
    "nonadaptive": Setup(TORA, "nonadaptive"),
    "A = -0.1": Setup(TORA),
    "calculated A": Setup("tora_auto"),
}


def _any_small_epsilon(runs: Runs) -> Verdict:
    rows, found = [], {}
    fixed = runs["larger start error, A = -0.1"]
    for key, run in runs.items():
        if run is fixed:
            continue
        late = signals.settled(run, tuned(run, "A")[0])
        A = tuned(run, "A")[1][late]
        found[key] = chatter(run)
        span = f"{A.min():.3g} to {A.max():.3g}" if len(A) else "none"
        rows.append((key, span, text(found[key]), text(settled_rms(run, "q3"))))
    large = runs["larger start error"]
    quiet, loud = found["epsilon = 0.05"], found["epsilon = 0.001"]
    good = quiet < 0.03
    fails = loud > 5.0 * quiet or not complete(large)
    return Verdict(
        (ONLY_IF if fails else YES) if good else NO,
        {
            "chatter, epsilon = 0.05": quiet,
            "chatter, epsilon = 0.001": loud,
            "larger start error: lost at [s]": None if complete(large) else end(large),
            "larger start error, fixed A = -0.1: q2, rms error [rad]": settled_rms(fixed, "q2"),
        },
        "Only if epsilon is chosen so that W / epsilon stays below the limit of 4.66, such as "
        "0.05: once ||h|| is small, epsilon alone decides how large |A| becomes, and a small one "
        "makes it burst. And as |A| ||h|| is held at W, a large initial error is unlearned too "
        "slowly: the run with an amplitude of 1 rad is lost, where a fixed A = -0.1 works.",
        Table(("run", "A, settled", "chatter", "q3, rms error [m]"), tuple(rows)),
    )


def _calculated_range(runs: Runs) -> Verdict:
    time, A = tuned(runs["calculated A"], "A")
    late = A[signals.settled(runs["calculated A"], time)]
    size = np.abs(A[1:])
    held = bool(late.max() < 0.0 and late.min() > -4.66)
    return Verdict(
        YES if held else NO,
        {
            "least settled A": float(late.min()),
            "largest settled A": float(late.max()),
            "least |A| of all": float(size.min()),
        },
        because(
            held,
            "A finds its value by itself and stays inside the range that contracts. (3.20) gives "
            "|A|: the sign is minus.",
        ),
    )


CLAIMS = (
    Claim(
        "3.3.2",
        "3.28-3.30",
        "With the calculated A the tracking is accurate, and clearly better than the "
        "non-adaptive one.",
        AUTO,
        precise("calculated A", "nonadaptive", 20.0, "", ("A = -0.1",)),
        (
            Picture("3.28", "Trajectory tracking", draw.tracking("nonadaptive", "calculated A")),
            Picture("3.29", "Tracking error", draw.errors("nonadaptive", "calculated A")),
            Picture("3.30", "Phase trajectories", draw.phases("nonadaptive", "calculated A")),
        ),
    ),
    Claim(
        "3.3.2",
        "3.31-3.32",
        "Desired and realised second derivatives cover each other; the deformed ones differ "
        "significantly.",
        AUTO,
        follows("calculated A", "nonadaptive", 50.0),
        (
            Picture("3.31", "Second derivatives", draw.responses("nonadaptive", "calculated A")),
            Picture(
                "3.32", "Second derivatives, excerpt", draw.zoomed("nonadaptive", "calculated A")
            ),
        ),
    ),
    Claim(
        "3.3.2",
        "3.33",
        "The trajectories of the driving arm q1 differ insignificantly.",
        {"nonadaptive": Setup(TORA, "nonadaptive"), "adaptive": Setup("tora_auto")},
        driving_arm,
        (Picture("3.33", "The driving arm", draw.uncontrolled("nonadaptive", "adaptive")),),
    ),
    Claim(
        "3.3.1",
        "3.34",
        "|A| = W / (epsilon + mean ||h||) sets the gain by a simple calculation in every cycle.",
        {"calculated A": Setup("tora_auto")},
        _calculated_range,
        (Picture("3.34", "The calculated A", draw.parameters("calculated A", names=("A",))),),
    ),
    Claim(
        "3.3.1",
        "",
        "Epsilon only has to be a small positive number, to avoid division by zero.",
        {
            "epsilon = 0.05": Setup("tora_auto"),
            "epsilon = 0.03": Setup("tora_auto", settings=("parameter_tuner.epsilon=0.03",)),
            "epsilon = 0.01": Setup("tora_auto", settings=("parameter_tuner.epsilon=0.01",)),
            "epsilon = 0.001": Setup("tora_auto", "small_epsilon"),
            "larger start error": Setup(
                "tora_auto", settings=("trajectory_generator.amplitude=[0.3, 1.0]",)
            ),
            "larger start error, A = -0.1": Setup(
                TORA, settings=("trajectory_generator.amplitude=[0.3, 1.0]",)
            ),
        },
        _any_small_epsilon,
        (
            Picture(
                "",
                "A for two epsilons",
                draw.parameters("epsilon = 0.05", "epsilon = 0.001", names=("A",)),
            ),
        ),
    ),
)
