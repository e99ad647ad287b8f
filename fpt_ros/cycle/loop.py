"""The control cycle as one function over arrays: what the in-process engine compiles.

The order of events of the design, section 3, on the same functions that the stages call one by one.
"""

import math
from collections.abc import Callable
from typing import Any

from fpt_ros.cycle.denoiser import synchronise
from fpt_ros.cycle.fpt_deformer import deform_response
from fpt_ros.cycle.parameter_tuner import remember, tune, watch
from fpt_ros.cycle.plant_simulator import GOOD, integrate, measure
from fpt_ros.cycle.trajectory_generator import prescribe, slot
from fpt_ros.cycle.tuned import apply_tuning
from fpt_ros.denoising import streaming
from fpt_ros.disturbances import FORCE
from fpt_ros.error_relaxation import RELAX
from fpt_ros.plants import EFFORT, REGRESSOR, RESPONSE
from fpt_ros.trajectories import NOMINAL
from fpt_ros.transformations import DEFORM
from fpt_ros.tuning import UPDATE

FUNCTIONS = (
    streaming.UPDATE,
    NOMINAL,
    RELAX,
    REGRESSOR,
    UPDATE,
    DEFORM,
    EFFORT,
    RESPONSE,
    FORCE,
)
"""Signatures of the laws that :func:`run` takes, in their order."""

ARGUMENTS = (
    "iii"  # first, last, cycle_time
    "iiiiiiiii"  # has_tuner, wants, reference, guards, kind, tuned, size, factor, adapts
    "iiiiiii"  # delay, hold, hit, order, substeps, all_measured, synchronised
    "fffffffff"  # dt, lam, tune_from, adaptive_from, gain, sigma_q, sigma_v, h, limit
    "ww"  # where, tuned_where
    + "v" * 12  # constants
    + "v" * 15  # states
    + "vvv"  # work space: Y, E, and 6 n + 4 c numbers
    + "m" * 14  # the messages' vectors, a row a cycle
    + "i"
)
"""Signature of the rest of its arguments, and of its result."""


def run(
    filter_update: Callable[..., None],
    nominal: Callable[..., None],
    relax: Callable[..., float],
    regressor: Callable[..., None],
    update: Callable[..., None],
    deform: Callable[..., None],
    effort_law: Callable[..., None],
    response_law: Callable[..., None],
    force: Callable[..., float],
    first: int,
    last_cycle: int,
    cycle_time: int,
    has_tuner: int,
    wants: int,
    reference: int,
    guards: int,
    kind: int,
    tuned: int,
    size: int,
    factor: int,
    adapts: int,
    delay: int,
    hold: int,
    hit: int,
    order: int,
    substeps: int,
    all_measured: int,
    synchronised: int,
    dt: float,
    lam: float,
    tune_from: float,
    adaptive_from: float,
    gain: float,
    sigma_q: float,
    sigma_v: float,
    h: float,
    limit: float,
    where: Any,
    tuned_where: Any,
    filter_constants: Any,
    trajectory: Any,
    slots: Any,
    tuner: Any,
    transformation: Any,
    weights: Any,
    initial: Any,
    coefficients: Any,
    exact: Any,
    disturbance: Any,
    position_limit: Any,
    noise: Any,
    filter_state: Any,
    second_state: Any,
    second_motion: Any,
    motion: Any,
    errors: Any,
    values: Any,
    memory: Any,
    last: Any,
    tracking: Any,
    observer: Any,
    deformer: Any,
    plant: Any,
    friction: Any,
    past: Any,
    command: Any,
    Y: Any,
    error: Any,
    work: Any,
    js_position: Any,
    js_velocity: Any,
    js_effort: Any,
    se_position: Any,
    se_velocity: Any,
    se_response: Any,
    se_deformed: Any,
    d_position: Any,
    d_velocity: Any,
    d_response: Any,
    d_error: Any,
    tuning: Any,
    c_response: Any,
    c_effort: Any,
) -> int:
    """Run the cycles from ``first`` up to ``last_cycle``, not included.

    Returns:
        ``last_cycle``, or the cycle in which something was not finite or beyond its limit; the
        states are then not those of its start.
    """
    n, c = js_position.shape[1], d_position.shape[1]
    w, a, q = work[:n], work[n : 2 * n], work[2 * n : 3 * n]
    v, acting, full = work[3 * n : 4 * n], work[4 * n : 5 * n], work[5 * n : 6 * n]
    at = 6 * n
    r_c, h_c, out_c = work[at : at + c], work[at + c : at + 2 * c], work[at + 2 * c : at + 3 * c]
    h_tuner = work[at + 3 * c : at + 3 * c + len(tuned_where)]
    none = work[:0]
    for k in range(first, last_cycle):
        t = k * cycle_time / 1000000000
        measure(
            plant, sigma_q, sigma_v, noise, k, all_measured, past, js_position[k], js_velocity[k]
        )
        for i in range(n):
            js_effort[k, i] = plant[2 * n + i]
        if k == 0:
            for i in range(n):
                se_position[k, i], se_velocity[k, i] = js_position[k, i], 0.0
                if not math.isnan(js_velocity[k, i]):
                    se_velocity[k, i] = js_velocity[k, i]
                se_response[k, i], se_deformed[k, i] = math.nan, math.nan
        else:
            filter_update(
                filter_constants,
                filter_state,
                dt,
                js_position[k],
                js_velocity[k],
                se_position[k],
                se_velocity[k],
                se_response[k],
            )
            for i in range(n):
                se_deformed[k, i] = math.nan
            if synchronised:
                synchronise(
                    filter_update,
                    filter_constants,
                    second_state,
                    second_motion,
                    dt,
                    command[:n],
                    w,
                    a,
                    se_deformed[k],
                )
        elapsed = dt if k > 0 else 0.0
        prescribe(
            nominal,
            relax,
            trajectory,
            lam,
            where,
            slot(slots, float(k * cycle_time)),
            motion,
            errors,
            t,
            elapsed,
            se_position[k],
            se_velocity[k],
            d_position[k],
            d_velocity[k],
            d_response[k],
            d_error[k],
        )
        if has_tuner:
            if k > 0:
                watch(observer, guards, command[:n])
                if (k - 1) * cycle_time / 1000000000 >= tune_from:
                    tune(
                        update,
                        regressor,
                        reference,
                        tuner,
                        tuned_where,
                        dt,
                        values,
                        memory,
                        last,
                        tracking,
                        se_response[k],
                        d_response[k] if wants else none,
                        command[n : 2 * n],
                        command[:n],
                        w,
                        a,
                        Y,
                        error,
                        h_tuner,
                    )
            if wants:
                remember(
                    tuned_where,
                    last,
                    tracking,
                    se_position[k],
                    se_velocity[k],
                    d_position[k],
                    d_velocity[k],
                    d_response[k],
                    d_error[k],
                )
            else:
                remember(
                    tuned_where,
                    last,
                    tracking,
                    se_position[k],
                    se_velocity[k],
                    none,
                    none,
                    none,
                    none,
                )
            m, tuned_size = tuning.shape[1], len(values)
            for i in range(m - 2):
                tuning[k, i] = values[i] if i < tuned_size else memory[i - tuned_size]
            tuning[k, m - 2], tuning[k, m - 1] = observer[1], observer[0]
            apply_tuning(
                kind,
                tuned,
                size,
                factor,
                tuning[k],
                gain,
                transformation,
                coefficients,
                weights,
            )
        deform_response(
            deform,
            effort_law,
            1 if adapts and t >= adaptive_from else 0,
            transformation,
            weights,
            initial,
            coefficients,
            where,
            delay,
            hold,
            deformer,
            se_position[k],
            se_velocity[k],
            se_response[k],
            se_deformed[k],
            d_response[k],
            d_error[k],
            r_c,
            h_c,
            out_c,
            full,
            c_response[k],
            c_effort[k],
        )
        for i in range(c):
            if not math.isnan(d_response[k, i]) and not math.isfinite(c_response[k, where[i]]):
                return k
        status = integrate(
            response_law,
            force,
            exact,
            disturbance,
            friction,
            hit,
            order,
            substeps,
            h,
            t,
            limit,
            position_limit,
            c_effort[k],
            plant,
            acting,
            q,
            v,
            a,
        )
        if status != GOOD:
            return k
        for i in range(n):
            command[i], command[n + i] = c_response[k, i], c_effort[k, i]
    return last_cycle
