"""What is to be said of the gain of an experiment before it runs."""

import shlex
from typing import TYPE_CHECKING

from fpt_ros.cycle.deformer_parameters import GAIN_SCALE
from fpt_ros.cycle.fpt_deformer import FptDeformer
from fpt_ros.errors import BadInput
from fpt_ros.gain.bands import verb
from fpt_ros.gain.contraction import bounds
from fpt_ros.gain.limits import Gain
from fpt_ros.parameters import flag
from fpt_ros.tuning import GAIN

if TYPE_CHECKING:
    from fpt_ros.experiments.experiment import Experiment


def known(experiment: "Experiment") -> Gain | None:
    """What is known of the range of an experiment's A; ``None``: nothing, or a law gives A."""
    loop = experiment.loop()
    if not loop.deformer.transformation.adapts or loop.tuner.law.tunes == GAIN:
        return None
    try:
        return bounds(experiment)
    except BadInput:
        return None


def told(experiment: "Experiment", gain: Gain | None) -> "Experiment":
    """The same experiment, its deformer told what it has to know to judge an A in flight."""
    values = experiment.nodes[FptDeformer.name]
    guarded = flag(experiment.loop().tuner.values, "precursor_guard")  # it lowers |A| by itself
    if gain is None or guarded or values[GAIN_SCALE.name]:
        return experiment
    return experiment.with_values(FptDeformer.name, **{GAIN_SCALE.name: gain.signed_scale})


def warning(experiment: "Experiment", gain: Gain | None) -> str:
    """What is to be said, in one line, of an experiment's A before a run; empty: nothing.

    ``gain``: what is :func:`known` of it.
    """
    if gain is None:
        return ""
    loop = experiment.loop()
    A, sign = gain.given, gain.sign
    more = shlex.join(["fpt", "gain", *(experiment.source or (experiment.name,))])
    low, high = gain.range
    interval = f"({low:.4g}, {high:.4g})"
    hard = gain.hard_onset
    onset = f"hard onset of chattering at {sign * hard:.4g}" if hard is not None else ""
    if sign == 0:
        least, greatest = gain.eigenvalues
        return (
            "no fpt_deformer.A contracts along the nominal motion, where the response's "
            f"eigenvalues are between {least:.4g} and {greatest:.4g} ({more})"
        )
    if flag(loop.tuner.values, "precursor_guard") and A * sign > 0.0:
        return ""  # the precursor guard lowers |A| by itself
    if not gain.contracts(A):
        part = (
            "in a part of the nominal motion "
            if abs(A) < gain.loosest_limit and A * sign > 0.0
            else ""
        )
        what = f"{part}it {verb(gain.behaviour(A))}"
        if onset and A * sign > 0.0:
            more = f"a {onset}; {more}"
        return (
            f"fpt_deformer.A = {A:g} is outside the range {interval} in which the iteration "
            f"contracts: {what} ({more})"
        )
    if hard is not None and abs(A) >= hard:
        return (
            f"fpt_deformer.A = {A:g} may chatter: beyond the {onset} a large response error ends "
            f"in a two-cycle, while small ones decay in {interval} ({more})"
        )
    return ""
