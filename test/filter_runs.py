"""Runs of causal filters on a recording of positions, for the tests of all of them."""

import math
from collections import deque

import numpy as np

from fpt_ros.denoising.streaming import ORDER, Update
from fpt_ros.engine import compiled
from fpt_ros.parameters import resolve

DT = 1e-3


def constants_of(law, n=1, dt=DT, **given):
    return law.prepare(resolve((ORDER, *law.parameters), given, "test"), n, dt)


def run(law, q, dt=DT, vector=list, update=None, **given):
    """Estimates of q, v and response, shape (samples, 3, n); NaN for the first sample.

    ``vector`` makes the vectors that the law gets, ``update`` replaces its update.
    """
    q = np.asarray(q, dtype=float)
    q = q.reshape(len(q), -1)
    n = q.shape[1]
    constants = vector(constants_of(law, n, dt, **given))
    state = vector([0.0] * law.state_size(constants, n))
    v = vector([math.nan] * n)
    law.start(constants, state, vector(q[0].tolist()), v)
    step = update or law.update
    out = np.full((len(q), 3, n), math.nan)
    results = [vector([math.nan] * n) for _ in range(3)]
    for k in range(1, len(q)):
        step(constants, state, dt, vector(q[k].tolist()), v, *results)
        out[k] = results
    return out


def filtered(law, q, dt=DT, **given):
    """Estimates of one coordinate, shape (samples, 3), by machine code."""
    machine = compiled.law(law.update, Update)
    return run(law, q, dt, np.array, machine, **given)[:, :, 0]


def steps(law, q, dt=DT, **given):
    """After each sample of one coordinate but the first: constants, memory, and q, v, response."""
    constants = np.array(constants_of(law, 1, dt, **given))
    state = np.zeros(law.state_size(constants, 1))
    law.start(constants, state, q[:1], [math.nan])
    machine = compiled.law(law.update, Update)
    out = np.zeros((3, 1))
    for each in q[1:]:
        machine(constants, state, dt, np.array([each]), np.array([math.nan]), *out)
        yield constants, state, out[:, 0]


def ended(law, q, dt=DT):
    """Constants and memory after a record of one coordinate."""
    constants, state, _ = deque(steps(law, q, dt), maxlen=1).pop()
    return constants, state


def two_sines(samples, dt=DT):
    """Position, velocity and acceleration of sin 2t + 0.3 sin 7t."""
    t = np.arange(samples) * dt
    return (
        np.sin(2 * t) + 0.3 * np.sin(7 * t),
        2 * np.cos(2 * t) + 2.1 * np.cos(7 * t),
        -4 * np.sin(2 * t) - 14.7 * np.sin(7 * t),
    )


def bang_bang(samples, dt=DT, size=5.0, half_period=0.5):
    """Position, velocity and acceleration of an acceleration of ``size`` and changing sign."""
    tau = np.arange(samples) * dt
    period = np.floor(tau / half_period + 1e-9)
    tau -= period * half_period
    sign = np.where(period % 2, -1.0, 1.0)
    v = sign * size * (tau - half_period / 2)
    return sign * size * tau * (tau - half_period) / 2, v, sign * size


def noise(samples, seed=0, sigma=1e-3):
    return sigma * np.random.default_rng(seed).standard_normal(samples)


def rms(x):
    return float(np.sqrt(np.mean(np.square(x))))
