"""Parameter files that go with a job: a worker on another host does not have them."""

import tempfile
from dataclasses import replace
from pathlib import Path

from fpt_ros.experiments.experiment import LAID_OVER, parameter_files
from fpt_ros.sweep.job import Job

_folders: list[tempfile.TemporaryDirectory[str]] = []
"""Of the copies; removed with the process."""


def texts_of(name: str, variant: str) -> tuple[tuple[str, str], ...]:
    """Path and text of the files of an experiment that is not one of the package's.

    Files that parameters name (a robot's, a recorded trajectory) do not go along.
    """
    paths = parameter_files(name, variant)
    return tuple((str(path), path.read_text(encoding="utf-8")) for path in paths)


def at_hand(job: Job) -> Job:
    """The job as it can be loaded here: where its files are missing or others, on copies."""
    if all(_is_here(path, text) for path, text in job.files):
        return job
    folder = tempfile.TemporaryDirectory(prefix="fpt_ros-sweep-")
    _folders.append(folder)
    copies: dict[str, str] = {}
    parents: dict[Path, Path] = {}
    for path, text in job.files:
        original = Path(path)
        parent = parents.setdefault(original.parent, Path(folder.name) / str(len(parents)))
        parent.mkdir(exist_ok=True)
        (parent / original.name).write_text(text, encoding="utf-8")
        copies[path] = str(parent / original.name)
    words = [job.variant] if job.variant in copies else job.variant.split(LAID_OVER)
    variant = LAID_OVER.join(copies.get(word, word) for word in words)
    return replace(job, name=copies.get(job.name, job.name), variant=variant, files=())


def _is_here(path: str, text: str) -> bool:
    try:
        return Path(path).read_text(encoding="utf-8") == text
    except (OSError, UnicodeDecodeError):
        return False
