"""Section 4.1.2: the swing, two coordinates that share one torque in time."""

import numpy as np
from numpy.typing import NDArray

from fpt_ros.analysis import signals
from fpt_ros.analysis.sizes import finite
from fpt_ros.runs.run import Array
from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Picture, Verdict
from fpt_ros.thesis.measures import responses, rms, settled_rms
from fpt_ros.thesis.setup import Runs, Setup
from fpt_ros.thesis.words import times

SWINGS = {"nonadaptive": Setup("swing", "nonadaptive"), "adaptive": Setup("swing")}


def _time_sharing(runs: Runs) -> Verdict:
    measured: dict[str, float | str | None] = {}
    ratios = []
    for name in ("q1", "q2"):
        found = {key: settled_rms(run, name) for key, run in runs.items()}
        measured |= {f"{name}, rms error, {key} [rad]": finite(x) for key, x in found.items()}
        ratios.append(found["nonadaptive"] / found["adaptive"])
    near, far = (settled_rms(runs[key], "q2") for key in ("adaptive", "adaptive, 2.0 rad/s"))
    fails = far > 20.0 * near
    good = min(ratios) > 2.0
    return Verdict(
        (ONLY_IF if fails else YES) if good else NO,
        measured,
        "Only if the nominal swing is near the natural frequency (2.11 rad/s), where it is nearly "
        f"compatible with q2 = 0: the errors are then {ratios[0]:.3g} (q1) and {ratios[1]:.3g} "
        "(q2) times smaller than non-adaptive. With 2.0 rad/s instead of 2.1 the error of q2 is "
        f"{times(near, far)}, with adaptation or without: no time sharing makes the two motions "
        "compatible."
        if fails
        else f"The errors are {ratios[0]:.3g} (q1) and {ratios[1]:.3g} (q2) times smaller.",
    )


SLOTS = (2.0, 0.5)


def _slot_convergence(runs: Runs) -> Verdict:
    measured: dict[str, float | str | None] = {}
    size = {}
    for key, run in runs.items():
        time, desired, _, realised = responses(run)
        late = signals.settled(run, time)
        into = np.mod(time + 1e-7, sum(SLOTS))
        into = np.where(into >= SLOTS[0], into - SLOTS[0], into)
        used = late & (into > 0.02)
        for i, name in enumerate(("q1", "q2")):
            h = (realised - desired)[used, i]
            size[key, name] = rms(h)
            measured[f"{name}: realised - desired, rms in its slots, {key} [rad/s²]"] = rms(h)
        if key == "adaptive":
            measured["response error 20 ms after a change of slot, median part left"] = _left(
                time, np.nan_to_num(realised - desired), late
            )
    ratios = [size["nonadaptive", n] / size["adaptive", n] for n in ("q1", "q2")]
    return Verdict(
        YES if min(ratios) > 10.0 else ONLY_IF if max(ratios) > 10.0 else NO,
        measured,
        f"20 ms after each change of slot the difference is {ratios[0]:.3g} (q1) and "
        f"{ratios[1]:.3g} (q2) times smaller than non-adaptive.",
    )


def _left(time: Array, h: Array, late: NDArray[np.bool_]) -> float:
    """What is left of the response error 20 ms after a change of slot, median over the changes."""
    size = np.abs(h).sum(axis=1)
    starts = [
        i
        for i in np.flatnonzero(late)
        if round(time[i] * 1e4) % 25000 in (0, 20000) and i + 200 < len(size)
    ]
    return float(np.median([size[i + 200] / size[i] for i in starts]))


CLAIMS = (
    Claim(
        "4.1.2",
        "4.3-4.4",
        "Time sharing distributes the error between two coordinates that one torque drives, and "
        "the adaptive control tracks better.",
        {
            **SWINGS,
            "adaptive, 2.0 rad/s": Setup(
                "swing",
                settings=(
                    "trajectory_generator.frequency=[2.0, 1.0]",
                    "plant_simulator.initial_velocity=[0.6, 0.0]",
                ),
            ),
        },
        _time_sharing,
        (
            Picture("4.3, 4.4", "Trajectory tracking", draw.tracking("nonadaptive", "adaptive")),
            Picture("", "Tracking error", draw.errors("nonadaptive", "adaptive")),
        ),
    ),
    Claim(
        "4.1.2",
        "4.5-4.6",
        "Without adaptivity desired and realised second derivatives seriously differ; with it "
        "the realised one quickly converges to the desired one in each time slot.",
        SWINGS,
        _slot_convergence,
        (
            Picture(
                "4.5, 4.6",
                "Second derivatives, excerpt about a change of slots",
                draw.zoomed("nonadaptive", "adaptive", first=7.0),
                "Each coordinate has values in its own time slots only.",
            ),
        ),
    ),
)
