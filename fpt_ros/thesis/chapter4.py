"""Chapter 4: the stretched sigmoid, time sharing, a new function, and fuzzy models."""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from fpt_ros.analysis import response_figures, signals, style
from fpt_ros.analysis.sizes import finite
from fpt_ros.plants import spherical_pendulum
from fpt_ros.runs.run import Array, Run
from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.claim import (
    NO,
    ONLY_IF,
    YES,
    Claim,
    Drawn,
    Picture,
    Runs,
    Setup,
    Table,
    Verdict,
)
from fpt_ros.thesis.measures import (
    because,
    chatter,
    complete,
    end,
    follows,
    precise,
    response_errors,
    responses,
    rms,
    settled_rms,
    text,
    times,
    tuned,
)
from fpt_ros.transformations import atanh, sgfpt, stretched

TITLE = "Advances in the sigmoid generated fixed point transformation"

# --- 4.1: the stretched sigmoid, and the swing

STRETCHED = (
    "fpt_deformer.transformation=stretched",
    "fpt_deformer.B=2",
    "fpt_deformer.a=0.5",
    "fpt_deformer.b=1",
    "fpt_deformer.K=0",
)


def _defined_everywhere(runs: Runs) -> Verdict:
    shifted, wide = runs["shifted, no guard"], runs["stretched"]
    held = not complete(shifted) and complete(wide)
    return Verdict(
        YES if held else NO,
        {
            "shifted sigmoid without guard, A = -1: ends at [s]": end(shifted),
            "stretched sigmoid, A = -1: ends at [s]": end(wide),
        }
        | {
            f"{name}, rms error, {key}": finite(settled_rms(run, name))
            for name in ("q3", "q2")
            for key, run in runs.items()
        },
        because(
            held,
            "On TORA the first response error throws the argument of the shifted sigmoid out of "
            "the domain of atanh; the stretched one is defined for every argument.",
        ),
    )


def functions_figure(runs: Runs) -> Drawn:
    """The functions F of chapters 3 and 4."""
    x = np.linspace(-4.0, 4.0, 600)
    zeros = (0.0,) * 4
    shown: tuple[tuple[str, Callable[[float], float]], ...] = (
        ("shifted, (3.1)", lambda v: sgfpt.generator((*zeros, 0.5, 0.6), v)),
        ("stretched, (4.1)", lambda v: stretched.generator((*zeros, 2.0, 0.5, 1.0, 0.0), v)),
        ("atanh, (4.4), D = 0.3", lambda v: atanh.generator((*zeros, 0.3), v)),
    )
    curves = [(x, x, "", style.BAND)]
    for (label, F), colour in zip(shown, style.COORDINATES, strict=False):
        curves.append((x, np.array([F(v) for v in x]), label, style.thin(colour)))
    return draw.charts(("Generating functions, and the diagonal", "x", "F(x)", curves))


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


SWING_CLAIMS = (
    Claim(
        "4.1.1",
        "",
        "The stretched sigmoid overcomes the limitation that the shifted one is not defined for "
        "every starting point.",
        {
            "shifted, no guard": Setup(
                "tora", settings=("fpt_deformer.A=-1", "fpt_deformer.guard=false")
            ),
            "stretched": Setup("tora", settings=(*STRETCHED, "fpt_deformer.A=-1")),
        },
        _defined_everywhere,
        (Picture("", "The functions", functions_figure),),
    ),
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

# --- 4.2: Kapitza's pendulum

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


KAPITZA_CLAIMS = (
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


# --- 4.3: the spherical pendulum and fuzzy models

SPHERE = "spherical_pendulum"


def _affine_model(runs: Runs) -> Verdict:
    verdict = precise("adaptive", "nonadaptive", 100.0)(runs)
    return Verdict(
        verdict.status,
        verdict.measured,
        f"{verdict.reason} The model errors do corrupt the non-adaptive tracking: a constant in "
        "the place of all forces is enough once the response is deformed.",
    )


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


def buffered(run: Run) -> Run:
    """The run with the content of the forgetting buffer, calculated from the deformed response."""
    from scipy.signal import lfilter

    delay = int(signals.parameter_number(run, "parameter_tuner", "delay") or 1)
    beta = signals.parameter_number(run, "parameter_tuner", "beta") or 0.99
    more = {}
    names = [name for name in run.topics["tuning"].names if name.startswith("weight.")]
    for name in names:
        r = run.topics["command"].column("accelerations", name.removeprefix("weight."))
        step = r[delay:] - r[:-delay]
        x = step[delay:] * step[:-delay]
        b = lfilter([1.0 - beta], [1.0, -beta], x / (np.abs(x) + 1e-12))
        more[name.replace("weight", "buffer")] = np.concatenate([np.zeros(len(r) - len(b)), b])
    return draw.with_tuning(run, names, more)


def weights_figure(*keys: str) -> Callable[[Runs], Drawn | None]:
    """Weights and buffers of these runs."""
    return draw.panels(response_figures.parameters, *keys, prepare=buffered)


def _fuzzy_functions(runs: Runs) -> Verdict:
    x = np.linspace(0.0, math.pi, 2001)
    apart = {
        "sin": np.abs(np.sin(x) - _fuzzy(spherical_pendulum.SINES, x)).max(),
        "cos": np.abs(np.cos(x) - _fuzzy(spherical_pendulum.COSINES, x)).max(),
    }
    return Verdict(
        YES if max(apart.values()) < 0.1 else NO,
        {f"largest difference from {name} over [0, pi]": float(x) for name, x in apart.items()},
        "Five triangular sets over [0, pi].",
    )


def _fuzzy(singletons: tuple[float, ...], x: Array) -> Array:
    return np.array([spherical_pendulum.fuzzy(singletons, float(value)) for value in x])


def fuzzy_figure(runs: Runs) -> Drawn:
    """Sine and cosine, exact and by fuzzy rules."""
    x = np.linspace(0.0, math.pi, 400)
    curves = (
        (x, np.sin(x), "sin", {"color": style.INK, "linewidth": 1.3}),
        (x, _fuzzy(spherical_pendulum.SINES, x), "fuzzy sin", style.thin(style.COORDINATES[0])),
        (x, np.cos(x), "cos", style.thin(style.COORDINATES[1])),
        (x, _fuzzy(spherical_pendulum.COSINES, x), "fuzzy cos", style.thin(style.DEFORMED)),
    )
    return draw.charts(("sin, cos and their fuzzy approximations", "x [rad]", "", curves))


MODELS = {
    "affine": ("nonadaptive", "adaptive"),
    "fuzzy sine": ("fuzzy_sin_nonadaptive", "fuzzy_sin"),
    "fully fuzzy": ("fully_fuzzy_nonadaptive", "fully_fuzzy"),
}


def model_runs() -> dict[str, Setup]:
    """All models, without and with deformation."""
    return {
        f"{model}, {how}": Setup(SPHERE, variant)
        for model, pair in MODELS.items()
        for how, variant in zip(("nonadaptive", "adaptive"), pair, strict=True)
    }


def _robust_models(runs: Runs) -> Verdict:
    rows, ratios, plain, adaptive = [], [], {}, {}
    for model in MODELS:
        for name in ("q1", "q2"):
            without, with_it = (
                settled_rms(runs[f"{model}, {how}"], name) for how in ("nonadaptive", "adaptive")
            )
            ratios.append(without / with_it)
            plain[model, name], adaptive[model, name] = without, with_it
            rows.append((model, name, text(without), text(with_it), times(without, with_it)))
    gain = plain["affine", "q1"] / plain["fully fuzzy", "q1"]
    nothing = plain["affine", "q1"] / plain["fuzzy sine", "q1"]
    return Verdict(
        YES if min(ratios) > 100.0 else ONLY_IF if max(ratios) > 100.0 else NO,
        {
            "least improvement by the deformation, of all models": min(ratios),
            "q1, non-adaptive: affine over fuzzy sine": nothing,
            "q1, non-adaptive: affine over fully fuzzy": gain,
            "q1, adaptive: affine over fully fuzzy": adaptive["affine", "q1"]
            / adaptive["fully fuzzy", "q1"],
        },
        f"With every model the deformation makes the error at least {min(ratios):.3g} times "
        "smaller. The fuzzy sine alone gains nothing (non-adaptive "
        f"{times(plain['affine', 'q1'], plain['fuzzy sine', 'q1'])}); the fully fuzzy model is "
        f"{gain:.3g} times as precise without deformation.",
        Table(("model", "", "non-adaptive [rad]", "adaptive [rad]", ""), tuple(rows)),
    )


def _pair(model: str) -> dict[str, Setup]:
    without, with_it = MODELS[model]
    return {"nonadaptive": Setup(SPHERE, without), "adaptive": Setup(SPHERE, with_it)}


def _pictures(track: str, response: str, weights: str) -> tuple[Picture[Run], ...]:
    return (
        Picture(track, "Trajectory tracking", draw.tracking("nonadaptive", "adaptive")),
        Picture(track, "Tracking error", draw.errors("nonadaptive", "adaptive")),
        Picture(response, "Second derivatives", draw.responses("nonadaptive", "adaptive")),
        Picture(weights, "Tuned weights, forgetting buffer", weights_figure("adaptive")),
    )


SPHERE_CLAIMS = (
    Claim(
        "4.3.3",
        "4.16-4.18",
        "With the affine model the modelling errors corrupt the non-adaptive tracking; the "
        "adaptive controller is precise.",
        _pair("affine"),
        _affine_model,
        _pictures("4.16, 4.17", "4.18", "4.19")[:3],
    ),
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
    Claim(
        "4.3.4",
        "4.20",
        "Fuzzy rules approximate sin and cos over a bounded region.",
        {},
        _fuzzy_functions,
        (Picture("4.20", "Fuzzy functions", fuzzy_figure),),
    ),
    Claim(
        "4.3.4",
        "4.21-4.24",
        "With the fuzzy sine in the inertia matrix the adaptive controller is precise, the "
        "non-adaptive one is not.",
        _pair("fuzzy sine"),
        precise("adaptive", "nonadaptive", 100.0),
        _pictures("4.21, 4.22", "4.23", "4.24"),
    ),
    Claim(
        "4.3.5",
        "4.25-4.28",
        "With sine and cosine fuzzy in every term (fully soft computing-based model) the "
        "adaptive controller is precise.",
        _pair("fully fuzzy"),
        precise("adaptive", "nonadaptive", 100.0),
        _pictures("4.25, 4.26", "4.27", "4.28"),
    ),
    Claim(
        "4.4.2",
        "4.16-4.28",
        "With an affine and with soft computing-based models the method deals with imprecision "
        "and uncertainty in an efficient and robust way (substatement II).",
        model_runs(),
        _robust_models,
    ),
)

CLAIMS = (*SWING_CLAIMS, *KAPITZA_CLAIMS, *SPHERE_CLAIMS)
