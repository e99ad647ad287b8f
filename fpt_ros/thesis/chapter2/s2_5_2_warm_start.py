"""Section 2.5.2: the inner iteration started at zero, or at its last result."""

from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.chapter2.s2_5_coupled_masses import MASSES
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Picture, Verdict
from fpt_ros.thesis.learning import coefficient_table, coefficients, learned, window
from fpt_ros.thesis.measures import response_errors, rms, settled_rms
from fpt_ros.thesis.setup import Runs, Setup


def _same_smoothness(runs: Runs) -> Verdict:
    ratios = {
        name: settled_rms(runs["cold"], name) / settled_rms(runs["warm"], name)
        for name in ("q1", "q2")
    }
    close = all(0.8 < ratio < 1.25 for ratio in ratios.values())
    measured = {
        f"{name}, rms error, {key} start [m]": settled_rms(runs[key], name)
        for name in ratios
        for key in ("cold", "warm")
    }
    reason = ", ".join(f"{ratio:.3g} ({name})" for name, ratio in ratios.items())
    return Verdict(
        YES if close else NO,
        measured,
        f"Errors with a cold start over those with a warm: {reason}.",
    )


WINDOWS = ((0.5, 2.0), (2.0, 5.0), (15.0, 20.0))


def _known_term(runs: Runs) -> Verdict:
    measured: dict[str, float | str | None] = {}
    smaller: list[float] = []
    ratios: list[float] = []
    for start, stop in WINDOWS:
        for name, what in (("known_term", "known term"), ("inner_residual", "inner residual")):
            cold, warm = (window(runs[key], name, start, stop) for key in ("cold", "warm"))
            measured[f"{what}, rms from {start:g} to {stop:g} s, cold"] = cold
            measured[f"{what}, rms from {start:g} to {stop:g} s, warm"] = warm
            (smaller if name == "known_term" else ratios).append(warm / cold)
    held = [ratio < 1.0 for ratio in smaller]
    return Verdict(
        YES if all(held) else ONLY_IF if held[-1] else NO,
        measured,
        f"The known term itself is {1 - smaller[-1]:.0%} smaller at the end with a warm start; "
        f"what the inner iteration leaves unsolved of it is {1 / max(ratios):.3g} to "
        f"{1 / min(ratios):.3g} times smaller.",
    )


def _faster_learning(runs: Runs) -> Verdict:
    cold, warm = ({n: learned(*c) for n, c in coefficients(runs[key]).items()} for key in runs)
    closer = [name for name in warm if warm[name] > cold[name]]
    named = ("m1", "k1L1", "k2", "m2g", "b2")
    agreeing = sum(name in closer for name in named)
    done = sum(part >= 0.9 for part in warm.values())
    most = len(closer) > len(warm) / 2
    return Verdict(
        YES if most and agreeing == len(named) else ONLY_IF if most else NO,
        {
            "parameters closer to the exact value with a warm start, of 10": float(len(closer)),
            "of theta 1, 4, 5, 9, 10 in particular": float(agreeing),
            "parameters with 90 % of their error gone after 20 s": float(done),
        },
        f"After 20 s {len(closer)} of 10 are closer to their exact values with the warm start. "
        "Faster is not far, though: m1 g and k1 L1 have the same column, so that only 8 "
        "combinations can be identified at all, and with alpha = 0.3 none of them is there after "
        "20 s.",
        coefficient_table(runs),
    )


def _switched_on(runs: Runs) -> Verdict:
    measured: dict[str, float | str | None] = {}
    ratios = []
    for key, run in runs.items():
        before = rms(response_errors(run, 0.0, 0.5))
        after = rms(response_errors(run, 0.7, 2.0))
        measured[f"realised - desired, rms before 0.5 s, {key} [m/s²]"] = before
        measured[f"realised - desired, rms from 0.7 to 2 s, {key} [m/s²]"] = after
        ratios.append(before / after)
    return Verdict(
        YES if min(ratios) > 10.0 else NO,
        measured,
        f"It becomes at least {min(ratios):.3g} times smaller within 0.2 s.",
    )


CLAIMS = (
    Claim(
        "2.5.2",
        "2.20-2.25",
        "Starting the inner iteration at zero gives nearly the same smooth tracking as starting "
        "it at its last result.",
        {"cold": Setup(MASSES, "cold"), "warm": Setup(MASSES)},
        _same_smoothness,
        (
            Picture("2.20, 2.21", "Trajectory tracking", draw.tracking("cold", "warm")),
            Picture("2.22, 2.23", "Tracking error", draw.errors("cold", "warm")),
            Picture("2.24, 2.25", "Phase trajectories", draw.phases("cold", "warm")),
        ),
    ),
    Claim(
        "2.5.2",
        "2.26-2.27",
        "The error of the known term decreases faster when the inner iteration starts warm.",
        {"cold": Setup(MASSES, "cold"), "warm": Setup(MASSES)},
        _known_term,
        (
            Picture(
                "2.26, 2.27",
                "Error of the known term",
                draw.parameters("cold", "warm", names=("known_term", "inner_residual")),
                "The known term ||a||, and what the inner iteration leaves of it.",
            ),
        ),
    ),
    Claim(
        "2.5.2",
        "2.28-2.31",
        "With the warm start most parameters are learned faster, such as theta 1, 4, 5, 9 and 10.",
        {"cold": Setup(MASSES, "cold"), "warm": Setup(MASSES)},
        _faster_learning,
        (Picture("2.28-2.31", "Dynamic parameters", draw.parameters("cold", "warm")),),
    ),
    Claim(
        "2.5.2",
        "2.32-2.33",
        "Once adaptivity is switched on at 0.5 s, the realised second derivatives approach the "
        "desired ones, and the deformed ones separate.",
        {"cold": Setup(MASSES, "cold"), "warm": Setup(MASSES)},
        _switched_on,
        (
            Picture(
                "2.32, 2.33",
                "Second derivatives, the first two seconds",
                draw.responses("cold", "warm", first=2.0),
            ),
        ),
    ),
)
