"""The chapters of the thesis that have claims.

A chapter is a package ``chapterN`` in this folder with ``TITLE`` and ``CLAIMS``; it is found by its
name. Each of its files holds the claims of a section: what judges them, and their pictures.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from difflib import get_close_matches
from functools import cache
from importlib import import_module
from pkgutil import iter_modules
from typing import Any

from fpt_ros import thesis
from fpt_ros.errors import BadInput
from fpt_ros.thesis.claim import Claim


@dataclass(frozen=True)
class Chapter:
    """A chapter of the thesis; ``claims`` by identifier, its section and a letter (``2.2.1a``)."""

    number: int
    title: str
    claims: Mapping[str, Claim[Any]]


@cache
def chapters() -> Mapping[int, Chapter]:
    """All chapters that have claims, by number."""
    found = {}
    for module in iter_modules(thesis.__path__):
        match = re.fullmatch(r"chapter(\d+)", module.name)
        if match:
            number = int(match[1])
            contents = import_module(f"{thesis.__name__}.{module.name}")
            found[number] = Chapter(number, contents.TITLE, _named(contents.CLAIMS))
    return dict(sorted(found.items()))


def _named(claims: Sequence[Claim[Any]]) -> Mapping[str, Claim[Any]]:
    named: dict[str, Claim[Any]] = {}
    for claim in claims:
        count = sum(one.section == claim.section for one in named.values())
        named[claim.section + chr(ord("a") + count)] = claim
    return named


def wanted(numbers: Sequence[int], names: Sequence[str] = ()) -> list[Chapter]:
    """Chapters by their numbers, all where there are none, with the claims of these names only.

    Example: ``wanted([3], ["3.1.1a"])`` is chapter 3 with one claim.

    Raises:
        BadInput: there is no such chapter, or no such claim in these chapters.
    """
    known = chapters()
    for number in numbers:
        if number not in known:
            valid = ", ".join(map(str, known))
            raise BadInput(f"--chapter {number}: it takes one of {valid}")
    chosen = [chapter for number, chapter in known.items() if number in numbers or not numbers]
    if not names:
        return chosen
    there = [name for chapter in chosen for name in chapter.claims]
    for name in names:
        if name not in there:
            valid = ", ".join(get_close_matches(name, there, 5, 0.0))
            raise BadInput(f"--claim {name}: there is no such claim, nearest are {valid}")
    narrowed = [
        replace(one, claims={name: claim for name, claim in one.claims.items() if name in names})
        for one in chosen
    ]
    return [chapter for chapter in narrowed if chapter.claims]
