"""``fpt gain``, and the warning of ``fpt run`` and ``fpt simulate``."""

import math
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from fpt_ros.cli.options import Json, Name, Settings, Variant, experiment_of

if TYPE_CHECKING:
    from fpt_ros.experiments.experiment import Experiment
    from fpt_ros.gain.contraction import Gain
    from fpt_ros.gain.motion import Point

Out = Annotated[
    Path | None,
    typer.Option(metavar="DIR", help="Write gain.png, gain.svg and gain.json to this directory."),
]
Plot = Annotated[
    Path | None, typer.Option(metavar="FILE", help="Draw the picture: FILE.png or FILE.svg.")
]

KINDS = ("png", "svg")
ATTEMPTS = 6
"""Runs in search of a gain that keeps control."""

MARGIN = 0.9
"""The model as it was tuned asks for another run where it allows less than this part of A."""


def gain(
    name: Name,
    variant: Variant = "adaptive",
    set_: Settings = None,
    out: Out = None,
    plot: Plot = None,
    json: Json = False,
) -> None:
    """Show for which A the iteration contracts, what happens outside, and recommend an A.

    Example: fpt gain tora --plot /tmp/tora_gain.png
    """
    from fpt_ros.errors import BadInput
    from fpt_ros.extras import need

    if plot is not None and plot.suffix.lower().removeprefix(".") not in KINDS:
        raise BadInput(f"--plot {plot}: it takes a name that ends with .png or .svg")
    if plot is not None or out is not None:
        need("analysis")
    experiment = experiment_of(name, variant, set_, None, None)
    from fpt_ros.gain.contraction import bounds

    found = bounds(experiment).with_chaos()
    points, tried = _tried(experiment, found)
    result = _result(experiment, found, tried)
    written = [*([plot] if plot is not None else [])]
    if out is not None:
        written += [out / f"gain.{kind}" for kind in KINDS]
    if written:
        _draw(experiment, replace(found, recommended=result["recommended"]), points, written)
    if out is not None:
        import json as json_module

        text = json_module.dumps(result, indent=2, allow_nan=False)
        (out / "gain.json").write_text(text + "\n")
    if json:
        from fpt_ros.cli.output import print_json

        print_json({**result, "files": [str(path) for path in written]})
        return
    _print(experiment, found, result)
    for path in written:
        print(f"picture: {path}")


def warn_about_gain(experiment: "Experiment") -> None:
    """One line on standard error where the experiment's A is not one with which it contracts."""
    from fpt_ros.gain.contraction import warning

    text = warning(experiment)
    if text:
        print(f"fpt: warning: {text}", file=sys.stderr)


def _tried(experiment: "Experiment", found: "Gain") -> "tuple[list[Point] | None, dict[str, Any]]":
    """A run with the recommended A, with less where it fails or the tuned model asks for less."""
    from fpt_ros.analysis.metrics import summary
    from fpt_ros.engine.engine import Engine
    from fpt_ros.errors import RunFailed
    from fpt_ros.gain.contraction import bounds
    from fpt_ros.gain.motion import along
    from fpt_ros.runs.run import Run, describe

    reason, A = "", found.recommended
    for attempt in range(ATTEMPTS if found.sign else 0):
        one = experiment if found.calculated else experiment.with_values("fpt_deformer", A=A)
        loop = one.loop()
        engine = Engine(loop)
        try:
            engine.run()
        except RunFailed as error:
            reason, A = reason or str(error), 0.5 * A
            continue
        points = along(engine, loop)
        there = bounds(one, points)
        less = there.sign == found.sign and abs(there.recommended) < MARGIN * abs(A)
        if less and not found.calculated and attempt + 1 < ATTEMPTS:
            A = there.recommended
            continue
        numbers = summary(Run(describe(one, "in_process", ""), one.nodes, engine.topics()))
        return points, {
            "A": None if found.calculated else A,
            "complete": True,
            "reason": reason,
            "tracking": numbers["tracking"],
            "chatter": numbers["chatter"],
            "eigenvalues": list(there.eigenvalues),
            "linear_limit": there.linear_limit,
        }
    return None, {"A": None, "complete": False, "reason": reason} if found.sign else {}


def _result(experiment: "Experiment", found: "Gain", tried: dict[str, Any]) -> dict[str, Any]:
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
        "slope": found.slope,
        "feedback": found.feedback,
        "behaviours": rows,
        "run": tried or None,
    }


def _draw(
    experiment: "Experiment", found: "Gain", points: "list[Point] | None", paths: list[Path]
) -> None:
    from fpt_ros.analysis import style
    from fpt_ros.errors import BadInput
    from fpt_ros.gain.figure import figure
    from fpt_ros.gain.motion import course

    low, high = found.range
    plant = experiment.loop().plant.plant
    title = f"{experiment.about['title']}: contracts for A in ({low:.4g}, {high:.4g})"
    if not found.sign:
        title = f"{experiment.about['title']}: no A contracts"
    unit = plant.units[0] if len(set(plant.units)) == 1 else ""
    per = {1: "/s", 2: "/s²"}.get(plant.order, "")
    picture = figure(found, course(experiment, points), title, unit + per if unit else "")
    for path in paths:
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            kind = path.suffix.lower().removeprefix(".")
            with style.settings():
                picture.savefig(path, metadata={"Date": None} if kind == "svg" else {})
        except OSError as error:
            raise BadInput(
                f"cannot write {path}: {error.strerror or error}, give a name that can be written"
            ) from error


def _print(experiment: "Experiment", found: "Gain", result: dict[str, Any]) -> None:
    from rich.table import Table

    from fpt_ros.cli.output import console

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


def _remarks(experiment: "Experiment", found: "Gain", result: dict[str, Any]) -> list[str]:
    """What the table does not say."""
    from fpt_ros.tuning import WEIGHTS

    least, greatest = found.eigenvalues
    tried = result["run"] or {}
    first = (
        f"eigenvalues of the response {least:.5g} .. {greatest:.5g}, slope of the transformation "
        f"{found.slope:.5g}"
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
