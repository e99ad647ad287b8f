"""Optimal control of a model over horizons, one after the other: the motion that it would take.

In each horizon of N steps h the efforts u_0 .. u_{N-1}, held over a step, make least the sum of::

    |q_{j+1} - q_ref(t_{j+1})|^2 + weight |u_j|^2,   |u_j| <= limit

along the model's own motion (RK4). The first ``applied`` steps of it are taken, and the next
horizon begins where they end.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from fpt_ros.errors import BadInput

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

Acceleration = Callable[[list[float], list[float], list[float]], list[float]]
"""(q, v, effort) -> q'' of the model."""

Reference = Callable[[float], Sequence[float]]
"""t [s] -> q_ref."""


@dataclass(frozen=True)
class Horizon:
    """What is optimised.

    Attributes:
        steps: N.
        step: h [s].
        applied: steps that are taken of each horizon.
        weight: of the effort.
        limit: largest effort; inf: none.
    """

    steps: int
    step: float
    applied: int
    weight: float
    limit: float


def moved(
    acceleration: Acceleration, q: list[float], v: list[float], u: list[float], h: float
) -> tuple[list[float], list[float]]:
    """(q, v) after a step of RK4 under an effort that is held."""
    n = range(len(q))
    dq, dv = [v], [acceleration(q, v, u)]
    for part in (0.5, 0.5, 1.0):
        q_i = [q[i] + part * h * dq[-1][i] for i in n]
        v_i = [v[i] + part * h * dv[-1][i] for i in n]
        dq.append(v_i)
        dv.append(acceleration(q_i, v_i, u))
    weights = (h / 6.0, h / 3.0, h / 3.0, h / 6.0)
    return (
        [q[i] + sum(w * d[i] for w, d in zip(weights, dq, strict=True)) for i in n],
        [v[i] + sum(w * d[i] for w, d in zip(weights, dv, strict=True)) for i in n],
    )


def planned(
    horizon: Horizon,
    acceleration: Acceleration,
    reference: Reference,
    start: list[float],
    until: float,
) -> tuple[list[float], list[list[float]], list[list[float]]]:
    """Times [s], positions and efforts of the motion from ``start``, at rest, up to ``until``.

    Raises:
        BadInput: the model's motion cannot be computed along a horizon.
    """
    import numpy as np
    from scipy.optimize import least_squares

    c, N, h = len(start), horizon.steps, horizon.step
    q, v, now = list(start), [0.0] * c, 0.0
    times, points, efforts = [0.0], [list(start)], []
    guess = np.zeros(N * c)
    scale = horizon.weight**0.5

    def residuals(flat: "Array") -> "Array":
        at, rate, off = q, v, []
        for j in range(N):
            at, rate = moved(acceleration, at, rate, flat[j * c : (j + 1) * c].tolist(), h)
            wanted = reference(now + (j + 1) * h)
            off += [at[i] - wanted[i] for i in range(c)]
        return np.concatenate((np.array(off), scale * flat))

    while now < until - 0.5 * h:
        try:
            found = least_squares(
                residuals,
                guess,
                bounds=(-horizon.limit, horizon.limit),
                method="dogbox",  # keeps to the bounds exactly
                xtol=1e-12,
                ftol=1e-13,
                gtol=1e-12,
            )
        except (ArithmeticError, ValueError) as error:
            raise BadInput(
                f"trajectory_generator.horizon: from {now:g} s on the model cannot be optimised "
                f"({error}): a shorter horizon.steps, or a larger horizon.effort_weight"
            ) from error
        plan = found.x.reshape(N, c)
        for j in range(horizon.applied):
            q, v = moved(acceleration, q, v, plan[j].tolist(), h)
            efforts.append(plan[j].tolist())
            times.append(times[-1] + h)
            points.append(list(q))
        now = times[-1]
        guess = np.vstack((plan[horizon.applied :], plan[-1:].repeat(horizon.applied, 0))).ravel()
    return times, points, efforts
