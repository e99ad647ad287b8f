"""Chapter 3: fixed point transformations that sigmoids generate."""

import math
from collections.abc import Mapping
from itertools import pairwise

import numpy as np

from fpt_ros.analysis import motions, signals, style
from fpt_ros.analysis.sizes import finite
from fpt_ros.parameters import Value
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
    error,
    follows,
    norms,
    precise,
    responses,
    rms,
    settled_rms,
    text,
    times,
    tuned,
)
from fpt_ros.transformations import sgfpt

TITLE = "New generation of fixed point transformations for adaptive control"

# --- 3.1.1: the generator, and the bare iteration

K, D = 0.5, 0.6
PRINTED = 0.7114269142


def generator(x: float) -> float:
    """The function of Figs 3.1-3.3."""
    return sgfpt.generator((0.0, 0.0, 0.0, 0.0, K, D), x)


def _two_fixed_points(runs: Runs) -> Verdict:
    attractive, repulsive = sgfpt.fixed_points(K, D)
    slopes = [sgfpt.derivative((0.0, 0.0, 0.0, 0.0, K, D), x) for x in (attractive, repulsive)]
    x = 0.0
    for _ in range(18):
        x = generator(x)
    pair = slopes[0] < 1.0 < slopes[1]
    exact = abs(generator(PRINTED) - PRINTED) < 1e-9
    return Verdict(
        (YES if exact else ONLY_IF) if pair else NO,
        {
            "attractive fixed point x*": f"{attractive:.10f}",
            "slope of F there": slopes[0],
            "repulsive fixed point": f"{repulsive:.10f}",
            "slope of F at that": slopes[1],
            "F(0.7114269142)": f"{generator(PRINTED):.10f}",
            "18th iterate from 0": f"{x:.10f}",
        },
        "There are two, one attractive and one repulsive. Only if x* is computed to the end: the "
        f"printed {PRINTED} is the 18th iterate, an iteration that was stopped too early, and "
        "with it G has no fixed point at all.",
    )


def fixed_point_figure(runs: Runs) -> Drawn:
    """The shifted sigmoid, and the iteration towards the attractive fixed point."""
    x = np.linspace(-1.2, 2.2, 400)
    y = np.array([generator(value) for value in x])
    points = sgfpt.fixed_points(K, D)
    at = np.array(points)
    path = np.array(_cobweb(-0.1, 24))
    dots = {"color": style.DEFORMED, "linestyle": "", "marker": "o", "markersize": 6}
    first, second = style.thin(style.COORDINATES[0]), style.thin(style.COORDINATES[1])
    return draw.charts(
        (
            "g(x) - K and g(x - D), g = tanh",
            "x",
            "",
            (
                (x, np.tanh(x) - K, "tanh x - K", first),
                (x, np.tanh(x - D), "tanh(x - D)", second),
                (at, np.tanh(at) - K, "fixed points", dots),
            ),
        ),
        (
            "F(x), and its iteration from beside the repulsive point",
            "x",
            "F(x)",
            (
                (x, x, "", style.BAND),
                (x, y, "F", first),
                (path[:, 0], path[:, 1], "iteration", {**style.DASHED, "linestyle": "-"}),
                (at, at, "fixed points", dots),
            ),
        ),
    )


def _cobweb(x: float, count: int) -> list[tuple[float, float]]:
    path = [(x, x)]
    for _ in range(count):
        y = generator(x)
        path += [(x, y), (y, y)]
        x = y
    return path


def sizes(run: Run) -> Array:
    """H of every iteration of a bare run; of several coordinates, its norm."""
    _, desired, _, realised = responses(run)
    h = realised - desired
    return h[:, 0] if h.shape[1] == 1 else norms(h)


def below(h: Array, limit: float) -> float | None:
    """Number of iterations until |h| is below a limit."""
    found = np.flatnonzero(np.abs(h) < limit)
    return float(found[0]) if len(found) else None


def _slow_monotone(runs: Runs) -> Verdict:
    h = sizes(runs["A = -0.5"])
    seen = h[np.abs(h) > 1e-12]
    monotone = bool(
        (np.diff(np.abs(seen)) < 0.0).all() and (np.sign(seen) == np.sign(seen[0])).all()
    )
    held = monotone and below(h, 1e-6) is not None
    return Verdict(
        YES if held else NO,
        {
            "iterations until |h| < 1e-2": below(h, 1e-2),
            "iterations until |h| < 1e-6": below(h, 1e-6),
            "contraction at the end": float(seen[20] / seen[19]),
        },
        because(held, "|h| decreases in every iteration and keeps its sign."),
    )


def _fast_monotone(runs: Runs) -> Verdict:
    h, slow = sizes(runs["A = -2"]), sizes(runs["A = -0.5"])
    seen = h[np.abs(h) > 1e-12]
    changes = int(np.sum(np.sign(seen[1:]) != np.sign(seen[:-1])))
    few, many = below(h, 1e-6), below(slow, 1e-6)
    faster = few is not None and many is not None and few < many
    first = ", ".join(f"{value:.3g}" for value in h[:5])
    return Verdict(
        NO if changes else YES if faster else NO,
        {
            "iterations until |h| < 1e-6": few,
            "with A = -0.5": many,
            "changes of the sign of h": float(changes),
        },
        f"Faster, but not monotone: h goes {first}, ... It is monotone up to A = -1/F'(x*) = "
        f"{-1.0 / sgfpt.derivative((0.0,) * 4 + (K, D), sgfpt.fixed_points(K, D)[0]):.4g}.",
    )


def _precursor(runs: Runs) -> Verdict:
    h = sizes(runs["A = -3.12"])
    seen = h[:400]
    alternates = bool((seen[20:] * seen[19:-1] < 0.0).all())
    held = alternates and below(h, 1e-6) is not None
    return Verdict(
        YES if held else NO,
        {
            "iterations until |h| < 1e-3": below(h, 1e-3),
            "iterations until |h| < 1e-6": below(h, 1e-6),
            "contraction at the end": float(seen[-1] / seen[-2]),
        },
        because(
            held,
            "h changes its sign in every iteration and converges slowly, just below the limit A "
            "= -2/F'(x*) = -3.161.",
        ),
    )


def _bounded_chaos(runs: Runs) -> Verdict:
    h = sizes(runs["A = -6"])
    late = h[-1000:]
    slopes = np.log(np.abs(1.0 - 6.0 * np.array([_slope(-6.0 * x) for x in h[500:]])))
    exponent = float(np.mean(slopes))
    escaped = runs["A = -6.5"]
    bounded = complete(runs["A = -6"]) and float(np.abs(late).max()) < 2.0
    held = bounded and exponent > 0.1
    return Verdict(
        YES if held else NO,
        {
            "least r of the last 1000": float(late.min() - 3.0),
            "largest r of the last 1000": float(late.max() - 3.0),
            "Lyapunov exponent [1/iteration]": exponent,
            "A = -6.5 leaves the domain of F after": None if complete(escaped) else end(escaped),
        },
        because(
            held,
            "Bounded, and chaotic: the Lyapunov exponent is positive. From A = -6.363 on it is "
            "not bounded any more, as the orbit leaves the domain of atanh.",
        ),
    )


def _slope(u: float) -> float:
    return sgfpt.derivative((0.0,) * 4 + (K, D), u + sgfpt.fixed_points(K, D)[0])


def bifurcation_figure(runs: Runs) -> Drawn:
    """Where the bare iteration ends, over A."""
    points_A, points_r = [], []
    for A in np.linspace(-6.36, -0.2, 620):
        values: dict[str, Value] = {"A": float(A), "K": K, "D": D, "guard": False, "form": "signed"}
        constants = sgfpt.SGFPT.prepare(values)
        r = [-4.0]
        for i in range(260):
            sgfpt.SGFPT.deform(constants, r, [r[0] + 3.0], [r[0]], [-3.0], r)
            if i >= 200:
                points_A.append(float(A))
                points_r.append(r[0])
    dots = {"color": style.INK, "linestyle": "", "marker": ",", "alpha": 0.6}
    marks = [
        (np.array([A, A]), np.array([-4.5, -2.6]), "", {"color": style.DEFORMED, "linewidth": 0.8})
        for A in (-1.58, -3.161)
    ]
    cell = (
        "Where the iteration ends",
        "A (lines: monotone up to -1.58, convergent up to -3.161)",
        "r",
        ((np.array(points_A), np.array(points_r), "", dots), *marks),
    )
    return draw.charts(cell)


SISO = "siso_affine"
BARE = (
    Claim(
        "3.1.1",
        "3.1-3.3",
        "A shifted sigmoid generates a repulsive and an attractive fixed point; for tanh, K = "
        "0.5 and D = 0.6 the attractive one is x* = 0.7114269142.",
        {},
        _two_fixed_points,
        (Picture("3.1-3.3", "Generation of the fixed points", fixed_point_figure),),
    ),
    Claim(
        "3.1.1",
        "3.4",
        "A = -0.5 gives slow monotone convergence.",
        {"A = -0.5": Setup(SISO)},
        _slow_monotone,
    ),
    Claim(
        "3.1.1",
        "3.5",
        "A = -2 gives fast monotone convergence.",
        {"A = -0.5": Setup(SISO), "A = -2": Setup(SISO, "fast")},
        _fast_monotone,
        (Picture("3.4, 3.5", "Bare iteration", draw.iterations("A = -0.5", "A = -2", first=30)),),
    ),
    Claim(
        "3.1.1",
        "3.6",
        "A = -3.12 gives precursor oscillations: non-monotone convergence.",
        {"A = -3.12": Setup(SISO, "precursor")},
        _precursor,
    ),
    Claim(
        "3.1.1",
        "3.7",
        "A = -6 gives bounded chaotic oscillations.",
        {
            "A = -3.12": Setup(SISO, "precursor"),
            "A = -6": Setup(SISO, "chaos"),
            "A = -6.5": Setup(SISO, settings=("fpt_deformer.A=-6.5",), duration=20000.0),
        },
        _bounded_chaos,
        (
            Picture("3.6, 3.7", "Bare iteration", draw.iterations("A = -3.12", "A = -6", first=80)),
            Picture("", "All A", bifurcation_figure),
        ),
    ),
)

# --- 3.1.2: the neuron

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


NEURON_CLAIMS = (
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
                lambda runs: recovery_figure(runs),
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
                lambda runs: recovery_figure(runs),
            ),
            Picture("3.18", "Derivatives of v", draw.responses("nonadaptive", "adaptive")),
            Picture("3.19", "Control current", draw.forces("nonadaptive", "adaptive")),
        ),
    ),
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


# --- 3.2.1: several coordinates

MIMO = "mimo_affine"
SLOW = tuple(round(-0.05 * i, 2) for i in range(1, 15))
NEAR = "fpt_deformer.initial_response=[0.7287434, -1.5321020]"


def _printed_gain(runs: Runs) -> Verdict:
    h = sizes(runs["A = 0.20"])
    converged = complete(runs["A = 0.20"]) and float(h[-1]) < 1e-3
    return Verdict(
        YES if converged else NO,
        {"||h|| at the start": float(h[0]), "||h|| after 400 iterations": finite(float(h[-1]))},
        "It converges."
        if converged
        else "It diverges: for a response matrix with positive eigenvalues A has to be negative, "
        "as (3.14) itself says.",
    )


def _negative_gain(runs: Runs) -> Verdict:
    found = {key: sizes(run) for key, run in runs.items()}
    counts = {key: (below(h, 1e-3), below(h, 1e-6)) for key, h in found.items()}
    good = all(count is not None for pair in counts.values() for count in pair)
    measured: dict[str, float | str | None] = {}
    for key, (rough, fine) in counts.items():
        measured[f"iterations until ||h|| < 1e-3, {key}"] = rough
        measured[f"iterations until ||h|| < 1e-6, {key}"] = fine
    return Verdict(
        ONLY_IF if good else NO,
        measured,
        because(
            good, "Only if A is taken with the minus that the print has lost: then both converge."
        ),
    )


def _linear_condition(runs: Runs) -> Verdict:
    rows, agreeing = [], []
    for A in SLOW:
        inside = abs(A) < 0.6321492
        near, far = runs[f"near, A = {A:g}"], runs[f"from 0, A = {A:g}"]
        ends = [complete(run) and float(sizes(run)[-1]) < 1e-6 for run in (near, far)]
        agreeing.append((ends[0] == inside, ends[1] == inside))
        if A <= -0.35:
            words = ["converges" if each else "does not" for each in ends]
            rows.append((f"{A:g}", "converges" if inside else "does not", *words))
    near_held, far_held = (all(column) for column in zip(*agreeing, strict=True))
    return Verdict(
        (YES if far_held else ONLY_IF) if near_held else NO,
        {
            "linear bound of A": -0.6321492,
            "last A that converges, started near": min(
                A for A in SLOW if float(sizes(runs[f"near, A = {A:g}"])[-1]) < 1e-6
            ),
            "last A that converges, started at 0": min(
                A for A in SLOW if float(sizes(runs[f"from 0, A = {A:g}"])[-1]) < 1e-6
            ),
        },
        "Only if the iteration starts near the solution: it is a condition of the linearised "
        "map. From r = 0 the iteration ends in a cycle of two before that bound.",
        Table(("A", "(3.14)", "started 1e-3 away", "started at 0"), tuple(rows)),
    )


def _gain(A: float, *more: str) -> Setup:
    return Setup(MIMO, settings=(f"fpt_deformer.A={A:g}", *more))


MIMO_CLAIMS = (
    Claim(
        "3.2.1",
        "3.20",
        "The extension to several coordinates converges for the printed A = 0.20 and A = 0.27425.",
        {"A = 0.20": Setup(MIMO, "printed_sign")},
        _printed_gain,
    ),
    Claim(
        "3.2.1",
        "3.20",
        "The extension along the direction of the response error converges to the desired values "
        "for a coupled affine system, |A| = 0.20 and |A| = 0.27425.",
        {"A = -0.20": Setup(MIMO), "A = -0.27425": Setup(MIMO, "fast")},
        _negative_gain,
        (
            Picture(
                "3.20",
                "Bare iteration in two dimensions",
                draw.iterations("A = -0.20", "A = -0.27425", first=80),
            ),
        ),
    ),
    Claim(
        "3.2.1",
        "",
        "The iteration converges where |1 + F'(x*) A lambda| < 1 for every eigenvalue "
        "(3.13)-(3.15).",
        {
            **{f"near, A = {A:g}": _gain(A, NEAR) for A in SLOW},
            **{f"from 0, A = {A:g}": _gain(A) for A in SLOW},
        },
        _linear_condition,
    ),
)

# --- 3.2.2: TORA

TORA = "tora"
PAIR = {"nonadaptive": Setup(TORA, "nonadaptive"), "adaptive": Setup(TORA)}


def _driving_arm(runs: Runs) -> Verdict:
    positions = {
        key: signals.topic(run, "joint_states", "position", "q1") for key, run in runs.items()
    }
    (time, plain), (_, adaptive) = positions["nonadaptive"], positions["adaptive"]
    late = signals.settled(runs["adaptive"], time)
    apart, size = rms((plain - adaptive)[late]), rms(plain[late])
    return Verdict(
        YES if 0.0 < apart < 0.1 * size else NO,
        {"q1, rms [rad]": size, "difference of the two, rms [rad]": apart},
        f"They differ by {apart / size:.1%}: momentum ties q1 to q3.",
    )


def _larger_gain(runs: Runs) -> Verdict:
    measured: dict[str, float | str | None] = {}
    ratios = []
    for name in ("q3", "q2"):
        found = {key: settled_rms(run, name) for key, run in runs.items()}
        measured |= {f"{name}, rms error, {key}": value for key, value in found.items()}
        ratios.append(found["A = -0.1"] / found["A = -3.125"])
    return Verdict(
        YES if min(ratios) > 2.0 else NO,
        measured,
        f"The errors become another {min(ratios):.3g} to {max(ratios):.3g} times smaller.",
    )


SCAN = (-2.0, -2.4, -2.8, *(round(-3.2 - 0.01 * i, 2) for i in range(71)))
CHATTERS = 0.1
"""Settled mean step [1/s²] of r from which a run counts as chattering: ten times a quiet one's."""


def scanned(runs: Runs) -> Mapping[float, float]:
    """Chatter of the runs of the scan, by A."""
    return {A: chatter(runs[f"A = {A:g}"]) for A in SCAN}


def onset(found: Mapping[float, float]) -> tuple[float, float]:
    """The last A that is quiet before the first that chatters, and that one."""
    for before, after in pairwise(SCAN):
        if found[after] > CHATTERS:
            return before, after
    return SCAN[-1], -math.inf


def _threshold(runs: Runs) -> Verdict:
    found = scanned(runs)
    quiet, loud = onset(found)
    islands = [A for A in SCAN if loud > A and found[A] < CHATTERS]
    here = -3.9 <= loud <= -3.3
    printed = -3.2375 <= loud <= -3.2275
    return Verdict(
        YES if printed else ONLY_IF if here else NO,
        {
            "last quiet A": quiet,
            "first chattering A": loud,
            "chatter at the last quiet A": found[quiet],
            "chatter at the first chattering A": found[loud],
            "scanned A beyond it that are quiet again": float(len(islands)),
        },
        "Only if the nominal trajectory is the thesis's own, which is not printed; with this one "
        f"strong chattering begins just as suddenly, at {loud:g}. From -2.947 to -4.66 quiet "
        "tracking and a cycle of two exist side by side, and the transient decides which of them "
        "comes: that is why some A beyond the onset are quiet again.",
    )


def scan_figure(runs: Runs) -> Drawn:
    """Chatter and error over A."""
    found = scanned(runs)
    A = np.array(SCAN)
    errors = np.array([settled_rms(runs[f"A = {value:g}"], "q3") for value in SCAN])
    dots = {"marker": "o", "markersize": 3, "linewidth": 1.0}
    mark = {"color": style.DEFORMED, "linewidth": 1.2, "linestyle": (0, (4.0, 1.6))}
    printed = np.array([-3.23, -3.23])
    steps = np.array([found[value] for value in SCAN])
    return draw.charts(
        (
            "Chatter",
            "A",
            "mean settled step of r",
            (
                (A, steps, "", {"color": style.COORDINATES[0], **dots}),
                (printed, np.array([steps.min(), steps.max()]), "the thesis's onset", mark),
            ),
        ),
        (
            "Tracking",
            "A",
            "settled rms error of q3 [m]",
            ((A, errors, "", {"color": style.COORDINATES[1], **dots}),),
        ),
        log="y",
    )


ALARM = -0.3
"""Precursor index below which the response alternates: that of the guard."""
RFPT_GAINS = tuple(round(2.8 + 0.01 * i, 2) for i in range(33))


def _sudden(runs: Runs) -> Verdict:
    found = {key: (chatter(run), _least_index(run)) for key, run in runs.items()}
    quiet = found["SGFPT, A = -3.2"][0]
    warned = {
        kind: sum(
            index < ALARM and size < 2.0 * quiet
            for key, (size, index) in found.items()
            if key.startswith(kind)
        )
        for kind in ("SGFPT", "RFPT")
    }
    jump = {kind: _largest_step(kind, found) for kind in warned}
    held = warned["SGFPT"] == 0 and jump["SGFPT"] > 20.0, warned["RFPT"] > 0
    return Verdict(
        YES if all(held) else ONLY_IF if any(held) else NO,
        {
            "largest growth of the chatter within 0.01 of A": jump["SGFPT"],
            "the same of RFPT, within 0.01 of |Kc| A": jump["RFPT"],
            "A with precursors and less than twice the quiet chatter": float(warned["SGFPT"]),
            "the same of RFPT": float(warned["RFPT"]),
        },
        f"Within 0.01 of A the chatter grows {jump['SGFPT']:.3g} times, and no A shows precursor "
        "oscillations without it: the loss of stability is hard. RFPT in its place (Kc = -100, "
        f"tried here; the thesis refers to [43]) loses it softly: with {warned['RFPT']} of the "
        "gains r already alternates while there is hardly any chatter.",
    )


def _least_index(run: Run) -> float:
    time, index = tuned(run, "precursor")
    return float(index[signals.settled(run, time)].min(initial=1.0))


def _largest_step(kind: str, found: Mapping[str, tuple[float, float]]) -> float:
    sizes = np.array([size for key, (size, _) in found.items() if key.startswith(kind)])
    return float(np.max(sizes[1:] / sizes[:-1]))


def onset_figure(runs: Runs) -> Drawn:
    """Chatter and precursor index of both transformations over their gains."""
    cells = []
    for kind, label in (("SGFPT", "A"), ("RFPT", "|Kc| A")):
        keys = [key for key in runs if key.startswith(kind)]
        gain = np.array([float(key.rpartition("= ")[2]) for key in keys])
        size = np.array([chatter(runs[key]) for key in keys])
        index = np.array([_least_index(runs[key]) for key in keys])
        dots = {"marker": "o", "markersize": 3, "linewidth": 1.0}
        curves = (
            (gain, np.log10(size), "log10 of the chatter", {"color": style.COORDINATES[0], **dots}),
            (gain, index, "precursor index", {"color": style.DEFORMED, **dots}),
        )
        cells.append((kind, label, "", curves))
    return draw.charts(*cells)


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


def _scan(A: float) -> Setup:
    return Setup(TORA, settings=(f"fpt_deformer.A={A:g}",), duration=10.0)


def _observed(*deformer: str) -> Setup:
    settings = (*(f"fpt_deformer.{each}" for each in deformer), "parameter_tuner.precursor=true")
    return Setup(TORA, settings=settings, duration=10.0)


TORA_CLAIMS = (
    Claim(
        "3.2.2",
        "3.21-3.23",
        "The adaptive approach significantly improves trajectory and phase trajectory tracking "
        "(A = -0.1).",
        PAIR,
        precise("adaptive", "nonadaptive", 10.0),
        (
            Picture("3.21", "Trajectory tracking", draw.tracking("nonadaptive", "adaptive")),
            Picture("3.22", "Tracking error", draw.errors("nonadaptive", "adaptive")),
            Picture("3.23", "Phase trajectories", draw.phases("nonadaptive", "adaptive")),
        ),
    ),
    Claim(
        "3.2.2",
        "3.24-3.25",
        "Desired and realised second derivatives are in close vicinity, and the deformed ones "
        "considerably different.",
        PAIR,
        follows("adaptive", "nonadaptive", 10.0),
        (
            Picture("3.24", "Second derivatives", draw.responses("nonadaptive", "adaptive")),
            Picture("3.25", "Second derivatives, excerpt", draw.zoomed("nonadaptive", "adaptive")),
        ),
    ),
    Claim(
        "3.2.2",
        "3.26",
        "The trajectory of the driving arm q1 shows subtle differences only.",
        PAIR,
        _driving_arm,
        (Picture("3.26", "The driving arm", draw.uncontrolled("nonadaptive", "adaptive")),),
    ),
    Claim(
        "3.2.2",
        "3.27",
        "Increasing |A| from 0.1 to 3.125 still improves the precision.",
        {"A = -0.1": Setup(TORA), "A = -3.125": Setup(TORA, "strong")},
        _larger_gain,
        (Picture("3.27", "Second derivatives, excerpt", draw.zoomed("A = -0.1", "A = -3.125")),),
    ),
    Claim(
        "3.2.2",
        "",
        "Somewhere between A = -3.23 and A = -3.235 strong chattering appears.",
        {f"A = {A:g}": _scan(A) for A in SCAN},
        _threshold,
        (Picture("", "Chatter and error of all gains", scan_figure),),
    ),
    Claim(
        "3.2.2",
        "",
        "Unlike RFPT, where precursor oscillations appear slowly, this transformation turns into "
        "an oscillating regime very quickly.",
        {
            **{f"SGFPT, A = {A:g}": _observed(f"A={A:g}") for A in SCAN[3:44]},
            **{
                f"RFPT, |Kc| A = {gain:g}": _observed(
                    f"A={gain / 100:g}", "transformation=rfpt", "B=1", "K=-100"
                )
                for gain in RFPT_GAINS
            },
        },
        _sudden,
        (Picture("", "Two kinds of onset", onset_figure),),
    ),
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

# --- 3.3: the calculated gain

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


AUTO_CLAIMS = (
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
        _driving_arm,
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

CLAIMS = (*BARE, *NEURON_CLAIMS, *MIMO_CLAIMS, *TORA_CLAIMS, *AUTO_CLAIMS)
