"""Options that several commands share, and how they turn into an experiment."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from fpt_ros.errors import BadInput

if TYPE_CHECKING:
    from fpt_ros.experiments.experiment import Experiment

Name = Annotated[
    str, typer.Argument(metavar="NAME", help="An experiment (fpt list), or a parameter file.")
]
Variant = Annotated[
    str,
    typer.Option(
        metavar="NAME|FILE.yaml",
        help="A variant of the experiment (fpt list), or an overlay file, as fpt tune writes it.",
    ),
]
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
    from fpt_ros.experiments.experiment import load

    return load(name, variant, settings or (), duration, seed)


def check_new_directory(path: Path) -> None:
    """A recording can be made at ``path``.

    Raises:
        BadInput: it exists, or cannot be created.
    """
    if path.exists():
        raise BadInput(f"--record {path} exists: give a directory that does not")
    missing = [path.absolute()]
    while not missing[-1].parent.exists():
        missing.append(missing[-1].parent)
    try:
        path.mkdir(parents=True)
    except OSError as error:
        why = error.strerror or "it cannot be created"
        raise BadInput(f"--record {path}: {why}, give a directory that can be created") from error
    finally:
        for created in missing:
            if created.is_dir():
                created.rmdir()
