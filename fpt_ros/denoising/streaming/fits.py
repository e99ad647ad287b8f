"""Polynomials fitted to the newest samples of a ring: what filters of several windows share."""

from fpt_ros.denoising.offline.savgol import kernel
from fpt_ros.laws import Vector, helper


def kernels(window: int, degree: int, dt: float) -> list[float]:
    """Four times ``window`` weights, newest sample first.

    They give value, first and second derivative at the newest sample, and the value one sample
    later.
    """
    newest = float(window - 1)
    flat: list[float] = []
    for derivative in range(3):
        flat += kernel(window, degree, derivative, newest, dt)[::-1].tolist()
    flat += kernel(window, degree, 0, newest + 1.0)[::-1].tolist()
    return flat


@helper
def fit(
    constants: Vector, at: int, window: int, state: Vector, ring: int, longest: int, head: int
) -> tuple[float, float, float, float]:
    """What :func:`kernels` make of the newest samples, values less the newest one of them.

    Args:
        constants: hold the weights.
        at: place of the first one.
        window: samples.
        state: holds the ring.
        ring: place of its first sample.
        longest: samples that it holds.
        head: of the newest sample, in the ring.
    """
    newest = state[ring + head]
    value = rate = curvature = ahead = 0.0
    i = ring + head
    for k in range(at, at + window):
        x = state[i] - newest
        value += constants[k] * x
        rate += constants[k + window] * x
        curvature += constants[k + 2 * window] * x
        ahead += constants[k + 3 * window] * x
        i -= 1
        if i < ring:
            i += longest
    return value, rate, curvature, ahead
