"""The Lorenz system with three inputs (Lorenz 1963; krisztiankosi/Control, VSSM_MIMO).

    x' = sigma (y - x) + u_x,   y' = x (rho - z) - y + u_y,   z' = x y - beta z + u_z

A plant of order 1. The model ``lorenz`` has the same equations; ``lorenz_incomplete``, of the
source's program, leaves out y of the second one and has y in the place of x y in the third: its
error does not vanish with exact parameters.
"""

from dataclasses import replace

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter
from fpt_ros.plants import Model, Plant

COORDINATES = ("x", "y", "z")

PARAMETERS = (
    Parameter("sigma", "Prandtl number"),
    Parameter("beta", "geometry of the convection cell"),
    Parameter("rho", "Rayleigh number over the critical one"),
)


def response(c: Vector, q: Vector, v: Vector, effort: Vector, out: MutableVector) -> None:
    """First derivatives caused by (u_x, u_y, u_z)."""
    x, y, z = q[0], q[1], q[2]
    out[0] = c[0] * (y - x) + effort[0]
    out[1] = x * (c[2] - z) - y + effort[1]
    out[2] = x * y - c[1] * z + effort[2]


def effort(c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """The inputs that should cause r."""
    x, y, z = q[0], q[1], q[2]
    out[0] = r[0] - c[0] * (y - x)
    out[1] = r[1] - (x * (c[2] - z) - y)
    out[2] = r[2] - (x * y - c[1] * z)


def incomplete_effort(
    c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector
) -> None:
    """The inputs that should cause r, by the model of the source."""
    x, y, z = q[0], q[1], q[2]
    out[0] = r[0] - c[0] * (y - x)
    out[1] = r[1] - x * (c[2] - z)
    out[2] = r[2] - y + c[1] * z


PLANT = Plant(
    coordinates=COORDINATES,
    units=("", "", ""),
    effort_units=("", "", ""),
    parameters=PARAMETERS,
    coefficients=tuple,
    response=response,
    order=1,
)

MODEL = Model(
    coordinates=COORDINATES,
    controlled=COORDINATES,
    parameters=PARAMETERS,
    coefficient_names=(),
    coefficients=tuple,
    effort=effort,
)

INCOMPLETE = replace(MODEL, effort=incomplete_effort)
