"""Section 3.4.1: over which range the gain can be chosen."""

import math
from itertools import pairwise

from fpt_ros.thesis.chapter3.s3_2_2_onset_of_chattering import CHATTERS
from fpt_ros.thesis.chapter3.s3_2_2_tora import TORA
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Table, Verdict
from fpt_ros.thesis.measures import chatter, complete, settled_rms
from fpt_ros.thesis.setup import Runs, Setup
from fpt_ros.thesis.words import text, times

RANGE = (-0.02, -0.05, -0.1, -0.2, -0.5, -1.0, -2.0, -3.0)


def _wide_range(runs: Runs) -> Verdict:
    rows, good = [], []
    plain = {name: settled_rms(runs["nonadaptive"], name) for name in ("q3", "q2")}
    errors = {}
    for A in RANGE:
        run = runs[f"A = {A:g}"]
        found = {name: settled_rms(run, name) for name in plain}
        errors[A] = found["q3"]
        if all(x < 0.2 * plain[name] for name, x in found.items()) and chatter(run) < CHATTERS:
            good.append(A)
        cells = (
            f"{text(x)} ({times(plain[name], x)})" if math.isfinite(x) else "lost"
            for name, x in found.items()
        )
        rows.append((f"{A:g}", *cells, text(chatter(run))))
    width = good[-1] / good[0] if good else 0.0
    inside = [errors[A] for A in good]
    monotone = all(after < before for before, after in pairwise(inside))
    small = [A for A in RANGE if abs(A) < abs(good[0])] if good else []
    lost = ", ".join(f"{A:g}" for A in small if not complete(runs[f"A = {A:g}"]))
    remark = (
        f" There is a lower end, too: {lost} unlearns too slowly, and control is lost."
        if lost
        else ""
    )
    return Verdict(
        YES if width >= 10.0 and monotone else ONLY_IF if good else NO,
        {
            "smallest |A| that is quiet and five times as precise": abs(good[0]) if good else None,
            "largest |A| that is": abs(good[-1]) if good else None,
            "ratio of the two": width,
        },
        f"Over a factor of {width:.3g} of A the tracking is quiet and at least five times as "
        f"precise as without deformation, and more precise with every larger |A|.{remark}",
        Table(("A", "q3, rms error [m]", "q2, rms error [rad]", "chatter"), tuple(rows)),
    )


CLAIMS = (
    Claim(
        "3.4.1",
        "3.27",
        "A can be set within a wide range; increasing |A| from a small value considerably "
        "improves the precision (substatement I).",
        {
            "nonadaptive": Setup(TORA, "nonadaptive"),
            **{f"A = {A:g}": Setup(TORA, settings=(f"fpt_deformer.A={A:g}",)) for A in RANGE},
        },
        _wide_range,
    ),
)
