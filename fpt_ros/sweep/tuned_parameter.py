"""A parameter that is tuned, and the range in which it is searched."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

from fpt_ros.errors import BadInput
from fpt_ros.experiments.experiment import Experiment
from fpt_ros.parameters import Parameter, Value
from fpt_ros.sweep.definition import parameter_of
from fpt_ros.sweep.grid import Target, parse, target

if TYPE_CHECKING:
    from optuna import Trial

WIDTH = 10.0
"""A range that is not given goes from the present value over it to the present value times it."""

OVER_FORM = "--over takes NODE.PARAM or NODE.PARAM=LOW:HIGH each, as in fpt_deformer.A=-4:-0.05"


@dataclass(frozen=True)
class TunedParameter:
    """A parameter that is tuned, within [low, high]."""

    target: Target
    low: float
    high: float
    present: float
    whole: bool

    @property
    def log(self) -> bool:
        """Whether it is searched in equal ratios: ends of one sign that are far apart."""
        low, high = sorted((abs(self.low), abs(self.high)))
        return self.low * self.high > 0.0 and high >= 5.0 * low and not self.whole

    def suggest(self, trial: "Trial") -> Value:
        """A value for a trial."""
        name = str(self.target)
        if self.whole:
            return trial.suggest_int(name, int(self.low), int(self.high))
        if self.log:
            low, high = sorted((abs(self.low), abs(self.high)))
            size = trial.suggest_float(name, low, high, log=True)
            return math.copysign(size, self.low)
        return trial.suggest_float(name, self.low, self.high)

    def inner(self, value: float) -> float:
        """What :meth:`suggest` draws for a value."""
        return abs(value) if self.log else int(value) if self.whole else value


def read_tuned_parameter(text: str, experiment: Experiment) -> TunedParameter:
    """Read one part of ``--over``.

    Raises:
        BadInput: an unknown parameter, or a range that is none.
    """
    _, equals, _ = text.partition("=")
    where = target(text.partition("=")[0], f"--over {text}: {OVER_FORM}")
    if where.index is not None:
        raise BadInput(f"--over {text}: elements of lists cannot be tuned, only numbers")
    parameter = parameter_of(experiment, where.node, where.name)
    value = experiment.nodes[where.node][where.name]
    if parameter.kind not in ("float", "int"):
        raise BadInput(f"--over {text}: {where} is no number")
    present = float(cast("float", value))
    if equals:
        axis = parse(text, random=True)
        if axis.choices or axis.log or axis.count:
            raise BadInput(f"--over {text}: {OVER_FORM}")
        low, high = sorted((axis.start, axis.stop))
        whole = parameter.kind == "int"
        for end in (low, high):
            parameter.check(int(end) if whole and end == int(end) else end, where.node)
    elif present == 0.0:
        raise BadInput(f"--over {text}: {where} is 0, so a range has to be given; {OVER_FORM}")
    else:
        low, high = sorted((present / WIDTH, present * WIDTH))
        low, high = _within(parameter, low, high)
    if not low < high:
        raise BadInput(f"--over {text}: the range is empty; {OVER_FORM}")
    return TunedParameter(where, low, high, present, parameter.kind == "int")


def _within(parameter: Parameter, low: float, high: float) -> tuple[float, float]:
    low = max(low, parameter.minimum)
    if low <= parameter.above:
        low = math.nextafter(parameter.above, math.inf)
    high = min(high, parameter.maximum)
    if parameter.kind == "int":
        return float(math.ceil(low)), float(math.floor(high))
    return low, high
