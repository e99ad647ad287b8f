"""Kinematic prescription of how the tracking error decays.

(d/dt + Lambda)^n of the tracking error e = q^N - q, or of its integral, is to vanish; solved for
the highest derivative it gives the desired response. Purely kinematic: no model, no force. Beside
it stands the combined error s = (d/dt + Lambda)^(n-1) of the same, of which adaptive laws make use
(thesis, section 2.4).
"""

from collections.abc import Callable
from dataclasses import dataclass

from fpt_ros.laws import helper

Prescription = Callable[[float, float, float, float, float], float]
"""(Lambda [1/s], nominal response, e, e', integral of e [s]) -> desired response."""

RELAX = "ffffff"


@helper
def combined_error(lam: float, e: float, e_dot: float, e_integral: float) -> float:
    """Return s = e' + 2 Lambda e + Lambda^2 int e, (2.17) (the print lacks a derivative)."""
    return e_dot + 2.0 * lam * e + lam * lam * e_integral


def value(lam: float, nominal: float, e: float, e_dot: float, e_integral: float) -> float:
    """Return the nominal response: there is nothing that could decay (sections 3.1.1, 3.2.1)."""
    return nominal


def pi(lam: float, nominal: float, e: float, e_dot: float, e_integral: float) -> float:
    """Return v'Des = v'N + 2 Lambda e + Lambda^2 int e (3.4)."""
    return nominal + lam * (2.0 * e + lam * e_integral)


def pd(lam: float, nominal: float, e: float, e_dot: float, e_integral: float) -> float:
    """Return q''Des = q''N + Lambda^2 e + 2 Lambda e' (section 2.3; v' of section 2.4)."""
    return nominal + lam * lam * e + 2.0 * lam * e_dot


def pid(lam: float, nominal: float, e: float, e_dot: float, e_integral: float) -> float:
    """Return q''Des = q''N + 3 Lambda^2 e + 3 Lambda e' + Lambda^3 int e (2.25), (4.11d)."""
    return nominal + lam * (lam * (3.0 * e + lam * e_integral) + 3.0 * e_dot)


@dataclass(frozen=True)
class Relaxation:
    """A prescription, and the order of the derivative that it prescribes."""

    prescribe: Prescription
    order: int


RELAXATIONS: dict[str, Relaxation] = {
    "value": Relaxation(value, 0),
    "pi": Relaxation(pi, 1),
    "pd": Relaxation(pd, 2),
    "pid": Relaxation(pid, 2),
}
