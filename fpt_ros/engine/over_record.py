"""A filter of the loop over a whole record, sample by sample: what it would have said in flight."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fpt_ros.denoising.streaming import FILTERS, ORDER, Update
from fpt_ros.engine import compiled
from fpt_ros.errors import BadInput
from fpt_ros.parameters import Value, resolve

Signal = NDArray[np.float64]


@dataclass(frozen=True)
class Filtered:
    """What a causal filter makes of a record.

    Attributes:
        value, velocity, acceleration: estimates, shape (n,); NaN for the first sample.
        delay: samples that the value is behind the record, times dt [s]: where the squared
            difference between estimate and record shifted is least; 0 if the filter does not lag.
    """

    value: Signal
    velocity: Signal
    acceleration: Signal
    delay: float


def over_record(name: str, y: Signal, dt: float, **settings: Value) -> Filtered:
    """Run the registered filter ``name`` over ``y``, samples ``dt`` [s] apart.

    A sample that is NaN is missing. For example, how late a smooth motion comes out::

        >>> y = np.sin(np.arange(2000) * 0.005)
        >>> over_record("butterworth", y, 0.001, cutoff=20.0).delay
        0.011

    Raises:
        BadInput: no such filter, a setting that is not valid, dt <= 0, or no finite first sample.
    """
    record = np.ascontiguousarray(y, dtype=float)
    if record.ndim != 1 or len(record) < 2 or not np.isfinite(record[0]):
        raise BadInput("a record has at least two samples, and its first one is a number")
    if not (np.isfinite(dt) and dt > 0.0):
        raise BadInput(f"dt = {dt:g} s is not valid: it takes a number > 0")
    law = FILTERS[name]
    values = resolve((ORDER, *law.parameters), settings, name)
    constants = np.array(law.prepare(values, 1, dt), dtype=float)
    size: Any = law.state_size
    state = np.zeros(size(constants, 1))
    unknown = np.full(1, np.nan)
    start: Any = law.start
    start(constants, state, record[:1], unknown)
    update: Any = compiled.law(law.update, Update)
    out = np.full((len(record), 3, 1), np.nan)
    for k in range(1, len(record)):
        update(constants, state, dt, record[k : k + 1], unknown, *out[k])
    value, velocity, acceleration = (np.ascontiguousarray(out[:, i, 0]) for i in range(3))
    return Filtered(value, velocity, acceleration, _delay(record, value) * dt)


def _delay(record: Signal, value: Signal) -> int:
    """Shift [samples] that brings the estimate nearest to the record."""
    most = min(len(record) // 4, 500)

    def apart(shift: int) -> float:
        pairs = value[1 + shift :] - record[1 : len(record) - shift]
        return float(np.nanmean(pairs * pairs))

    return min(range(most + 1), key=apart)
