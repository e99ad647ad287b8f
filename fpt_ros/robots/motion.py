"""A nominal motion that an arm can follow, and a payload that it can carry along it."""

import math
from dataclasses import dataclass

import numpy as np

from fpt_ros.plants.mujoco.library import bindings
from fpt_ros.robots.survey import REACH, Survey, loaded, mean_inertia
from fpt_ros.runs.run import Array
from fpt_ros.trajectories.blended_sines import nominal

LOW, HIGH = 0.3, 0.5
"""Frequencies of the first and the last joint [Hz]."""

OTHER = 0.77
"""The second tone's frequency over that of the joint at the other end of the arm."""

SHARE, OTHER_SHARE = 0.6, 0.4
"""Of the reach, the two tones' amplitudes."""

RISE, DURATION = 2.0, 6.5
"""Of the motion [s]."""

PAYLOAD = 0.1
"""Part of the moving mass that is taken up at the flange, where nothing else is asked for."""

LESS = (1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001)
"""Parts of it that are tried, until joints and limits of effort bear it."""

HEAVIER = 5.0
"""Factor by which the payload may raise a joint's mean inertia."""

SPARE = 0.7
"""Part of the limits of effort that the motion may need."""

FEW = 3
"""Payloads that are tried with slower motions."""

SPEEDS = (1.0, 0.7, 0.5, 0.35, 0.25)
"""Factors of the frequencies that are tried, until the effort is within the limits."""

NO_LIMIT = 1e6
"""Stands for a limit of effort that is not there [N m, N]."""

SATURATED = 0.7
"""Of the largest effort, the limit of the variant ``saturated``."""


@dataclass(frozen=True)
class Motion:
    """What an arm of n joints is asked for.

    Attributes:
        fit: n, reach over :data:`~fpt_ros.robots.survey.REACH`.
        speed: factor of all frequencies.
        payload: at the flange [kg].
        effort: n, largest along the nominal motion, with friction and payload.
        distance: largest one between the nominal response and that which the model has to be asked
            for, over all joints [rad/s^2, m/s^2].
        limits: limits of effort that replace the file's; empty: none.
        notes: what had to be changed, and why.
    """

    fit: tuple[float, ...]
    speed: float
    payload: float
    effort: tuple[float, ...]
    distance: float
    limits: tuple[float, ...]
    notes: tuple[str, ...]


def motion(about: Survey, payload: float | None = None) -> Motion:
    """The fastest of a few motions, and the payload, that the arm's limits of effort allow.

    Args:
        about: the arm.
        payload: that it has to carry [kg]; ``None``: a tenth of what moves, or less.
    """
    limits, notes = np.array(about.arm.limits), list[str]()
    loads = [payload] if payload is not None else _bearable(about)
    for load in loads:
        for speed in SPEEDS:
            effort, distance = _effort(about, load, speed)
            if bool((effort <= SPARE * limits).all()):
                if speed < 1.0:
                    notes.append(f"slowed down to {speed:g} of the usual, for the limits of effort")
                return Motion(_fit(about), speed, load, tuple(effort), distance, (), tuple(notes))
    load, speed = loads[0], 1.0
    effort, distance = _effort(about, load, speed)
    short = effort > SPARE * limits
    for name, limit, needed in zip(about.arm.names, limits, effort, strict=True):
        if needed > SPARE * limit:
            notes.append(
                f"the file's limit of effort of {name} ({limit:g}) is left out: the arm itself "
                f"needs {needed:.3g}"
            )
    whole = np.minimum(np.where(short, NO_LIMIT, limits), NO_LIMIT)
    return Motion(
        _fit(about), speed, load, tuple(effort), distance, tuple(whole.tolist()), tuple(notes)
    )


def _bearable(about: Survey) -> list[float]:
    """Payloads, the largest first, that no joint feels as many times its own inertia."""
    found = []
    for part in LESS:
        load = float(f"{part * PAYLOAD * about.mass:.2g}")
        inertia = mean_inertia(about.file, about.arm.names, about.home, load)
        if bool((inertia <= HEAVIER * np.array(about.inertia)).all()):
            found.append(load)
            if len(found) == FEW:
                break
    return found or [0.0]


def _fit(about: Survey) -> tuple[float, ...]:
    return tuple(round(reach / REACH, 4) for reach in about.reach)


def constants(about: Survey, speed: float) -> list[float]:
    """Those of :mod:`fpt_ros.trajectories.blended_sines`."""
    n = len(about.home)
    w = 2.0 * math.pi * speed * np.linspace(LOW, HIGH, n)
    i = np.arange(n)
    reach = np.array(about.reach)
    groups = (
        SHARE * reach,
        w,
        np.array(about.home),
        0.9 * i,
        OTHER_SHARE * reach,
        OTHER * w[::-1],
        1.7 * i + 0.5,
    )
    return [*(float(x) for group in groups for x in group), RISE]


def _effort(about: Survey, payload: float, speed: float) -> tuple[Array, float]:
    """Along the nominal motion: n largest efforts (mj_inverse: friction and springs count), and how
    far the response that the model has to be asked for is from the nominal one.
    """
    mujoco, arm = bindings(), loaded(about.file, about.arm.names, payload)
    exact, model, path = arm.loaded, arm.bare, constants(about, speed)
    n, data, known = model.nv, mujoco.MjData(exact), mujoco.MjData(model)
    q, v, a = ([0.0] * n for _ in range(3))
    largest, asked, farthest = np.zeros(n), np.zeros((1, n)), 0.0
    for t in np.arange(0.0, DURATION, 0.02):
        nominal(path, [], float(t), 0.0, q, v, a)
        data.qpos[:], data.qvel[:], data.qacc[:] = q, v, a
        mujoco.mj_inverse(exact, data)
        effort = np.abs(data.qfrc_inverse)
        largest = np.maximum(largest, effort)
        known.qpos[:], known.qvel[:] = q, v
        mujoco.mj_forward(model, known)
        # half of all inertias: M r / 2 + h / 2 = effort
        mujoco.mj_solveM(model, known, asked, (2.0 * data.qfrc_inverse - known.qfrc_bias)[None])
        farthest = max(farthest, float(np.linalg.norm(asked[0] - a)))
    return largest, farthest
