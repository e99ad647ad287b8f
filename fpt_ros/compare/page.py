"""The page of a comparison, and its numbers for programs."""

import base64
import csv
import io
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fpt_ros import __version__
from fpt_ros.analysis import pages, style
from fpt_ros.analysis.tables import number_text
from fpt_ros.analysis.whole_files import write_whole
from fpt_ros.compare.field import DELAY, NOISE, Circumstance
from fpt_ros.compare.figures import Chart, charts, units
from fpt_ros.compare.results import Cell, Results
from fpt_ros.compare.verdicts import verdicts
from fpt_ros.errors import BadInput
from fpt_ros.sweep.job import COMPLETE

TEMPLATE = "page.html.j2"

COLUMNS = ("error", "max", "effort", "step", "cut", "cost")
"""Of the first table, and of the table for other programs."""


@dataclass(frozen=True)
class Table:
    """Errors of all controllers under some circumstances; ``best``: the least of a column."""

    title: str
    circumstances: Sequence[Circumstance]
    rows: Sequence[tuple[Cell, Sequence[Cell]]]
    best: frozenset[tuple[str, str]]


def write_page(results: Results, directory: Path, command: str) -> Path:
    """Write ``index.html`` (complete in itself), ``results.json``, ``results.csv`` and the figures.

    All but the costs of a cycle follow from the definition: the same command gives the same files.

    Args:
        results: of all tasks.
        directory: that of the comparison.
        command: that made it, for the page.

    Raises:
        BadInput: it cannot be written.
    """
    drawn = charts(results)
    pictures = {chart.name: _rendered(chart, "svg") for chart in drawn}
    numbers = json.dumps(as_json(results), indent=1, allow_nan=False) + "\n"
    page = _page(results, drawn, pictures, command)
    try:
        (directory / "figures").mkdir(exist_ok=True)
        for chart in drawn:
            write_whole(directory / "figures" / f"{chart.name}.svg", pictures[chart.name])
            write_whole(directory / "figures" / f"{chart.name}.png", _rendered(chart, "png"))
        write_whole(directory / "results.json", numbers.encode())
        write_whole(directory / "results.csv", _csv(results).encode())
        write_whole(directory / "index.html", page.encode())
    except OSError as error:
        raise BadInput(f"--out {directory} cannot be written: {error.strerror}") from error
    return directory / "index.html"


def as_json(results: Results) -> dict[str, Any]:
    """All numbers; ``cost`` [us a cycle] alone depends on the machine."""
    plan = results.asked.plan
    return {
        "experiment": plan.field.name,
        "definition": dict(results.asked.definition),
        "results": [
            {
                "controller": cell.controller.name,
                "circumstance": one.name,
                "variant": cell.variant,
                "settings": list(one.settings),
                "transformation": cell.controller.family,
                "outcome": cell.outcome,
                "failed": cell.verdict or None,
                **{name: getattr(cell, name) for name in COLUMNS if name != "cost"},
            }
            for one in plan.field.circumstances
            for cell in results.of(one)
        ],
        "verdicts": [
            {"circumstance": each.circumstance.name, "kind": each.kind, "text": each.text}
            for each in verdicts(results)
        ],
        "tuning": [
            {
                "controller": each.controller.name,
                "circumstance": each.circumstance.name,
                "before": dict(each.before),
                "found": dict(each.found),
                "reason": each.reason,
                "trials": [list(point) for point in each.trials],
            }
            for each in results.tunings.values()
        ],
        "left_out": dict(plan.field.left_out),
        "cost": {
            f"{name}, {one}": cell.cost
            for (name, one), cell in results.cells.items()
            if cell.cost is not None
        },
    }


def _csv(results: Results) -> str:
    buffer = io.StringIO()
    lines = csv.writer(buffer, lineterminator="\n")
    lines.writerow(["controller", "circumstance", "outcome", *COLUMNS, "failed"])
    for one in results.asked.plan.field.circumstances:
        for cell in results.of(one):
            numbers = [getattr(cell, name) for name in COLUMNS]
            lines.writerow([cell.controller.name, one.name, cell.outcome, *numbers, cell.verdict])
    return buffer.getvalue()


def _rendered(chart: Chart, kind: str) -> bytes:
    buffer = io.BytesIO()
    with style.settings():
        chart.figure.savefig(buffer, format=kind, metadata={"Date": None} if kind == "svg" else {})
    return buffer.getvalue()


def _page(
    results: Results, drawn: Sequence[Chart], pictures: Mapping[str, bytes], command: str
) -> str:
    plan = results.asked.plan
    circumstances = plan.field.circumstances
    unit, force = units(results)
    return pages.render(
        TEMPLATE,
        package=__package__,
        title=str(plan.field.experiment.about["title"] or plan.field.experiment.name),
        shows=str(plan.field.experiment.about["shows"]),
        results=results,
        plan=plan,
        first=results.of(circumstances[0]),
        verdicts=verdicts(results),
        tables=_tables(results),
        failures=[
            cell
            for one in circumstances
            for cell in results.of(one)
            if cell.verdict or cell.outcome != COMPLETE
        ],
        tunings=list(results.tunings.values()),
        charts=[(chart, base64.b64encode(pictures[chart.name]).decode()) for chart in drawn],
        number=number_words,
        percent=percent_words,
        unit=unit,
        force=force,
        command=command,
        version=__version__,
    )


def _tables(results: Results) -> list[Table]:
    field = results.asked.plan.field
    kinds = (
        ("Other circumstances", list(field.groups[0])),
        ("Noise", [one for one in field.circumstances if one.grade == NOISE]),
        ("Delay", [one for one in field.circumstances if one.grade == DELAY]),
    )
    return [_table(title, chosen, results) for title, chosen in kinds if chosen]


def _table(title: str, chosen: Sequence[Circumstance], results: Results) -> Table:
    rows = [
        (
            results.cells[one.name, chosen[0].name],
            [results.cells[one.name, each.name] for each in chosen],
        )
        for one in results.ranked
    ]
    best = set()
    for each in chosen:
        good = [cell for cell in results.of(each) if cell.good]
        if good:
            least = min(good, key=lambda cell: cell.error or math.inf)
            best.add((least.controller.name, each.name))
    return Table(title, chosen, rows, frozenset(best))


def number_words(value: float | None) -> str:
    """A number of the tables."""
    if value is None:
        return "–"
    if value != 0.0 and not 1e-3 <= abs(value) < 1e4:
        mantissa, exponent = f"{value:.2e}".split("e")
        return f"{mantissa}e{int(exponent)}"
    return number_text(float(f"{value:.3g}"))


def percent_words(value: float | None) -> str:
    """A part of the cycles."""
    return "–" if value is None else "0" if value == 0.0 else f"{100.0 * value:.2g} %"
