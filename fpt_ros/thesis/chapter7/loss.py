"""Chapters 1, 5.1.1 and 7: information that is missing, in the loop."""

from collections.abc import Mapping

import numpy as np

from fpt_ros.analysis import style
from fpt_ros.runs.run import Run
from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.chapter7.loops import COLUMNS, table_cells
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Drawn, Picture, Table, Verdict
from fpt_ros.thesis.measures import complete, settled_rms
from fpt_ros.thesis.setup import Runs, Setup

KINDS: Mapping[str, str] = {"predicted": "predict", "held": "hold"}
SHARES = (0.0, 0.1, 0.3, 0.5, 0.6, 0.7)
"""Probability that a sample of a coordinate is lost."""

LENGTHS = (0.003, 0.01, 0.03, 0.1)
"""Mean length of bursts without any sample, twice a second [s]."""

SENSORS = "plant_simulator.sensors"


def _lost(share: float, kind: str) -> Setup:
    own = f"{SENSORS}.lost.probability={share:g}", f"denoiser.healing.kind={kind}"
    return Setup("tora", settings=(f"{SENSORS}.kinds=[lost]", *own))


def _burst(length: float, kind: str) -> Setup:
    own = f"{SENSORS}.bursts.length={length:g}", f"denoiser.healing.kind={kind}"
    return Setup("tora", settings=(f"{SENSORS}.kinds=[bursts]", *own))


def _key(name: str, share: float) -> str:
    return f"{name}, {share:.0%} lost"


def _burst_key(name: str, length: float) -> str:
    return f"{name}, bursts of {1e3 * length:g} ms"


def _copes(runs: Runs) -> Verdict:
    whole = settled_rms(runs[_key("predicted", 0.0)], "q3")
    half = {name: settled_rms(runs[_key(name, 0.5)], "q3") / whole for name in KINDS}
    long = {name: settled_rms(runs[_burst_key(name, 0.1)], "q3") / whole for name in KINDS}
    rows = tuple((key, *table_cells(run)) for key, run in runs.items())
    lasting = all(complete(run) for key, run in runs.items() if key.startswith("predicted"))
    survived = max(share for share in SHARES if complete(runs[_key("predicted", share)]))
    short, good = half["predicted"] < 3.0, lasting and long["predicted"] < 3.0
    return Verdict(
        YES if short and good else ONLY_IF if short else NO,
        {
            **{f"q3, half of the samples lost / none, {name}": x for name, x in half.items()},
            **{f"q3, bursts of 100 ms / none, {name}": x for name, x in long.items()},
            "greatest share lost at random with which the run ends well, predicted": survived,
        },
        "Only if gaps are short beside the motion, r is held in them, and what is learnt behind "
        "one is the mean response in it: with half of all samples lost the error is "
        f"{half['predicted']:.3g} times that of the whole signal ({half['held']:.3g} where the "
        "last sample is held), with bursts of 100 ms twice a second "
        f"{long['predicted']:.3g} times.",
        Table(("loop", *COLUMNS), rows),
    )


def loss_figure(runs: Runs) -> Drawn:
    """Errors over the share that is lost."""
    curves: list[draw.Curve] = []
    for name, colour in zip(KINDS, style.COORDINATES, strict=False):
        found = np.array([settled_rms(runs[_key(name, share)], "q3") for share in SHARES])
        curves.append(
            (100.0 * np.array(SHARES), found, name, {**style.thin(colour), "marker": "o"})
        )
    return draw.charts(
        ("settled error of q3", "samples lost [%]", "q3, rms [m]", curves), height=3.8, log="y"
    )


CLAIMS: tuple[Claim[Run], ...] = (
    Claim(
        "7",
        "",
        "The methods cope with missing information.",
        {
            **{_key(n, share): _lost(share, kind) for n, kind in KINDS.items() for share in SHARES},
            **{
                _burst_key(n, length): _burst(length, kind)
                for n, kind in KINDS.items()
                for length in LENGTHS
            },
        },
        _copes,
        (Picture("", "Lost samples", loss_figure, "Each coordinate loses its samples by itself."),),
    ),
)
