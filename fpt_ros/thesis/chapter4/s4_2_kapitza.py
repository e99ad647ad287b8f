"""Section 4.2: Kapitza's pendulum."""

import numpy as np

from fpt_ros.analysis import signals, style
from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Drawn, Picture, Table, Verdict
from fpt_ros.thesis.judges import follows, precise
from fpt_ros.thesis.measures import chatter, response_errors, responses, rms, settled_rms
from fpt_ros.thesis.setup import Runs, Setup
from fpt_ros.thesis.words import text

KAPITZA = "kapitza"
READINGS = ("(4.7) as printed", "listing", "(4.6)")


def _pendulum_tracks(runs: Runs) -> Verdict:
    verdict = precise("adaptive", "nonadaptive", 100.0)(runs)
    pivot = {
        key: signals.topic(run, "joint_states", "position", "q1")[1][-1]
        for key, run in runs.items()
    }
    force = {
        key: rms(signals.topic(run, "command", "effort", "q1")[1]) for key, run in runs.items()
    }
    return Verdict(
        verdict.status,
        {
            **verdict.measured,
            "height of the pivot after 20 s, adaptive [m]": float(pivot["adaptive"]),
            "force Q1, rms, nonadaptive [N]": force["nonadaptive"],
            "force Q1, rms, adaptive [N]": force["adaptive"],
        },
        f"{verdict.reason} Nothing controls the pivot, though: it falls freely.",
    )


def _three_readings(runs: Runs) -> Verdict:
    rows, size = [], {}
    for key in (*READINGS, "(4.7), one side"):
        run = runs[key]
        h = response_errors(run)
        size[key] = chatter(run)
        pivot = float(signals.topic(run, "joint_states", "position", "q1")[1][-1])
        rows.append(
            (
                key,
                text(settled_rms(run, "q2")),
                text(rms(h)),
                text(size[key]),
                f"{pivot:.4g}",
            )
        )
    loud = [key for key in READINGS if size[key] > 0.05]
    quiet = READINGS[0] not in loud
    unharmed = all(settled_rms(runs[key], "q2") < 1e-3 for key in READINGS)
    return Verdict(
        (ONLY_IF if loud else YES) if quiet and unharmed else NO,
        {f"chatter, {key} [rad/s²]": size[key] for key in READINGS},
        "Only if (4.7) is taken as printed, with the factor |q2| that shrinks the gain of the "
        "loop, and the motion stays within |q2| < 0.51: the program listing and (4.6) turn the "
        "same A = -10 into a regular cycle of two, as their limit is about 5.1, and so does "
        "(4.7) beside the upright position, where |q2| reaches 0.7. The tracking is unharmed in "
        "all of them.",
        Table(
            (
                "law of the pivot",
                "q2, rms error",
                "response error",
                "chatter",
                "pivot at the end [m]",
            ),
            tuple(rows),
        ),
    )


def cycle_figure(runs: Runs, keys: tuple[str, ...], start: float, count: int) -> Drawn:
    """A few cycles of the responses of one coordinate."""
    cells: list[tuple[str, str, str, tuple[draw.Curve, ...]]] = []
    realised_line = style.thin(style.COORDINATES[1])
    for key in keys:
        time, desired, _, realised = responses(runs[key])
        at = int(np.searchsorted(time, start))
        part = slice(at, at + count)
        n = np.arange(count, dtype=np.float64)
        curves = (
            (n, desired[part, 0], "" if cells else "desired", style.BAND),
            (n, realised[part, 0], "" if cells else "realised", {**realised_line, "marker": "."}),
        )
        cells.append((key, "cycle", "response of q2 [rad/s²]" if not cells else "", curves))
    return draw.charts(*cells)


CLAIMS = (
    Claim(
        "4.2.1",
        "4.9-4.11, 4.14-4.15",
        "The adaptive control with the new function F(x) = atanh(tanh(x + D)/2) tracks the "
        "prescribed motion of the pendulum, by moving its pivot vertically.",
        {"nonadaptive": Setup(KAPITZA, "nonadaptive"), "adaptive": Setup(KAPITZA)},
        _pendulum_tracks,
        (
            Picture(
                "4.9, 4.10, 4.11", "Trajectory tracking", draw.tracking("nonadaptive", "adaptive")
            ),
            Picture("4.10, 4.11", "Tracking error", draw.errors("nonadaptive", "adaptive")),
            Picture("4.14, 4.15", "Force Q1", draw.forces("nonadaptive", "adaptive")),
        ),
    ),
    Claim(
        "4.2.1",
        "4.12-4.13",
        "The realised second derivative of q2 follows the desired one, while the deformed one "
        "differs.",
        {"nonadaptive": Setup(KAPITZA, "nonadaptive"), "adaptive": Setup(KAPITZA)},
        follows("adaptive", "nonadaptive", 50.0),
        (
            Picture("4.12", "Second derivatives", draw.responses("nonadaptive", "adaptive")),
            Picture("4.13", "Second derivatives, excerpt", draw.zoomed("nonadaptive", "adaptive")),
        ),
    ),
    Claim(
        "4.2.1",
        "4.10, 4.12-4.13",
        "A = -10 suits the law of the pivot (4.7), as the program listing realises it.",
        {
            "(4.7) as printed": Setup(KAPITZA),
            "listing": Setup(KAPITZA, "listing"),
            "(4.6)": Setup(KAPITZA, "with_gravity"),
            "(4.7), one side": Setup(KAPITZA, "offset"),
        },
        _three_readings,
        (Picture("", "Twenty cycles", lambda runs: cycle_figure(runs, READINGS, 10.0, 20)),),
    ),
)
