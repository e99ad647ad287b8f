"""Section 2.2.2: the modified tuning under disturbances."""

import numpy as np

from fpt_ros.analysis import signals
from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Picture, Verdict
from fpt_ros.thesis.learning import coefficient_table, tuned
from fpt_ros.thesis.measures import complete, end, settled_rms
from fpt_ros.thesis.setup import Runs, Setup

AMPLITUDES = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0)


def _vulnerable(runs: Runs) -> Verdict:
    lost = {A: not complete(runs[f"A = {A:g}"]) for A in AMPLITUDES}
    fatal = [A for A in AMPLITUDES if lost[A]]
    measured: dict[str, float | str | None] = {}
    for A in AMPLITUDES:
        run = runs[f"A = {A:g}"]
        label = f"disturbance with a peak of {0.836 * A:.3g}"
        measured[label] = (
            f"lost at {end(run):.2f} s"
            if lost[A]
            else f"rms error {settled_rms(run, 'q1'):.3g}, least m^ {tuned(run, 'm')[1].min():.3g}"
        )
    strong = runs["A = 50"]
    time, m = tuned(strong, "m")
    small = time[m < 1.0]
    when = (
        f" m^ < 1 from {small[0]:.2f} s on, control is lost at {end(strong):.2f} s."
        if (len(small) and lost[50.0])
        else ""
    )
    if not fatal:
        status, why = NO, "None of these disturbances makes the run diverge."
    elif fatal[0] <= 5.0:
        status, why = YES, f"A peak of {0.836 * fatal[0]:.3g} is enough."
    else:
        status = ONLY_IF
        below = [A for A in AMPLITUDES if fatal[0] > A][-1]
        time, effort = signals.topic(runs["A = 1"], "command", "effort", "q1")
        force = np.abs(effort[time >= 5.0]).max()
        why = (
            "Only if the disturbance is not that small: it takes a peak between "
            f"{0.836 * below:.3g} and {0.836 * fatal[0]:.3g}, where the control force, at most, is "
            f"{force:.3g}."
        )
    return Verdict(
        status,
        measured,
        f"{why} A disturbance drags m^ to zero, where tuning and feedback stop.{when}",
    )


def _disturbed_slowly(runs: Runs) -> Verdict:
    quiet, loud = (settled_rms(runs[key], "q1") for key in ("undisturbed", "disturbed"))
    return Verdict(
        YES if loud > 10.0 * quiet else ONLY_IF if loud > quiet else NO,
        {"rms error, alpha = 1": quiet, "rms error, alpha = 1, disturbed": loud},
        f"The disturbance (A = 50, peak 42) makes the error {loud / quiet:.3g} times as large.",
        coefficient_table(runs),
    )


CLAIMS = (
    Claim(
        "2.2.2",
        "",
        "The speedy learning (alpha = 10) is very vulnerable: even very small external "
        "disturbances make it diverge.",
        {
            **{
                f"A = {A:g}": Setup(
                    "vdp_modified", settings=(f"plant_simulator.disturbance.amplitude={A:g}",)
                )
                for A in AMPLITUDES[:-1]
            },
            "A = 50": Setup("vdp_modified", "alpha10_disturbed"),
        },
        _vulnerable,
        (
            Picture(
                "",
                "The estimated inertia",
                draw.parameters("A = 1", "A = 10", "A = 50", names=("m",)),
            ),
        ),
    ),
    Claim(
        "2.2.2",
        "2.8-2.9",
        "With alpha = 1 a limited disturbance also disturbs the tuning and decreases the quality "
        "of the tracking.",
        {
            "undisturbed": Setup("vdp_modified", "alpha1"),
            "disturbed": Setup("vdp_modified", "alpha1_disturbed"),
        },
        _disturbed_slowly,
        (
            Picture("2.8", "Tracking error", draw.errors("undisturbed", "disturbed")),
            Picture("2.8", "Disturbance forces", draw.disturbance("disturbed")),
            Picture("2.9", "Tuning of the parameters", draw.parameters("undisturbed", "disturbed")),
        ),
    ),
)
