"""Robust Fixed Point Transformation (thesis (2.13) for one coordinate, (2.22) for several).

With sigma(x) = x / (1 + |x|) and the response error h::

    signed (2.13):  r' = (r + K) (1 + B sigma(A h)) - K
    norm   (2.22):  r' = (1 + b) r + b K h/||h||,   b = B sigma(A ||h||)

Linearised, r' = r + K A B h: with K = -1e5, B = 1, A = 1e-6 a step of -0.1 h. |K| has to be much
larger than any response that occurs.
"""

from fpt_ros.laws import MutableVector, Vector, helper, norm
from fpt_ros.parameters import Parameter, Values, number, word
from fpt_ros.transformations import FORM, TINY, Transformation

PARAMETERS = (
    Parameter("A", "gain A_c of the response error", 1e-6),
    Parameter("B", "B_c, +1 or -1 in the literature", 1.0),
    Parameter("K", "K_c, far larger than the responses, of the sign that converges", -1e5),
    FORM,
)


def prepare(values: Values) -> tuple[float, ...]:
    """Constants (A, B, K, 1 for the signed form or 0)."""
    signed = 1.0 if word(values, "form") == "signed" else 0.0
    return number(values, "A"), number(values, "B"), number(values, "K"), signed


@helper
def sigma(x: float) -> float:
    """The sigmoid x / (1 + |x|) of (2.13)."""
    return x / (1.0 + abs(x))


def deform(
    constants: Vector, r: Vector, h: Vector, f: Vector, desired: Vector, out: MutableVector
) -> None:
    """(2.13) or (2.22)."""
    A, B, K, signed = constants[0], constants[1], constants[2], constants[3]
    if signed:
        for i in range(len(r)):
            out[i] = (r[i] + K) * (1.0 + B * sigma(A * h[i])) - K
        return
    size = norm(h)
    b = B * sigma(A * size) if size >= TINY else 0.0
    for i in range(len(r)):
        out[i] = (1.0 + b) * r[i] + (b * K * h[i] / size if size >= TINY else 0.0)


def slope(constants: Vector) -> float:
    """K B, as r' = r + K A B h for |r| << |K|."""
    return constants[1] * constants[2]


def step_limit(constants: Vector) -> float:
    """|B K|: sigma stays below 1."""
    return abs(constants[1] * constants[2])


RFPT = Transformation(PARAMETERS, prepare, deform, slope, step_limit)
