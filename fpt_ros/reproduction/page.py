"""One page for all claims of some chapters, and the same as JSON."""

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path

from jinja2 import Environment, StrictUndefined

from fpt_ros import __version__
from fpt_ros.analysis.whole_files import write_whole
from fpt_ros.errors import BadInput
from fpt_ros.reproduction import Case, Claim, Group, Verdict
from fpt_ros.reproduction.work import Done, Picture


@dataclass(frozen=True)
class Judged:
    """A claim, its verdict, and the runs that decide it."""

    claim: Claim
    verdict: Verdict
    cases: Mapping[str, Case]


@dataclass(frozen=True)
class Section:
    """A group as the page shows it."""

    chapter: int
    group: Group
    judged: tuple[Judged, ...]
    pictures: tuple[Picture, ...]


def sections(chapter: int, groups: Sequence[Group], done: Sequence[Done]) -> list[Section]:
    """Judge the claims of a chapter."""
    found = []
    for group, each in zip(groups, done, strict=True):
        judged = tuple(
            Judged(
                claim,
                claim.judge(each.outcomes),
                {key: group.cases[key] for key in claim.cases},
            )
            for claim in group.claims
        )
        found.append(Section(chapter, group, judged, each.pictures))
    return found


def as_json(parts: Sequence[Section]) -> dict[str, object]:
    """All verdicts as plain values."""
    claims = [
        {
            "chapter": part.chapter,
            "experiment": part.group.title,
            "section": one.claim.section,
            "figures": one.claim.figures,
            "claim": one.claim.text,
            "reproduces": one.verdict.status,
            "measured": one.verdict.measured,
            "reason": one.verdict.reason,
            "commands": [case.command for case in one.cases.values()],
        }
        for part in parts
        for one in part.judged
    ]
    return {"version": __version__, "counts": _counts(parts), "claims": claims}


def _counts(parts: Sequence[Section]) -> dict[str, int]:
    return dict(Counter(one.verdict.status for part in parts for one in part.judged))


def write(parts: Sequence[Section], directory: Path, seconds: float) -> Path:
    """Write ``index.html`` and ``claims.json``; each appears whole or not at all.

    Raises:
        BadInput: the directory cannot be written.
    """
    environment = Environment(
        autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    template = files("fpt_ros.reproduction").joinpath("page.html.j2").read_text(encoding="utf-8")
    page = environment.from_string(template).render(
        sections=parts, counts=_counts(parts), version=__version__, seconds=seconds
    )
    numbers = json.dumps(as_json(parts), indent=2, allow_nan=False, ensure_ascii=False) + "\n"
    try:
        directory.mkdir(parents=True, exist_ok=True)
        write_whole(directory / "claims.json", numbers.encode())
        write_whole(directory / "index.html", page.encode())
    except OSError as error:
        reason = error.strerror or str(error)
        raise BadInput(f"--out {directory}: {reason}; it takes a directory to write to") from error
    return directory / "index.html"
