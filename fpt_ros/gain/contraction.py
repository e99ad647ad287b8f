"""The range of the gain A in which the iteration contracts, and what happens outside it.

Asked for r, the plant answers f(r): the exact response to the approximate model's effort for r.
With J = df/dr over the controlled coordinates, their weights W, and the transformation's slope, a
small response error h is multiplied by

    1 + A slope lambda (1 + feedback),   lambda: the eigenvalues of W J

once every ``learning_delay`` cycles. The feedback: what the response did to the state until it is
used, the desired response takes back. A response that is one cycle old has changed q' by dt f, so
that for a PID law feedback = 3 Lambda dt; with a delay of d cycles d times as much. (In a two-cycle
q' itself alternates, and half of that is left: the limit is on the safe side by half the feedback,
4.6575 instead of 4.699 for TORA, where an error of 1e-9 begins to grow.) A filter between plant and
controller is left out.

A complex eigenvalue turns the response error while it decays: it spirals into the solution for
|A slope lambda| < 2 cos(arg lambda), fastest with half of that, and circles around it beyond.

Beyond the linear limit, and for starts that are not close to the solution, the step's saturation
counts: :mod:`fpt_ros.gain.map`.
"""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from fpt_ros.errors import BadInput
from fpt_ros.experiments.response_map import Point, nominal_points
from fpt_ros.gain.interval import linear_limit, sign_of
from fpt_ros.gain.limits import MARGIN, Gain, times
from fpt_ros.gain.map import scalar_map
from fpt_ros.gain.motion import feedback, spectrum
from fpt_ros.tuning import GAIN

if TYPE_CHECKING:
    from fpt_ros.experiments.experiment import Experiment


ANGLE = 1e-6
"""Eigenvalues that are nearer to the real axis [rad] are real, but for rounding."""


def bounds(experiment: "Experiment", points: Sequence[Point] | None = None) -> Gain:
    """The range of A of an experiment, without running it.

    Args:
        experiment: with a transformation.
        points: of a motion (:func:`fpt_ros.gain.motion.along`); default: the nominal
            one, the coordinates that are not controlled as they are at the start.

    Raises:
        BadInput: it has no transformation, or the model is not defined along the motion.
    """
    loop = experiment.loop()
    deformer = loop.deformer
    transformation = deformer.transformation
    if not transformation.adapts:
        raise BadInput(
            f"{experiment.name} {experiment.variant} has no fixed point transformation "
            "(fpt_deformer.transformation: none): there is no gain to choose"
        )
    found = spectrum(loop, nominal_points(loop) if points is None else points)
    found = found[np.isfinite(found).any(axis=1)]
    if not len(found):
        raise BadInput(
            f"{experiment.name} {experiment.variant}: the approximate model or the plant is not "
            "defined anywhere along the nominal motion"
        )
    real = found.real
    least, greatest = float(np.nanmin(real)), float(np.nanmax(real))
    size = max(abs(least), abs(greatest))
    tiny = 1e-9 * size
    side = 1.0 if least >= -tiny else -1.0
    angles = np.abs(np.angle(side * found[np.isfinite(found)]))
    turn = float(angles.max()) if angles.max() > ANGLE else 0.0
    one_sign = size > 0.0 and (least >= -tiny or greatest <= tiny)
    constants = deformer.constants.transformation
    scalar = scalar_map(transformation, constants, side)
    # the circle |1 - a lambda| = 1 is left at a = 2 Re lambda / |lambda|^2
    steepness = np.zeros(real.shape)
    np.divide(np.abs(found) ** 2, np.abs(real), out=steepness, where=np.abs(real) > tiny)
    of_points = steepness.max(axis=1)
    steepest, flattest = float(of_points.max()), float(of_points.min())
    fed_back = feedback(loop)
    scale = 1.0 / (steepest * (1.0 + fed_back)) if steepest > 0.0 else 1.0
    slope = transformation.slope(constants)
    sign = sign_of(slope, side) if one_sign else 0
    hard = scalar.hard_onset() if not turn else None
    hard_onset = hard.p * scale if hard is not None and one_sign else None
    linear = linear_limit(slope, scale) if one_sign else 0.0
    best = MARGIN * min(0.5 * linear, hard_onset if hard_onset is not None else math.inf)
    low, high = scalar.edges
    return Gain(
        given=deformer.gain,
        calculated=loop.tuner.active and loop.tuner.law.tunes == GAIN,
        sign=sign,
        eigenvalues=(least, greatest),
        turn=turn,
        feedback=fed_back,
        slope=slope,
        step_limit=transformation.step_limit(constants),
        reach=min(-low, high),
        monotone=0.5 * linear,
        linear_limit=linear,
        loosest_limit=linear * steepest / flattest if flattest > 0.0 else math.inf,
        bare_limit=linear * (1.0 + fed_back),
        hard_onset=hard_onset,
        doubling=times(scalar.doubling(), scale) if one_sign and not turn else None,
        chaos=None,
        domain_limit=times(scalar.domain_limit(), scale) if one_sign and not turn else None,
        recommended=sign * _rounded_down(best),
        scale=scale,
        scalar=scalar,
    )


def _rounded_down(x: float) -> float:
    """To two digits."""
    if not 0.0 < x < math.inf:
        return 0.0
    exponent = 1 - math.floor(math.log10(x))
    return round(math.floor(x * 10.0**exponent + 1e-9) / 10.0**exponent, max(exponent, 0))
