"""All verdicts as one object, ``claims.json``."""

import math
from collections.abc import Mapping, Sequence

from fpt_ros import __version__
from fpt_ros.thesis.chapters import Chapter
from fpt_ros.thesis.judging import Outcome, count


def as_json(asked: Sequence[Chapter], found: Mapping[str, Outcome]) -> dict[str, object]:
    """All verdicts as one object; a number that does not exist is ``None``."""
    claims = []
    for chapter in asked:
        for name, claim in chapter.claims.items():
            outcome = found[name]
            verdict = outcome.verdict
            claims.append(
                {
                    "id": name,
                    "chapter": chapter.number,
                    "section": claim.section,
                    "figures": claim.figures,
                    "claim": claim.text,
                    "status": verdict.status,
                    "measured": {key: _plain(value) for key, value in verdict.measured.items()},
                    "reason": verdict.reason,
                    "table": None
                    if verdict.table is None
                    else [list(verdict.table.headings), *map(list, verdict.table.rows)],
                    "not_complete": dict(outcome.endings),
                    "runs": {key: setup.command() for key, setup in claim.runs.items()},
                }
            )
    counted = count(found.values())
    return {"version": __version__, "count": counted, "claims": claims}


def _plain(value: float | str | None) -> float | str | None:
    if isinstance(value, float | int):
        return float(value) if math.isfinite(value) else None
    return value
