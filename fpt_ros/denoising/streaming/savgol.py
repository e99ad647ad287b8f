"""Savitzky-Golay filter at the newest sample: a polynomial fitted to the last ``window`` samples.

The weights are columns of G, (6.9), with x = 0 at the newest sample: evaluation at the centre, as
in chapter 6, would lag by half the window. The window has to grow with the degree: at 1 kHz 141
samples for degree 3, 251 for 4, 361 for 5.

Samples are ``dt`` of :func:`prepare` apart. Before the first one the motion is taken to be at rest.
A sample that is NaN is missing: what the last fit expects takes its place.
"""

from fpt_ros.denoising.offline.savgol import check, kernel
from fpt_ros.denoising.streaming import ORDER, Filter
from fpt_ros.denoising.streaming.three_states import response_of
from fpt_ros.errors import BadInput
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, integer, number

SECONDS = Parameter(
    "seconds",
    "length of the window in time, at any rate; 0: it has `window` samples",
    0.0,
    unit="s",
    minimum=0.0,
    live=False,
)

PARAMETERS = (
    Parameter("window", "samples of the window, odd", 141, minimum=3, maximum=10_001, live=False),
    Parameter("degree", "degree of the polynomial", 3, minimum=1, maximum=9),
    SECONDS,
)

LONGEST = 10_001
"""Samples of a window at most."""

_HEADER = 2


def odd_window(seconds: float, dt: float) -> int:
    """Samples of a window that lasts this long: odd, at least 3.

    Raises:
        BadInput: more than a filter of the loop can hold.
    """
    half = round(0.5 * (seconds / dt - 1.0))
    if 2 * half + 1 > LONGEST:
        raise BadInput(
            f"a window of {seconds:g} s has {2 * half + 1} samples at {1 / dt:g} Hz: at most "
            f"{LONGEST}"
        )
    return max(3, 2 * half + 1)


def end_kernels(window: int, degree: int, dt: float) -> list[float]:
    """Weights of value, first and second derivative at the newest sample, oldest sample first."""
    newest = float(window - 1)
    flat: list[float] = []
    for derivative in range(3):
        flat += kernel(window, degree, derivative, newest, dt).tolist()
    return flat


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Constants: window, order of the response, and the three kernels."""
    window, degree = integer(values, "window"), integer(values, "degree")
    if number(values, SECONDS.name) > 0.0:
        window = odd_window(number(values, SECONDS.name), dt)
    order = integer(values, ORDER.name)
    check(window, degree, least_degree=max(1, order))
    return (float(window), float(order), *end_kernels(window, degree, dt))


def state_size(constants: Vector, n: int) -> int:
    """Place of the oldest sample; per coordinate the expected next sample, and a ring."""
    return 1 + n * (1 + int(constants[0]))


def start(constants: Vector, state: MutableVector, q: Vector, v: Vector) -> None:
    """At rest where it is."""
    size = 1 + int(constants[0])
    state[0] = 0.0
    for c in range(len(q)):
        for i in range(size):
            state[1 + c * size + i] = q[c]


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
    """The newest sample takes the place of the oldest; three scalar products."""
    window = int(constants[0])
    order = constants[1]
    head = int(state[0])
    for c in range(len(q)):
        ring = 2 + c * (1 + window)
        newest = q[c]
        if newest != newest:
            newest = state[ring - 1]
        state[ring + head] = newest
        position = velocity = acceleration = 0.0
        k = _HEADER
        for i in range(ring + head + 1, ring + window):  # the oldest first
            x = state[i] - newest
            position += constants[k] * x
            velocity += constants[k + window] * x
            acceleration += constants[k + 2 * window] * x
            k += 1
        for i in range(ring, ring + head):
            x = state[i] - newest
            position += constants[k] * x
            velocity += constants[k + window] * x
            acceleration += constants[k + 2 * window] * x
            k += 1
        position += newest
        state[ring - 1] = position + dt * (velocity + 0.5 * dt * acceleration)
        out_q[c] = position
        out_v[c] = velocity
        out_response[c] = response_of(order, position, velocity, acceleration)
    state[0] = float(head + 1 if head + 1 < window else 0)


SAVGOL = Filter(prepare, state_size, start, update, PARAMETERS)
