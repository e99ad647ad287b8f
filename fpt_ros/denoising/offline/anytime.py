"""Anytime auto-healing alone: missing samples are filled, those present are returned as they are.

See :mod:`healing`: ``rehearsal`` is the default, ``thesis`` fills by period or nearest neighbour.
"""

from collections.abc import Mapping

from fpt_ros.denoising.offline import Mask, Method, Signal
from fpt_ros.denoising.offline.healing import Filler, heal, linear, nearest, periodic
from fpt_ros.parameters import Parameter, Values, word

FILLERS: Mapping[str, Filler] = {
    "rehearsal": heal,
    "thesis": periodic,
    "nearest": nearest,
    "linear": linear,
}
PARAMETERS = (
    Parameter(
        "filler",
        "rehearsal: the one that errs least on known data; thesis: by period, else nearest",
        "rehearsal",
        choices=tuple(FILLERS),
    ),
)


def _estimate(y: Signal, present: Mask, values: Values) -> Signal:
    return FILLERS[word(values, "filler")](y, present)


ANYTIME = Method(PARAMETERS, _estimate, shortest=lambda _: 1)
