"""Fixed point transformations, one a file: they deform the response that is asked of the model.

Asked for r_{k-1} through the approximate model, the plant answered with f(r_{k-1}). With the
response error h = f(r_{k-1}) - r_k^Des a transformation gives r_k = G(r_{k-1}, h). Where h = 0 it
leaves r as it is: the solution of the control task is its fixed point; where G is contractive the
iteration converges to it (Banach; thesis sections 2.1 and 3.1).
"""

from collections.abc import Callable
from dataclasses import dataclass

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values
from fpt_ros.registry import Kind

Deform = Callable[[Vector, Vector, Vector, Vector, Vector, MutableVector], None]
"""(constants, r, h, f, desired, out)"""

TINY = 1e-12
"""Response errors below this norm leave r unchanged: h/||h|| means nothing there."""

FORM = Parameter(
    "form",
    "signed: each coordinate by itself; norm: one step along h/||h||",
    "norm",
    choices=("norm", "signed"),
    live=False,
)


@dataclass(frozen=True)
class Transformation:
    """A map r -> r' with the solution of the control task as its fixed point.

    Attributes:
        parameters: under the thesis's letters (A, B, D, K).
        prepare: checked parameters -> constants, the gain A first, fixed points among them; raises
            BadInput where the parameters give none.
        deform: ``deform(constants, r, h, f, desired, out)`` writes the next r. f is the response
            observed, h = f - desired its error (weighted). All vectors are over the controlled
            coordinates. NaN where it is not defined.
        slope: constants -> what the step is close to: r' = r + A slope h for a small response
            error h. The range of A in which the iteration contracts follows from it.
        step_limit: constants -> the largest step that the transformation can make towards the
            solution (inf: none), for A of the sign that converges.
        adapts: whether it deforms at all; of ``none`` alone it does not.
    """

    parameters: tuple[Parameter, ...]
    prepare: Callable[[Values], tuple[float, ...]]
    deform: Deform
    slope: Callable[[Vector], float]
    step_limit: Callable[[Vector], float]
    adapts: bool = True


TRANSFORMATIONS: Kind[Transformation] = Kind(Transformation, "transformations")
