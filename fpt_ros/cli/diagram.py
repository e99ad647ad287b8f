"""``fpt diagram``."""

from pathlib import Path
from typing import Annotated

import typer

from fpt_ros.cli.options import Name, Settings, Variant, experiment_of

Out = Annotated[
    Path | None,
    typer.Option(metavar="FILE.svg", help="Where to; by default NAME.svg, NAME.VARIANT.svg here."),
]


def diagram(
    name: Name, variant: Variant = "adaptive", set_: Settings = None, out: Out = None
) -> None:
    """Draw the loop of an experiment: blocks, laws, delays, signals with their units, as SVG.

    Example: fpt diagram swing --out /tmp/swing.svg
    """
    from fpt_ros.analysis.diagram import svg
    from fpt_ros.analysis.whole_files import write_whole
    from fpt_ros.errors import BadInput
    from fpt_ros.experiments.experiment import BASE

    experiment = experiment_of(name, variant, set_, None, None)
    own = f".{experiment.variant}" if experiment.variant != BASE else ""
    path = Path(f"{experiment.name}{own}.svg") if out is None else out
    if path.suffix.lower() != ".svg":
        raise BadInput(f"--out {path}: it takes a name that ends with .svg")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, svg(experiment).encode())
    except OSError as error:
        raise BadInput(
            f"cannot write {path}: {error.strerror or error}, give a name that can be written"
        ) from error
    print(f"picture: {path}")
