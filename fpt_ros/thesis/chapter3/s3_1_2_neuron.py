"""Section 3.1.2: one FitzHugh-Nagumo neuron after another."""

import numpy as np

from fpt_ros.analysis import motions, signals, style
from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Drawn, Picture, Verdict
from fpt_ros.thesis.judges import follows
from fpt_ros.thesis.measures import error, rms, settled_rms
from fpt_ros.thesis.setup import Runs, Setup

NEURON = "fitzhugh_nagumo"
NEURONS = {"nonadaptive": Setup(NEURON, "nonadaptive"), "adaptive": Setup(NEURON)}
DISTURBED = {
    "nonadaptive": Setup(NEURON, "nonadaptive_disturbed"),
    "adaptive": Setup(NEURON, "disturbed"),
}


def _relaxes(runs: Runs) -> Verdict:
    found = {key: settled_rms(run, "v") for key, run in runs.items()}
    after: dict[str, float] = {}
    for key in ("nonadaptive", "adaptive"):
        time, e = error(runs[key], "v")
        large = time[np.abs(e) > 0.05]
        after[key] = float(large[-1]) if len(large) else 0.0
    ratio = found["nonadaptive"] / found["adaptive"]
    held = ratio > 5.0, after["adaptive"] < after["nonadaptive"]
    return Verdict(
        YES if all(held) else ONLY_IF if any(held) else NO,
        {f"v, rms error, {key}": value for key, value in found.items()}
        | {f"|error| stays below 0.05 from [s], {key}": value for key, value in after.items()},
        f"The settled error is {ratio:.3g} times smaller. With w from an observer of the "
        "approximate parameters instead of a measurement (the thesis does not say which it had) "
        f"it is {found['nonadaptive'] / found['adaptive, observer']:.3g} times smaller.",
    )


def _phase_distance(runs: Runs) -> Verdict:
    measured: dict[str, float | str | None] = {}
    distance = {}
    for key, run in runs.items():
        motion = motions.motion(run, "v")
        late = signals.settled(run, motion.time)
        apart = np.hypot(motion.error, motion.nominal_velocity - motion.velocity)[late]
        distance[key] = rms(apart)
        measured[f"v, distance in the phase space, rms, {key}"] = distance[key]
    ratio = distance["nonadaptive"] / distance["adaptive"]
    return Verdict(
        YES if ratio > 5.0 else NO,
        measured,
        f"{ratio:.3g} times closer. Nobody controls w: its own error stays.",
    )


def _currents(runs: Runs) -> Verdict:
    used = {}
    for key, run in runs.items():
        time, u = signals.topic(run, "command", "effort", "v")
        used[key] = u[signals.settled(run, time)]
    apart, size = rms(used["adaptive"] - used["nonadaptive"]), rms(used["nonadaptive"])
    return Verdict(
        YES if apart > 0.2 * size else NO,
        {
            "control current, rms, nonadaptive": size,
            "control current, rms, adaptive": rms(used["adaptive"]),
            "difference of the two, rms": apart,
        },
        f"They differ by {apart / size:.0%} of the non-adaptive one.",
    )


def _robust(runs: Runs) -> Verdict:
    found = {key: settled_rms(run, "v") for key, run in runs.items()}
    ratio = found["nonadaptive"] / found["adaptive"]
    return Verdict(
        YES if ratio > 5.0 else NO,
        {f"v, rms error, {key}": value for key, value in found.items()},
        f"{ratio:.3g} times more precise, with an observer for w "
        f"{found['nonadaptive'] / found['adaptive, observer']:.3g} times.",
    )


def recovery_figure(runs: Runs) -> Drawn:
    """W' over w, nominal and realised; the nominal w by the ideal neuron's (3.2b) from its v."""
    cells = []
    for key in ("nonadaptive", "adaptive"):
        run = runs[key]
        motion = motions.motion(run, "v")
        time, w = signals.topic(run, "joint_states", "position", "w")
        _, w_dot = signals.topic(run, "joint_states", "velocity", "w")
        a, tau, b = (
            signals.parameter_number(run, "trajectory_generator", f"ideal.{name}") or 0.0
            for name in ("a", "tau", "b")
        )
        dt = float(time[1] - time[0])
        nominal, slope = np.zeros(len(time)), np.zeros(len(time))
        for i, v in enumerate(motion.nominal):
            slope[i] = (v + a - b * nominal[i]) / tau
            if i + 1 < len(time):
                nominal[i + 1] = nominal[i] + dt * slope[i]
        if np.isnan(w_dot).all():
            w_dot = np.gradient(w, time)
        curves = (
            (nominal, slope, "nominal", style.BAND),
            (w, w_dot, "realised", style.thin(style.COORDINATES[1])),
        )
        cells.append((key, "w", "velocity of w", curves))
    return draw.charts(*cells)


CLAIMS = (
    Claim(
        "3.1.2",
        "3.8-3.9",
        "The adaptive controller relaxes the error faster, and tracks far more precisely.",
        {**NEURONS, "adaptive, observer": Setup(NEURON, "observer")},
        _relaxes,
        (
            Picture("3.8", "Trajectory tracking", draw.tracking("nonadaptive", "adaptive")),
            Picture("3.9", "Tracking error", draw.errors("nonadaptive", "adaptive")),
        ),
    ),
    Claim(
        "3.1.2",
        "3.10-3.11",
        "The same holds for the phase trajectories.",
        NEURONS,
        _phase_distance,
        (
            Picture("3.10", "Phase trajectories of v", draw.phases("nonadaptive", "adaptive")),
            Picture(
                "3.11",
                "Phase trajectories of w, which is not controlled",
                recovery_figure,
            ),
        ),
    ),
    Claim(
        "3.1.2",
        "3.12",
        "Due to the deformation desired and realised derivative of v remain in close vicinity; "
        "in the non-adaptive case they differ significantly.",
        NEURONS,
        follows("adaptive", "nonadaptive", 5.0),
        (Picture("3.12", "Derivatives of v", draw.responses("nonadaptive", "adaptive")),),
    ),
    Claim(
        "3.1.2",
        "3.13",
        "There is a great difference between the control currents, too.",
        NEURONS,
        _currents,
        (Picture("3.13", "Control current", draw.forces("nonadaptive", "adaptive")),),
    ),
    Claim(
        "3.1.2",
        "3.14-3.19",
        "Under disturbance and noise the adaptivity significantly improves the tracking as well.",
        {**DISTURBED, "adaptive, observer": Setup(NEURON, "observer_disturbed")},
        _robust,
        (
            Picture("3.14", "Trajectory tracking", draw.tracking("nonadaptive", "adaptive")),
            Picture("3.15", "Tracking error", draw.errors("nonadaptive", "adaptive")),
            Picture("3.16", "Phase trajectories of v", draw.phases("nonadaptive", "adaptive")),
            Picture(
                "3.17",
                "Phase trajectories of w, which is not controlled",
                recovery_figure,
            ),
            Picture("3.18", "Derivatives of v", draw.responses("nonadaptive", "adaptive")),
            Picture("3.19", "Control current", draw.forces("nonadaptive", "adaptive")),
        ),
    ),
)
