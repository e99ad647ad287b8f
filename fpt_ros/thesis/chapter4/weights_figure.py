"""The picture of tuned weights with the forgetting buffer that tuned them."""

from collections.abc import Callable

import numpy as np

from fpt_ros.analysis import response_figures, signals
from fpt_ros.runs.run import Run
from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.claim import Drawn
from fpt_ros.thesis.setup import Runs


def buffered(run: Run) -> Run:
    """The run with the content of the forgetting buffer, calculated from the deformed response."""
    from scipy.signal import lfilter

    delay = int(signals.parameter_number(run, "parameter_tuner", "delay") or 1)
    beta = signals.parameter_number(run, "parameter_tuner", "beta") or 0.99
    more = {}
    names = [name for name in run.topics["tuning"].names if name.startswith("weight.")]
    for name in names:
        r = run.topics["command"].column("accelerations", name.removeprefix("weight."))
        step = r[delay:] - r[:-delay]
        x = step[delay:] * step[:-delay]
        b = lfilter([1.0 - beta], [1.0, -beta], x / (np.abs(x) + 1e-12))
        more[name.replace("weight", "buffer")] = np.concatenate([np.zeros(len(r) - len(b)), b])
    return draw.with_tuning(run, names, more)


def weights_figure(*keys: str) -> Callable[[Runs], Drawn | None]:
    """Weights and buffers of these runs."""
    return draw.panels(response_figures.parameters, *keys, prepare=buffered)
