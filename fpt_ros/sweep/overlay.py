"""What was found, as the overlay file of a variant: ``--variant FILE.yaml``."""

import os
from pathlib import Path

from fpt_ros.errors import BadInput
from fpt_ros.experiments import description, parameter_file
from fpt_ros.experiments.experiment import load
from fpt_ros.parameters import Value, Values
from fpt_ros.sweep.tune import Result, Task

HEADER = "# Tuned by fpt tune"
"""First words of the files that are written here, and so may be written again."""

DERIVED = frozenset(("experiment", "variant", "await_tuning"))
"""Parameters that the loader works out itself."""


def write_overlay(task: Task, found: Result, path: Path) -> None:
    """Write what differs from the base file as the overlay of a variant.

    Raises:
        BadInput: it cannot be written, or another file is there.
    """
    check_overlay(path)
    job = task.job
    base = load(job.name)
    changed: dict[str, dict[str, Value]] = {}
    for node, values in found.experiment.nodes.items():
        own = _different(base.nodes[node], values)
        if own:
            changed[node] = own
    metrics = ", ".join(task.metrics)
    limits = "".join(f", {name} <= {value:g}" for name, value in task.limits.items())
    note = f"{found.trials} runs for the least {metrics}{limits}"
    about = changed.setdefault(description.NODE, {})
    about.update(shows=f"tuned: {note}", experiment=found.experiment.name)
    half = path.with_name(f".{path.name}")
    try:
        parameter_file.write(half, changed)
        text = half.read_text(encoding="utf-8")
        half.write_text(f"{HEADER}: {note}.\n{text}", encoding="utf-8")
        half.replace(path)
    except OSError as error:
        raise BadInput(f"--out {path} cannot be written: {error.strerror}") from error


def check_overlay(path: Path) -> None:
    """A file can be written at ``path``.

    Raises:
        BadInput: its folder does not exist or cannot be written, or a file is there that
            ``fpt tune`` has not made.
    """
    folder = path.absolute().parent
    if not folder.is_dir() or not os.access(folder, os.W_OK):
        raise BadInput(f"--out {path} cannot be written: give a folder that exists and is yours")
    if path.suffix not in (".yaml", ".yml") or path.is_dir():
        raise BadInput(f"--out {path}: give a file whose name ends in .yaml")
    if path.exists():
        try:
            ours = path.read_text(encoding="utf-8").startswith(HEADER)
        except (OSError, UnicodeDecodeError):
            ours = False
        if not ours:
            raise BadInput(f"--out {path} exists and is not of fpt tune: give another name")


def _different(base: Values, values: Values) -> dict[str, Value]:
    return {
        name: value
        for name, value in values.items()
        if name not in DERIVED and (name not in base or base[name] != value)
    }
