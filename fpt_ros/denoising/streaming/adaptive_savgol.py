"""A bank of Savitzky-Golay filters at the newest sample, mixed by how well each predicts.

Each member is a polynomial of its degree fitted to its window. With p its weights for one sample
ahead, its innovation y - p.y has the variance S = sigma^2 (1 + |p|^2) while the polynomial holds;
where the motion changes faster than the window allows, it is greater. The weights are the softmax
of the log-likelihoods of the innovations, of which the past is forgotten by a factor a sample. This
is chapter 6's choice of window and degree by the local scale of the signal, made causal.

Samples are ``dt`` of :func:`prepare` apart. Before the first one the motion is taken to be at rest.
A sample that is NaN is missing: the mixture's prediction takes its place.
"""

import math

from fpt_ros.denoising.offline.savgol import check, kernel
from fpt_ros.denoising.streaming import ORDER, Filter
from fpt_ros.denoising.streaming.fits import fit, kernels
from fpt_ros.denoising.streaming.savgol import odd_window
from fpt_ros.denoising.streaming.three_states import response_of
from fpt_ros.errors import BadInput
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, integer, number, numbers

PARAMETERS = (
    Parameter("sigma", "standard deviation of the position noise", 1e-3, above=0.0),
    Parameter(
        "windows",
        "samples of each member's window, odd",
        [51.0, 101.0, 141.0, 251.0, 361.0],
        minimum=3.0,
        maximum=10_001.0,
        live=False,
    ),
    Parameter(
        "seconds",
        "length of each member's window in time, at any rate; empty: they have `windows` samples",
        [],
        kind="floats",
        unit="s",
        above=0.0,
        live=False,
    ),
    Parameter(
        "degrees",
        "degree of each member's polynomial",
        [2.0, 3.0, 3.0, 4.0, 5.0],
        minimum=1.0,
        maximum=9.0,
    ),
    Parameter(
        "forgetting", "what the log-likelihood keeps a sample", 0.98, minimum=0.0, maximum=1.0
    ),
)

CAP = 16.0
"""Greatest innovation^2 / S that counts: an impulse must not decide."""

_HEADER = 4
_MEMBER = 3


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Constants: what all members share, then (window, 1/S, log S, kernels) of each.

    Shared: members, longest window, order of the response, forgetting. Kernels, newest sample
    first: value, first and second derivative at the newest sample, value one sample later.
    """
    sigma = number(values, "sigma")
    windows, degrees = numbers(values, "windows"), numbers(values, "degrees")
    if numbers(values, "seconds"):
        windows = [float(odd_window(length, dt)) for length in numbers(values, "seconds")]
    order = integer(values, ORDER.name)
    if not windows or len(windows) != len(degrees):
        raise BadInput(
            f"windows has {len(windows)} entries and degrees {len(degrees)}: each member of the "
            "bank takes one of both"
        )
    constants = [float(len(windows)), max(windows), float(order), number(values, "forgetting")]
    for size, power in zip(windows, degrees, strict=True):
        window, degree = int(size), int(power)
        if window != size or degree != power:
            raise BadInput(f"windows and degrees are whole numbers, not {size:g} and {power:g}")
        check(window, degree, least_degree=max(1, order))
        ahead = kernel(window, degree, 0, float(window))
        variance = sigma * sigma * (1.0 + float(ahead @ ahead))
        constants += [size, 1.0 / variance, math.log(variance)]
        constants += kernels(window, degree, dt)
    return tuple(constants)


def state_size(constants: Vector, n: int) -> int:
    """Place of the newest sample; per coordinate a ring, and (cost, prediction) a member."""
    return 1 + n * (int(constants[1]) + 2 * int(constants[0]))


def start(constants: Vector, state: MutableVector, q: Vector, v: Vector) -> None:
    """At rest where it is."""
    members, longest = int(constants[0]), int(constants[1])
    state[0] = 0.0
    at = 1
    for c in range(len(q)):
        for i in range(longest):
            state[at + i] = q[c]
        at += longest
        for _ in range(members):
            state[at], state[at + 1] = 0.0, q[c]
            at += 2


def update(
    constants: Vector,
    state: MutableVector,
    dt: float,
    q: Vector,
    v: Vector,
    out_q: MutableVector,
    out_v: MutableVector,
    out_response: MutableVector,
) -> None:
    """Weigh the members' predictions of this sample, then fit them all and mix."""
    members, longest = int(constants[0]), int(constants[1])
    order, forgetting = constants[2], constants[3]
    head = int(state[0]) + 1
    if head == longest:
        head = 0
    state[0] = float(head)
    ring = 1
    for c in range(len(q)):
        first = ring + longest
        newest = q[c]
        present = newest == newest
        best = math.inf
        at = _HEADER
        for m in range(members):
            member = first + 2 * m
            if present:
                innovation = newest - state[member + 1]
                distance = innovation * innovation * constants[at + 1]
                state[member] = forgetting * state[member] + constants[at + 2]
                state[member] += distance if distance < CAP else CAP
            if state[member] < best:
                best = state[member]
            at += _MEMBER + 4 * int(constants[at])
        total = expected = 0.0
        for m in range(members):
            member = first + 2 * m
            weight = math.exp(0.5 * (best - state[member]))
            total += weight
            expected += weight * state[member + 1]
        if not present:
            newest = expected / total
        state[ring + head] = newest
        position = velocity = acceleration = 0.0
        at = _HEADER
        for m in range(members):
            member = first + 2 * m
            window = int(constants[at])
            value, rate, curvature, ahead = fit(
                constants, at + _MEMBER, window, state, ring, longest, head
            )
            weight = math.exp(0.5 * (best - state[member]))
            position += weight * value
            velocity += weight * rate
            acceleration += weight * curvature
            state[member + 1] = newest + ahead
            at += _MEMBER + 4 * window
        out_q[c] = newest + position / total
        out_v[c] = velocity / total
        out_response[c] = response_of(order, out_q[c], out_v[c], acceleration / total)
        ring = first + 2 * members


ADAPTIVE_SAVGOL = Filter(prepare, state_size, start, update, PARAMETERS)
