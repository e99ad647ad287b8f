"""Section 3.1.1: the fixed points that a shifted sigmoid generates."""

import numpy as np

from fpt_ros.analysis import style
from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Drawn, Picture, Verdict
from fpt_ros.thesis.setup import Runs
from fpt_ros.transformations import sgfpt, sigmoid

K, D = 0.5, 0.6
CONSTANTS = (0.0,) * sigmoid.FIRST + (K, D)
PRINTED = 0.7114269142


def generator(x: float) -> float:
    """The function of Figs 3.1-3.3."""
    return sgfpt.generator(CONSTANTS, x)


def _two_fixed_points(runs: Runs) -> Verdict:
    attractive, repulsive = sgfpt.fixed_points(K, D)
    slopes = [sgfpt.derivative(CONSTANTS, x) for x in (attractive, repulsive)]
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


CLAIMS = (
    Claim(
        "3.1.1",
        "3.1-3.3",
        "A shifted sigmoid generates a repulsive and an attractive fixed point; for tanh, K = "
        "0.5 and D = 0.6 the attractive one is x* = 0.7114269142.",
        {},
        _two_fixed_points,
        (Picture("3.1-3.3", "Generation of the fixed points", fixed_point_figure),),
    ),
)
