"""TORA of section 3.2.2 a second time, written from the experiment's description alone.

Nothing here comes from the package; the arithmetic is spelled out in scalars on purpose, so that
a mistake in the package's matrices, generator or spline cannot be repeated here.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

G = 9.81
MASS, CART, LENGTH, INERTIA = 20.0, 30.0, 2.0, 20.0
MASS_A, CART_A, LENGTH_A, INERTIA_A = 10.0, 20.0, 2.0, 5.0
K, D = 0.5, 0.6
LAMBDA = 6.0
KNOT = 0.5
SHAPE = np.array([0.0, 0.7, 1.0, 0.7, 0.0, -0.7, -1.0, -0.7])


@dataclass
class Record:
    """Trajectories; the columns of r and desired belong to (q3, q2), those of q to (q1, q2, q3)."""

    q: Array
    r: Array
    force: Array
    error: Array


def fixed_points() -> tuple[float, float]:
    """Attractive and repulsive fixed point of F(x) = atanh(tanh x - K) + D."""
    half_width = 0.5 * np.arccosh(2.0 * np.sinh(D) / K - np.cosh(D))
    return float(D / 2 + half_width), float(D / 2 - half_width)


def second_derivatives(values: Array) -> Array:
    """Second derivatives at the knots of the periodic C2 cubic through `values`."""
    n = len(values)
    matrix = 4.0 * np.eye(n)
    for i in range(n):
        matrix[i, (i + 1) % n] += 1.0
        matrix[i, (i - 1) % n] += 1.0
    bend = np.roll(values, -1) - 2.0 * values + np.roll(values, 1)
    solved: Array = np.linalg.solve(matrix, 6.0 / KNOT**2 * bend)
    return solved


def nominal(t: float, values: Array, curvature: Array) -> tuple[float, float, float]:
    """Value, rate and acceleration at t."""
    n = len(values)
    phase = t % (n * KNOT)
    i = min(int(phase / KNOT), n - 1)
    right = phase - i * KNOT
    left = KNOT - right
    y0, y1 = float(values[i]), float(values[(i + 1) % n])
    m0, m1 = float(curvature[i]), float(curvature[(i + 1) % n])
    c0, c1 = y0 / KNOT - m0 * KNOT / 6.0, y1 / KNOT - m1 * KNOT / 6.0
    position = (m0 * left**3 + m1 * right**3) / (6.0 * KNOT) + c0 * left + c1 * right
    rate = (m1 * right**2 - m0 * left**2) / (2.0 * KNOT) + c1 - c0
    return position, rate, (m0 * left + m1 * right) / KNOT


def simulate(a: float | None, duration: float, dt: float = 1e-3) -> Record:
    """Run the loop with the parameter A of the transformation; None: no deformation."""
    star, floor = fixed_points()
    shapes = [0.3 * SHAPE, 0.5 * SHAPE]
    curvatures = [second_derivatives(shape) for shape in shapes]
    cycles = round(duration / dt)
    record = Record(
        np.zeros((cycles, 3)), np.zeros((cycles, 2)), np.zeros((cycles, 2)), np.zeros((cycles, 2))
    )
    q1 = q2 = q3 = v1 = v2 = v3 = 0.0
    integral = [0.0, 0.0]
    r = [0.0, 0.0]
    response = [0.0, 0.0]
    for n in range(cycles):
        desired, errors = [], []
        for i, (q, v) in enumerate(((q3, v3), (q2, v2))):
            position, rate, acceleration = nominal(n * dt, shapes[i], curvatures[i])
            e = position - q
            desired.append(
                acceleration
                + 3.0 * LAMBDA**2 * e
                + 3.0 * LAMBDA * (rate - v)
                + LAMBDA**3 * integral[i]
            )
            errors.append(e)
        if n == 0 or a is None:
            r = list(desired)
        else:
            h = [response[0] - desired[0], response[1] - desired[1]]
            norm = float(np.sqrt(h[0] ** 2 + h[1] ** 2))
            if norm > 1e-12:
                x = max(a * norm + star, floor)
                step = float(np.arctanh(np.tanh(x) - K)) + D - star
                r = [r[0] + step * h[0] / norm, r[1] + step * h[1] / norm]
        s, c = float(np.sin(q1)), float(np.cos(q1))
        # the corrected (3.18) with the approximate parameters
        ml = MASS_A * LENGTH_A
        total = MASS_A + CART_A
        arm = ml * LENGTH_A + INERTIA_A
        force1 = (
            (-arm * total / (ml * c) + ml * c) * r[0]
            + INERTIA_A * r[1]
            + arm * s / c * v1**2
            - ml * G * s
        )
        force2 = -total * INERTIA_A / (ml * c) * r[0] + INERTIA_A * r[1] + INERTIA_A * s / c * v1**2
        # the exact plant: row 1 minus row 2 and row 3 are two equations for q1'' and q3''
        ml = MASS * LENGTH
        total = MASS + CART
        right1 = force1 - force2 + ml * G * s
        right3 = ml * s * v1**2
        determinant = ml * LENGTH * total - (ml * c) ** 2
        a1 = (right1 * total - ml * c * right3) / determinant
        a3 = (ml * LENGTH * right3 - ml * c * right1) / determinant
        a2 = force2 / INERTIA - a1
        record.q[n] = q1, q2, q3
        record.r[n] = r
        record.force[n] = force1, force2
        record.error[n] = errors
        response = [a3, a2]
        q1, q2, q3 = q1 + dt * v1, q2 + dt * v2, q3 + dt * v3
        v1, v2, v3 = v1 + dt * a1, v2 + dt * a2, v3 + dt * a3
        integral = [integral[0] + dt * errors[0], integral[1] + dt * errors[1]]
    return record
