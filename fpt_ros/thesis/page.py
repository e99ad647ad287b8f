"""The page about what of the thesis reproduces."""

import base64
import json
import math
import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fpt_ros import __version__
from fpt_ros.analysis import pages
from fpt_ros.analysis.tables import number_text
from fpt_ros.analysis.whole_files import write_whole
from fpt_ros.errors import BadInput
from fpt_ros.thesis.chapters import Chapter
from fpt_ros.thesis.claim import Claim, Evidence
from fpt_ros.thesis.claims_json import as_json
from fpt_ros.thesis.commands import commands
from fpt_ros.thesis.judging import Outcome, Shown, count
from fpt_ros.thesis.setup import Setup

TEMPLATE = "page.html.j2"


def write_page(
    asked: Sequence[Chapter], found: Mapping[str, Outcome], directory: Path, seconds: float
) -> Path:
    """Write ``index.html`` (complete in itself) and ``claims.json``, each whole or not at all.

    Args:
        asked, found: chapters, and what became of their claims.
        directory: made where it does not exist; files of an older page are replaced.
        seconds: how long it took.

    Returns:
        Path of the page.

    Raises:
        BadInput: the directory cannot be written.
    """
    text = json.dumps(as_json(asked, found), indent=2, allow_nan=False, ensure_ascii=False) + "\n"
    page = _page(asked, found, seconds)
    try:
        directory.mkdir(parents=True, exist_ok=True)
        write_whole(directory / "claims.json", text.encode())
        write_whole(directory / "index.html", page.encode())
    except OSError as error:
        raise cannot_write(directory, error) from error
    return directory / "index.html"


def check_directory(directory: Path) -> None:
    """The page can be written there: better said before the runs than after.

    Raises:
        BadInput: it cannot.
    """
    there = directory.absolute()
    while not there.exists():
        there = there.parent
    if not there.is_dir() or not os.access(there, os.W_OK):
        why = "is not a directory" if not there.is_dir() else "cannot be written to"
        raise BadInput(f"--out {directory}: {there} {why}, give a directory that can be written")


def cannot_write(directory: Path, error: OSError) -> BadInput:
    """What to say where writing fails."""
    reason = error.strerror or str(error)
    return BadInput(
        f"cannot write the page to {directory}: {reason}; it takes a directory to write to"
    )


@dataclass(frozen=True)
class Block:
    """A claim as the page shows it."""

    name: str
    claim: Claim[Any]
    outcome: Outcome
    measured: tuple[tuple[str, str], ...]
    commands: tuple[str, ...]
    pictures: tuple[tuple[Shown, str], ...]
    kind: str


def _page(asked: Sequence[Chapter], found: Mapping[str, Outcome], seconds: float) -> str:
    blocks = {
        chapter.number: [_block(name, claim, found[name]) for name, claim in chapter.claims.items()]
        for chapter in asked
    }
    sources = [
        _kind(source)
        for chapter in asked
        for claim in chapter.claims.values()
        for source in claim.runs.values()
    ]
    return pages.render(
        TEMPLATE,
        package=__package__,
        chapters=asked,
        blocks=blocks,
        count=count(found.values()),
        runs=sources.count("run"),
        trials=sources.count("trial"),
        pictures=sum(len(outcome.pictures) for outcome in found.values()),
        seconds=seconds,
        version=__version__,
    )


def _kind(source: Evidence[Any]) -> str:
    return "run" if isinstance(source, Setup) else "trial"


def _block(name: str, claim: Claim[Any], outcome: Outcome) -> Block:
    measured = tuple(
        (label.strip(), number_words(value)) for label, value in outcome.verdict.measured.items()
    )
    pictures = tuple((p, base64.b64encode(p.data).decode()) for p in outcome.pictures)
    kind = next(map(_kind, claim.runs.values()), "")
    return Block(name, claim, outcome, measured, tuple(commands(claim)), pictures, kind)


def number_words(value: float | str | None) -> str:
    """A measured quantity in words."""
    if value is None:
        return "–"
    if isinstance(value, str):
        return value
    if not math.isfinite(value):
        return "lost"
    if float(value).is_integer() and abs(value) < 1e6:
        return f"{value:.0f}"
    return re.sub(r"e([-+])0?", r"e\1", number_text(value))
