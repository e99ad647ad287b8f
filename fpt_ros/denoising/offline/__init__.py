"""Denoising of a whole record, one method a file, all behind :func:`denoise`.

A method is a pure function on arrays. It is found by the name under which a package lists it in the
entry point group ``fpt_ros.denoisers``, as everything of the registry is.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fpt_ros import registry
from fpt_ros.errors import BadInput
from fpt_ros.parameters import Parameter, Value, Values, resolve

Signal = NDArray[np.float64]
Mask = NDArray[np.bool_]
Sigma = float | Signal
"""Standard deviation of the noise, of all samples or of each, shape (n,)."""
Info = Mapping[str, float | int | str]

DEFAULT = "auto"
LEAST = 4
"""Samples that any method needs."""


@dataclass(frozen=True)
class Method:
    """A denoiser of a whole record.

    Attributes:
        parameters: what can be set, with defaults and ranges.
        estimate: ``estimate(y, present, values)`` -> estimate of the clean signal. ``y``, shape
            (n,), has no missing samples: where ``present`` is False it holds what healing put.
        shortest: ``values`` -> how many present samples the method needs.
        detailed: as ``estimate``, but -> (estimate, what was chosen), for methods that choose.
    """

    parameters: tuple[Parameter, ...]
    estimate: Callable[[Signal, Mask, Values], Signal]
    shortest: Callable[[Values], int] = lambda _: LEAST
    detailed: Callable[[Signal, Mask, Values], tuple[Signal, Info]] | None = None


@dataclass(frozen=True)
class Result:
    """What :func:`denoise` found.

    Attributes:
        estimate: of the clean signal, shape (n,), in the unit of y.
        healed: True where the sample was missing, shape (n,).
        method: name of the method.
        sigma: robust estimate of the noise's standard deviation (impulses not counted), unit of y.
        info: parameters used, and what the method chose.
    """

    estimate: Signal
    healed: Mask
    method: str
    sigma: float
    info: Info = field(default_factory=dict)


def scale_and_weight(sigma: Sigma, n: int) -> tuple[float, Signal]:
    """A typical sigma, and the weight (typical / sigma)^2 of each sample, shape (n,)."""
    if np.ndim(sigma) == 0:
        return float(sigma), np.ones(n)
    typical = float(np.exp(np.mean(np.log(sigma))))
    return typical, (typical / np.asarray(sigma)) ** 2


def read(y: ArrayLike) -> Signal:
    """``y`` as a new array of floats of one dimension.

    Raises:
        BadInput: not numbers, not one-dimensional, empty, infinite values, or all missing.
    """
    try:
        raw = np.asarray(y)
        if raw.dtype.kind not in "fiubO":
            raise TypeError
        values = np.array(raw, dtype=np.float64)
    except (TypeError, ValueError):
        raise BadInput("the signal does not consist of real numbers") from None
    if values.ndim != 1:
        raise BadInput(f"the signal has to have one dimension, its shape is {values.shape}")
    if not len(values):
        raise BadInput("the signal is empty")
    infinite = np.flatnonzero(np.isinf(values))
    if len(infinite):
        raise BadInput(
            f"the signal is infinite at {len(infinite)} samples, first at index {infinite[0]}: "
            "mark missing samples by NaN"
        )
    if np.isnan(values).all():
        raise BadInput(f"all {len(values)} samples of the signal are missing")
    return values


def denoise(y: ArrayLike, method: str = DEFAULT, **options: Value) -> Result:
    """Estimate the clean signal under ``y``; missing samples (NaN) are healed.

    Args:
        y: equispaced samples, shape (n,), any unit.
        method: one of ``registry.names("denoisers")``.
        options: parameters of the method, by name.

    Raises:
        BadInput: a signal, a method or an option that cannot be used, in one line.
    """
    from fpt_ros.denoising.offline.healing import heal
    from fpt_ros.denoising.offline.noise import noise_sigma

    chosen = registry.denoiser(method)
    values = resolve(chosen.parameters, options, method)
    signal = read(y)
    present = ~np.isnan(signal)
    needed, have = chosen.shortest(values), int(present.sum())
    if have < needed:
        missing = len(signal) - have
        but = f" beside {missing} missing ones" if missing else ""
        raise BadInput(f"{method} needs at least {needed} samples, the signal has {have}{but}")
    info: dict[str, float | int | str] = {
        name: value for name, value in values.items() if isinstance(value, bool | int | float | str)
    }
    first = float(signal[present][0])
    if np.all(signal[present] == first):
        return Result(np.full(len(signal), first), ~present, method, 0.0, info)
    # A power of two is exact: nothing is rounded, and no square can overflow.
    scale = 2.0 ** math.frexp(float(np.max(np.abs(signal[present]))))[1]
    signal = signal / scale
    if not present.all():
        signal = heal(signal, present)
    if chosen.detailed is None:
        estimate = chosen.estimate(signal, present, values)
    else:
        estimate, choices = chosen.detailed(signal, present, values)
        info.update(choices)
    sigma = noise_sigma(signal, present)
    return Result(estimate * scale, ~present, method, sigma * scale, info)
