"""Section 3.1.1: the bare iteration, from monotone convergence to chaos."""

import numpy as np

from fpt_ros.analysis import style
from fpt_ros.parameters import Value, resolve
from fpt_ros.runs.run import Array, Run
from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.chapter3.s3_1_1_fixed_points import CONSTANTS, D, K
from fpt_ros.thesis.claim import NO, YES, Claim, Drawn, Picture, Verdict
from fpt_ros.thesis.measures import complete, end, norms, responses
from fpt_ros.thesis.setup import Runs, Setup
from fpt_ros.thesis.words import because
from fpt_ros.transformations import sgfpt


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
        f"{-1.0 / sgfpt.derivative(CONSTANTS, sgfpt.fixed_points(K, D)[0]):.4g}.",
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
    return sgfpt.derivative(CONSTANTS, u + sgfpt.fixed_points(K, D)[0])


def bifurcation_figure(runs: Runs) -> Drawn:
    """Where the bare iteration ends, over A."""
    law, points_A, points_r = sgfpt.SGFPT, [], []
    for A in np.linspace(-6.36, -0.2, 620):
        given: dict[str, Value] = {"A": float(A), "K": K, "D": D, "guard": False, "form": "signed"}
        constants = law.prepare(resolve(law.parameters, given, "the bare iteration"))
        r = [-4.0]
        for i in range(260):
            law.deform(constants, r, [r[0] + 3.0], [r[0]], [-3.0], r)
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

CLAIMS = (
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
