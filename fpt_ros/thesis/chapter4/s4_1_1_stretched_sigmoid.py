"""Section 4.1.1: a sigmoid that is defined for every argument."""

from collections.abc import Callable

import numpy as np

from fpt_ros.analysis import style
from fpt_ros.analysis.sizes import finite
from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.claim import NO, YES, Claim, Drawn, Picture, Verdict
from fpt_ros.thesis.measures import complete, end, settled_rms
from fpt_ros.thesis.setup import Runs, Setup
from fpt_ros.thesis.words import because
from fpt_ros.transformations import atanh, sgfpt, sigmoid, stretched

STRETCHED = (
    "fpt_deformer.transformation=stretched",
    "fpt_deformer.B=2",
    "fpt_deformer.a=0.5",
    "fpt_deformer.b=1",
    "fpt_deformer.K=0",
)


def _defined_everywhere(runs: Runs) -> Verdict:
    shifted, wide = runs["shifted, no guard"], runs["stretched"]
    held = not complete(shifted) and complete(wide)
    return Verdict(
        YES if held else NO,
        {
            "shifted sigmoid without guard, A = -1: ends at [s]": end(shifted),
            "stretched sigmoid, A = -1: ends at [s]": end(wide),
        }
        | {
            f"{name}, rms error, {key}": finite(settled_rms(run, name))
            for name in ("q3", "q2")
            for key, run in runs.items()
        },
        because(
            held,
            "On TORA the first response error throws the argument of the shifted sigmoid out of "
            "the domain of atanh; the stretched one is defined for every argument.",
        ),
    )


def functions_figure(runs: Runs) -> Drawn:
    """The functions F of chapters 3 and 4."""
    x = np.linspace(-4.0, 4.0, 600)
    zeros = (0.0,) * sigmoid.FIRST
    shown: tuple[tuple[str, Callable[[float], float]], ...] = (
        ("shifted, (3.1)", lambda v: sgfpt.generator((*zeros, 0.5, 0.6), v)),
        ("stretched, (4.1)", lambda v: stretched.generator((*zeros, 2.0, 0.5, 1.0, 0.0), v)),
        ("atanh, (4.4), D = 0.3", lambda v: atanh.generator((*zeros, 0.3), v)),
    )
    curves = [(x, x, "", style.BAND)]
    for (label, F), colour in zip(shown, style.COORDINATES, strict=False):
        curves.append((x, np.array([F(v) for v in x]), label, style.thin(colour)))
    return draw.charts(("Generating functions, and the diagonal", "x", "F(x)", curves))


CLAIMS = (
    Claim(
        "4.1.1",
        "",
        "The stretched sigmoid overcomes the limitation that the shifted one is not defined for "
        "every starting point.",
        {
            "shifted, no guard": Setup(
                "tora", settings=("fpt_deformer.A=-1", "fpt_deformer.guard=false")
            ),
            "stretched": Setup("tora", settings=(*STRETCHED, "fpt_deformer.A=-1")),
        },
        _defined_everywhere,
        (Picture("", "The functions", functions_figure),),
    ),
)
