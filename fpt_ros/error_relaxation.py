"""Kinematic prescription of how the tracking error decays.

(d/dt + Lambda)^n of the tracking error e = q^N - q (``pd``, n = 2, thesis section 2.3) or of its
integral (``pid``, n = 3, (4.11d)) is to vanish; solved for the highest derivative it gives the
desired response. Purely kinematic: no model, no force.
"""

from collections.abc import Callable

Relaxation = Callable[[float, float, float, float, float], float]
"""(Lambda [1/s], nominal acceleration, e, e', integral of e [s]) -> desired acceleration."""


def pd(lam: float, nominal: float, e: float, e_dot: float, e_integral: float) -> float:
    """Return q''Des = q''N + Lambda^2 e + 2 Lambda e' (section 2.3)."""
    return nominal + lam * lam * e + 2.0 * lam * e_dot


def pid(lam: float, nominal: float, e: float, e_dot: float, e_integral: float) -> float:
    """Return q''Des = q''N + 3 Lambda^2 e + 3 Lambda e' + Lambda^3 int e (4.11d)."""
    return nominal + lam * (lam * (3.0 * e + lam * e_integral) + 3.0 * e_dot)


RELAXATIONS: dict[str, Relaxation] = {"pd": pd, "pid": pid}
