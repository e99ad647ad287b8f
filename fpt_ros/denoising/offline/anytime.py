"""Anytime auto-healing alone: missing samples are filled, those present are returned as they are.

See :mod:`healing`: ``rehearsal`` is the default, ``thesis`` fills by period or nearest neighbour.
"""

from fpt_ros.denoising.offline import Mask, Method, Signal
from fpt_ros.denoising.offline.healing import heal, periodic
from fpt_ros.parameters import Parameter, Values, word

PARAMETERS = (
    Parameter(
        "filler",
        "rehearsal: the one that errs least on known data; thesis: by period, else nearest",
        "rehearsal",
        choices=("rehearsal", "thesis"),
    ),
)


def _estimate(y: Signal, present: Mask, values: Values) -> Signal:
    return heal(y, present) if word(values, "filler") == "rehearsal" else periodic(y, present)


ANYTIME = Method(PARAMETERS, _estimate, shortest=lambda _: 1)
