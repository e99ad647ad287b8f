"""Denoising of a whole record, one method a file, all behind :func:`denoise`.

A method is a pure function on arrays. It is found by the name under which a package lists it in the
entry point group ``fpt_ros.denoisers``, as everything of the registry is.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fpt_ros.errors import BadInput
from fpt_ros.parameters import Parameter, Value, Values, resolve
from fpt_ros.registry import Kind

Signal = NDArray[np.float64]
Mask = NDArray[np.bool_]
Sigma = float | Signal
"""Standard deviation of the noise, of all samples or of each, shape (n,)."""
Info = Mapping[str, float | int | str]

DEFAULT = "auto"
LEAST = 4
"""Samples that any method needs."""


@dataclass(frozen=True)
class Noise:
    """What the noise of a record was found to be.

    Attributes:
        sigma: its typical standard deviation, impulses not counted, unit of y.
        least, most: the same where it is the least and the most; equal where it does not vary.
        step: of rounding (LSB of a converter, last digit of a table), unit of y; 0: none.
        impulses: share of the samples.
        colour: AR(1) coefficient; 0: white.
    """

    sigma: float
    least: float
    most: float
    step: float
    impulses: float
    colour: float


@dataclass(frozen=True)
class Record:
    """What a method may know of a record.

    Attributes:
        y: samples, shape (n,); where ``present`` is False what healing put.
        present: False where a sample was missing.
        dt: steps of time before each sample [mean step], shape (n,): ones if they are equal.
        report: called with the samples done and all of them.
    """

    y: Signal
    present: Mask
    dt: Signal
    report: Callable[[int, int], None] = lambda done, total: None

    @property
    def even(self) -> bool:
        """Whether the steps of time are equal."""
        return bool(np.all(self.dt == 1.0))


@dataclass(frozen=True)
class Found:
    """What a method that looks at a whole :class:`Record` found.

    Attributes:
        estimate: shape (n,).
        info: what was chosen, in short.
        weights: of the smoothers that were averaged, by name.
        noise: what the noise is; None: the method does not ask.
    """

    estimate: Signal
    info: Info = field(default_factory=dict)
    weights: Mapping[str, float] = field(default_factory=dict)
    noise: Noise | None = None


@dataclass(frozen=True)
class Method:
    """A denoiser of a whole record.

    Attributes:
        parameters: what can be set, with defaults and ranges.
        estimate: ``estimate(y, present, values)`` -> estimate of the clean signal. ``y``, shape
            (n,), has no missing samples: where ``present`` is False it holds what healing put.
        shortest: ``values`` -> how many present samples the method needs.
        detailed: as ``estimate``, but -> (estimate, what was chosen), for methods that choose.
        whole: ``whole(record, values)``, for methods that say what the noise is, take unequal
            steps of time, or report how far they are.
    """

    parameters: tuple[Parameter, ...]
    estimate: Callable[[Signal, Mask, Values], Signal]
    shortest: Callable[[Values], int] = lambda _: LEAST
    detailed: Callable[[Signal, Mask, Values], tuple[Signal, Info]] | None = None
    whole: Callable[[Record, Values], Found] | None = None


@dataclass(frozen=True)
class Result:
    """What :func:`denoise` found.

    Attributes:
        estimate: of the clean signal, shape (n,), in the unit of y.
        healed: True where the sample was missing, shape (n,).
        method: name of the method.
        sigma: robust estimate of the noise's standard deviation (impulses not counted), unit of y.
        info: parameters used, and what the method chose.
        weights: of the smoothers that were averaged, by name; empty: the method has but one.
        noise: what the noise is; None: the method does not ask.
        derivative: of the estimate, shape (n,), unit of y per unit of time^k; None: not asked for.
    """

    estimate: Signal
    healed: Mask
    method: str
    sigma: float
    info: Info = field(default_factory=dict)
    weights: Mapping[str, float] = field(default_factory=dict)
    noise: Noise | None = None
    derivative: Signal | None = None


def scale_and_weight(sigma: Sigma, n: int) -> tuple[float, Signal]:
    """A typical sigma, and the weight (typical / sigma)^2 of each sample, shape (n,)."""
    if np.ndim(sigma) == 0:
        return float(sigma), np.ones(n)
    typical = float(np.exp(np.mean(np.log(sigma))))
    return typical, (typical / np.asarray(sigma)) ** 2


DENOISERS: Kind[Method] = Kind(Method, "denoisers")


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


def denoise(
    y: ArrayLike,
    method: str = DEFAULT,
    *,
    t: ArrayLike | None = None,
    dt: float = 1.0,
    derivative: int = 0,
    report: Callable[[int, int], None] | None = None,
    **options: Value,
) -> Result:
    """Estimate the clean signal under ``y``; missing samples (NaN) are healed.

    Args:
        y: samples, shape (n,), any unit.
        method: one of ``DENOISERS.names()``.
        t: time of each sample, ascending, shape (n,); default: equal steps of ``dt``. Steps that
            differ are taken by ``auto`` alone.
        dt: step of time, where ``t`` is not given.
        derivative: 1 or 2: the derivative of the estimate by time is found too
            (:mod:`fpt_ros.denoising.offline.derivative`).
        report: called with the samples done and all of them, on long records.
        options: parameters of the method, by name.

    Raises:
        BadInput: a signal, a method or an option that cannot be used, in one line.

    Example:
        >>> y = np.sin(np.arange(200) / 20) + 0.1 * np.random.default_rng(1).normal(size=200)
        >>> found = denoise(y, dt=0.01, derivative=1)
        >>> found.estimate.shape, found.derivative.shape
        ((200,), (200,))
    """
    from fpt_ros.denoising.offline.healing import heal
    from fpt_ros.denoising.offline.noise import noise_sigma
    from fpt_ros.denoising.offline.time_steps import steps_of

    chosen = DENOISERS[method]
    values = resolve(chosen.parameters, options, method)
    signal = read(y)
    steps, mean_step = steps_of(t, dt, len(signal))
    if derivative not in (0, 1, 2):
        raise BadInput(f"derivative = {derivative} is not valid: it takes 0, 1 or 2")
    if chosen.whole is None and np.any(steps != 1.0):
        raise BadInput(
            f"{method} needs equal steps of time, which differ here: take auto, or resample"
        )
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
        slope = np.zeros(len(signal)) if derivative else None
        constant = np.full(len(signal), first)
        return Result(constant, ~present, method, 0.0, info, derivative=slope)
    # A power of two is exact: nothing is rounded, and no square can overflow.
    scale = 2.0 ** math.frexp(float(np.max(np.abs(signal[present]))))[1]
    signal = signal / scale
    if not present.all():
        signal = heal(signal, present)
    record = Record(signal, present, steps, report or (lambda done, total: None))
    found = _run(chosen, record, values)
    info.update(found.info)
    slope = None
    if derivative:
        from fpt_ros.denoising.offline.derivative import differentiate

        slope = differentiate(record, found.estimate, derivative) * (scale / mean_step**derivative)
    noise = found.noise
    if noise is None:
        sigma = noise_sigma(signal, present) * scale
    else:
        noise = replace(
            noise, sigma=noise.sigma * scale, least=noise.least * scale,
            most=noise.most * scale, step=noise.step * scale,
        )  # fmt: skip
        sigma = noise.sigma
    return Result(
        found.estimate * scale, ~present, method, sigma, info, found.weights, noise, slope
    )


def _run(chosen: Method, record: Record, values: Values) -> Found:
    if chosen.whole is not None:
        return chosen.whole(record, values)
    if chosen.detailed is not None:
        estimate, info = chosen.detailed(record.y, record.present, values)
        return Found(estimate, info)
    return Found(chosen.estimate(record.y, record.present, values))
