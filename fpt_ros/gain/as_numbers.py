"""The analysis of a gain as plain numbers: ``fpt gain --json`` and ``gain.json``."""

import math
from typing import Any

from fpt_ros.experiments.experiment import Experiment
from fpt_ros.gain.limits import Gain


def as_numbers(experiment: Experiment, found: Gain, tried: dict[str, Any]) -> dict[str, Any]:
    """The analysis as plain numbers; limits are magnitudes of A, everything else has its sign."""
    sign = found.sign or 1
    rows = [
        {
            "from": sign * band.start + 0.0,
            "to": sign * band.end if math.isfinite(band.end) else None,
            "behaviour": band.name,
        }
        for band in found.bands
    ]
    if found.sign:
        rows.insert(0, {"from": None, "to": 0.0, "behaviour": found.behaviour(-float(sign))})
    return {
        "experiment": experiment.name,
        "variant": experiment.variant,
        "A": found.given,
        "calculated": found.calculated,
        "behaviour": found.behaviour(found.given),
        "contracts": found.contracts(found.given),
        "range": list(found.range),
        "sign": found.sign,
        "monotone_limit": found.monotone,
        "linear_limit": found.linear_limit,
        "linear_limit_without_feedback": found.bare_limit,
        "hard_onset": found.hard_onset,
        "period_doubling": found.doubling,
        "chaos": found.chaos,
        "domain_limit": found.domain_limit,
        "largest_A_h": found.reach if math.isfinite(found.reach) else None,
        "recommended": tried.get("A") or found.recommended,
        "eigenvalues": list(found.eigenvalues),
        "turn": found.turn,
        "slope": found.slope,
        "feedback": found.feedback,
        "gain_scale": found.signed_scale,
        "behaviours": rows,
        "run": tried or None,
    }
