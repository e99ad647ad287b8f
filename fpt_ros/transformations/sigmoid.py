"""What the sigmoid generated transformations have in common (thesis (3.1), (3.5), (4.10)).

A function F with an attractive fixed point x* moves r by what F moves its argument::

    signed (3.1):  r' = F(A h + x*) - x* + r             each coordinate by itself
    norm   (3.5):  r' = [F(A ||h|| + x*) - x*] h/||h|| + r

The step is at most as long as F reaches, 0.83 for the printed sigmoid: where responses are larger,
or there are many coordinates, that is too little. A ``scale`` S widens the map without changing it
for small errors::

    r' = r + S [F(A ||h|| / S + x*) - x*] h/||h||

Where h = 0, r stays as it is. For A < 0 the norm form uses only the branch x < x* of F, the signed
form both: they are different maps, as F is not odd around x*.
"""

import math
from collections.abc import Callable

from fpt_ros.errors import BadInput
from fpt_ros.laws import MutableVector, Vector, norm
from fpt_ros.parameters import Parameter, Values, number, word
from fpt_ros.transformations import FORM, TINY, Transformation

A = Parameter("A", "gain of the response error; its sign is that of convergence", -0.1)

SCALE = Parameter(
    "scale", "S, by which the map is widened: its steps become longer", 1.0, above=0.0
)

FIRST = 5
"""Constants (A, x*, least argument, 1 for the signed form or 0, S), then those of F."""


def constants(
    values: Values, attractive: float, own: tuple[float, ...], least: float = -math.inf
) -> tuple[float, ...]:
    """The constants of a transformation with the fixed point ``attractive``."""
    signed = 1.0 if word(values, "form") == "signed" else 0.0
    return (number(values, "A"), attractive, least, signed, number(values, "scale"), *own)


def attractive_point(F: Callable[[float], float], start: float, what: str) -> float:
    """The attractive fixed point of F that the iteration from ``start`` reaches, to the last bit.

    Raises:
        BadInput: it reaches none; ``what`` names the parameters.
    """
    x = start
    for _ in range(100_000):
        last, x = x, F(x)
        if not math.isfinite(x):
            break
        if abs(x - last) <= 1e-16 * abs(x):
            return x
    raise BadInput(
        f"{what} give no attractive fixed point: from {start:g} the iteration comes to {x:g} "
        "(the slope of F has to be below 1 where it crosses the diagonal)"
    )


def transformation(
    F: Callable[[Vector, float], float],
    parameters: tuple[Parameter, ...],
    prepare: Callable[[Values], tuple[float, ...]],
    derivative: Callable[[Vector, float], float],
) -> Transformation:
    """The transformation that F generates; F and its derivative take all constants, and x."""

    def deform(
        constants: Vector, r: Vector, h: Vector, f: Vector, desired: Vector, out: MutableVector
    ) -> None:
        gain, attractive, least, scale = constants[0], constants[1], constants[2], constants[4]
        if constants[3] != 0.0:
            for i in range(len(r)):
                x = max(gain * (h[i] / scale) + attractive, least)
                out[i] = r[i] + scale * (F(constants, x) - attractive)
            return
        size = norm(h)
        step = 0.0
        if size > TINY:
            x = max(gain * (size / scale) + attractive, least)
            step = scale * (F(constants, x) - attractive) / size
        for i in range(len(r)):
            out[i] = r[i] + step * h[i]

    def slope(constants: Vector) -> float:
        return derivative(constants, constants[1])

    def step_limit(constants: Vector) -> float:
        lowest = F(constants, max(constants[2], -40.0))
        return constants[4] * (constants[1] - lowest) if math.isfinite(lowest) else math.inf

    return Transformation((A, *parameters, SCALE, FORM), prepare, deform, slope, step_limit)
