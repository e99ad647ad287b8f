"""Options that several commands share, and how they turn into an experiment."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from fpt_ros.errors import BadInput

if TYPE_CHECKING:
    from fpt_ros.loop.experiment import Experiment

Name = Annotated[
    str, typer.Argument(metavar="NAME", help="An experiment (fpt list), or a parameter file.")
]
Variant = Annotated[str, typer.Option(help="A variant of the experiment (fpt list).")]
Settings = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="NODE.PARAM=VALUE", help="Change a parameter; repeatable."),
]
Duration = Annotated[float | None, typer.Option(metavar="S", help="Length of the run [s].")]
Seed = Annotated[int | None, typer.Option(metavar="N", help="Random seed of the noise.")]
Record = Annotated[
    Path | None, typer.Option(metavar="DIR", help="Record to this directory; must not exist.")
]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON object, nothing else.")]


def experiment_of(
    name: str,
    variant: str,
    settings: list[str] | None,
    duration: float | None,
    seed: int | None,
) -> "Experiment":
    """The experiment that the options ask for.

    Raises:
        BadInput: any of them is not valid.
    """
    from fpt_ros.loop.experiment import load

    return load(name, variant, settings or (), duration, seed)


def check_new_directory(path: Path) -> None:
    """A recording can be made at ``path``.

    Raises:
        BadInput: it exists, or cannot be created.
    """
    import os

    if path.exists():
        raise BadInput(f"--record {path} exists: give a directory that does not")
    parent = path.absolute().parent
    while not parent.exists():
        parent = parent.parent
    if not (parent.is_dir() and os.access(parent, os.W_OK)):
        raise BadInput(f"--record {path}: {parent} cannot be written to, give another directory")
