"""Plants called as functions, and derivatives along the motion that they cause."""

import math

import numpy as np


def respond(plant, parameters, q, v, effort):
    """Responses of the plant with these physical parameters."""
    out = [math.nan] * len(plant.coordinates)
    plant.response(plant.coefficients(parameters), q, v, effort, out)
    return out


def exert(model, parameters, q, v, r, s=None):
    """Efforts of the model with these physical parameters."""
    out = [math.nan] * len(model.coordinates)
    none = [0.0] * len(model.coordinates)
    model.effort(model.coefficients(parameters), q, v, r, none if s is None else s, out)
    return out


def regressor_of(model, q, v, w, a):
    """Y as a matrix."""
    columns = len(model.coefficient_names)
    out = [math.nan] * (model.rows * columns)
    model.regressor((), q, v, w, a, out)
    return np.array(out).reshape(model.rows, columns)


def derivative(function, q, v, a, step=1e-5):
    """Central difference of function(q, v) along q' = v, v' = a."""
    q, v, a = map(np.asarray, (q, v, a))

    def at(s):
        return function(q + s * v + 0.5 * s * s * a, v + s * a)

    return (at(step) - at(-step)) / (2.0 * step)


def power(effort, v):
    return sum(x * y for x, y in zip(effort, v, strict=True))
