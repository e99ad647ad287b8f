"""``fpt gain``, and the warning of ``fpt run`` and ``fpt simulate``."""

import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from fpt_ros.cli.options import Json, Name, Settings, Variant, experiment_of

if TYPE_CHECKING:
    from fpt_ros.experiments.experiment import Experiment
    from fpt_ros.experiments.response_map import Point
    from fpt_ros.gain.limits import Gain

Out = Annotated[
    Path | None,
    typer.Option(metavar="DIR", help="Write gain.png, gain.svg and gain.json to this directory."),
]
Plot = Annotated[
    Path | None, typer.Option(metavar="FILE", help="Draw the picture: FILE.png or FILE.svg.")
]

KINDS = ("png", "svg")


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
    from fpt_ros.gain.as_numbers import as_numbers
    from fpt_ros.gain.contraction import bounds
    from fpt_ros.gain.trial import try_out

    found = bounds(experiment).with_chaos()
    points, tried = try_out(experiment, found)
    result = as_numbers(experiment, found, tried)
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
    from fpt_ros.cli.gain_text import print_gain

    print_gain(experiment, found, result)
    for path in written:
        print(f"picture: {path}")


def warn_about_gain(experiment: "Experiment") -> "Experiment":
    """One line on standard error where the experiment's A is not one with which it contracts.

    Returns:
        The experiment, its deformer told what it has to know to judge an A in flight.

    Raises:
        BadInput: ``fpt_deformer.strict_gain``, and there is something to be said of A.
    """
    from fpt_ros.errors import BadInput
    from fpt_ros.gain.warning import known, told, warning

    gain = known(experiment)
    text = warning(experiment, gain)
    if text and experiment.nodes["fpt_deformer"]["strict_gain"]:
        raise BadInput(f"strict_gain: {text}")
    if text:
        print(f"fpt: warning: {text}", file=sys.stderr)
    return told(experiment, gain)


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
