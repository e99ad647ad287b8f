"""Variable structure with a sliding mode, smoothed by tanh: first order plants.

    v'_d = v'_N + Lambda e + K tanh(S / w),   S = e + Lambda int e

See :mod:`fpt_ros.relaxations.vssm` (krisztiankosi/Control, VSSM_MIMO).
"""

import math

from fpt_ros.laws import Vector
from fpt_ros.relaxations import Relaxation
from fpt_ros.relaxations.vssm import PARAMETERS, prepare


def prescribe(
    constants: Vector, nominal: float, e: float, e_dot: float, e_integral: float
) -> float:
    """Return v'_d."""
    lam, K, w = constants[0], constants[1], constants[2]
    return nominal + lam * e + K * math.tanh((lam * e_integral + e) / w)


VSSM_FIRST_ORDER = Relaxation(prescribe, order=1, parameters=PARAMETERS, prepare=prepare)
