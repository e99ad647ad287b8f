"""What ``fpt gain`` prints."""

import math
from typing import Any

from rich.table import Table

from fpt_ros.cli.output import console
from fpt_ros.experiments.experiment import Experiment
from fpt_ros.gain.limits import Gain
from fpt_ros.tuning import WEIGHTS


def print_gain(experiment: Experiment, found: Gain, result: dict[str, Any]) -> None:
    """The table of behaviours, and what it does not say."""
    out = console()
    title = f"{experiment.name} {experiment.variant}"
    least, greatest = found.eigenvalues
    if not found.sign:
        print(
            f"{title}: no A contracts, the response's eigenvalues are between {least:.4g} and "
            f"{greatest:.4g}, and have to be of one sign"
        )
        return
    low, high = found.range
    print(f"{title}: the iteration contracts for A in ({low:.7g}, {high:.7g})")
    table = Table("from A =", "to", "behaviour", "", box=None, pad_edge=False)
    for row in result["behaviours"]:
        start, end = row["from"], row["to"]
        ends = [start if start is not None else -found.sign * math.inf]
        ends.append(end if end is not None else found.sign * math.inf)
        inside = min(ends) <= found.given < max(ends) if found.sign > 0 else False
        inside = inside or (found.sign < 0 and min(ends) < found.given <= max(ends))
        note = f"<- A = {found.given:g}" if inside and not found.calculated else ""
        table.add_row(*(f"{x + 0.0:.7g}" for x in ends), row["behaviour"], note)
    out.print(table)
    for line in _remarks(experiment, found, result):
        print(line)


def turning(found: Gain) -> str:
    """Words for complex eigenvalues; empty where all are real."""
    if not found.turn:
        return ""
    return f" (real parts; complex, up to {math.degrees(found.turn):.3g} degrees off the real axis)"


def _remarks(experiment: Experiment, found: Gain, result: dict[str, Any]) -> list[str]:
    """What the table does not say."""
    least, greatest = found.eigenvalues
    tried = result["run"] or {}
    first = (
        f"eigenvalues of the response {least:.5g} .. {greatest:.5g}{turning(found)}, slope of the "
        f"transformation {found.slope:.5g}"
    )
    if found.feedback:
        first += (
            f", feedback of the desired response {found.feedback:.3g} (without it the bound is "
            f"{found.sign * found.bare_limit:.7g})"
        )
    lines = [first]
    if found.hard_onset is not None:
        lines.append(
            f"hard onset: from {found.sign * found.hard_onset:.5g} on a two-cycle with steps of r "
            f"of {found.hard_step:.4g} lies beside the solution: a large error ends in it"
        )
    if math.isfinite(found.reach):
        lines.append(
            f"|A| h > {found.reach:.5g} is out of the domain of F at once (A = {found.given:g}: a "
            f"response error of {found.reach / abs(found.given):.4g})"
            if found.given
            else f"|A| h > {found.reach:.5g} is out of the domain of F at once"
        )
    loop = experiment.loop()
    if loop.tuner.law.tunes == WEIGHTS:
        lines.append(
            "the tuner multiplies A by weights: with A = "
            f"{found.given:g} they contract up to {found.linear_limit / abs(found.given):.4g}"
        )
    if experiment.nodes["denoiser"]["method"] != "none":
        lines.append("the filter (denoiser.method) is left out of this analysis")
    if found.calculated:
        lines.append("A is calculated by the tuner: fpt_deformer.A of the file is not used")
    advice = f"recommended: A = {result['recommended']:g}"
    if tried.get("complete") and not found.calculated:
        errors = ", ".join(
            f"{name} {numbers['rms_settled']:.3g}"
            for name, numbers in tried["tracking"].items()
            if numbers["rms_settled"] is not None
        )
        advice += f" (a run with it: settled rms error {errors}; chatter {tried['chatter']:.3g})"
    lines.append(advice)
    if tried.get("given"):
        lines.append(
            f"A = {found.given:g} is kept: with A = {tried['rejected']:g} the settled rms "
            f"errors are {tried['given']['ratio']:.4g} times as large"
        )
    if tried.get("reason"):
        whole = f"a run with A = {found.recommended:g}" if not found.calculated else "the run"
        lines.append(f"but {whole} did not end well: {tried['reason']}")
    if tried.get("complete") and abs(tried["linear_limit"] / found.linear_limit - 1.0) > 5e-3:
        least, greatest = tried["eigenvalues"]
        lines.append(
            f"along that run, with the model as it was tuned: eigenvalues {least:.5g} .. "
            f"{greatest:.5g}, linear limit {found.sign * tried['linear_limit']:.5g}"
        )
    return lines
