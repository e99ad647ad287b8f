"""The report: one page that holds everything, and the figures and numbers beside it."""

import base64
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from fpt_ros.analysis import pages, signals
from fpt_ros.analysis.arm.film import film_of
from fpt_ros.analysis.captions import CAPTIONS
from fpt_ros.analysis.comparison import baselines, comparison
from fpt_ros.analysis.figures import Chart, charts
from fpt_ros.analysis.labels import run_labels
from fpt_ros.analysis.outline import Outline, with_numbers
from fpt_ros.analysis.tables import content
from fpt_ros.analysis.whole_files import write_whole
from fpt_ros.errors import BadInput
from fpt_ros.messages.frames import SECOND
from fpt_ros.parameters import Value
from fpt_ros.runs.cost import HEADINGS, row
from fpt_ros.runs.run import Run

TEMPLATE = "report.html.j2"

FORMATS = ("svg", "pdf", "png")
"""Of the figures beside the page."""


@dataclass(frozen=True)
class Difference:
    """One parameter of a node in all runs; ``differs``: not the same in all of them."""

    name: str
    values: tuple[str, ...]
    differs: bool


@dataclass(frozen=True)
class About:
    """What the page says about one run."""

    label: str
    sentence: str
    thesis: str
    facts: tuple[str, ...]
    complete: bool
    ending: str
    changes: tuple[str, ...]


def write_report(runs: Sequence[Run], directory: Path, formats: Sequence[str] = ()) -> Path:
    """Write the report of runs side by side.

    Writes ``index.html`` (complete in itself: no other file, no network), ``summary.json`` (the
    runs' summaries, their comparison and the captions), and ``figures/NAME.FORMAT``, the figures
    in the thesis's layout. Each file appears whole or not at all.

    Args:
        runs: at least one.
        directory: made where it does not exist; files of an older report are replaced.
        formats: of the figures, of :data:`FORMATS`.

    Returns:
        Path of the page.

    Raises:
        BadInput: the directory cannot be written.
    """
    outlines = [with_numbers(run) for run in runs]
    found = charts(outlines)
    page = _page(outlines, found)
    try:
        directory.mkdir(parents=True, exist_ok=True)
        _write_figures(found, directory / "figures", formats)
        write_whole(directory / "summary.json", _numbers(outlines, found).encode())
        write_whole(directory / "index.html", page.encode())
    except OSError as error:
        reason = error.strerror or str(error)
        raise BadInput(
            f"cannot write the report to {directory}: {reason}; it takes a directory to write to"
        ) from error
    return directory / "index.html"


def _write_figures(found: Mapping[str, Chart], directory: Path, formats: Sequence[str]) -> None:
    """The figures in these formats; those of an older report go."""
    for name in CAPTIONS:
        for kind in FORMATS:
            (directory / f"{name}.{kind}").unlink(missing_ok=True)
    if not formats:
        return
    from fpt_ros.analysis.printed import encoded  # matplotlib, where it is asked for

    directory.mkdir(exist_ok=True)
    for name, chart in found.items():
        for kind, data in encoded(chart.figure, formats).items():
            write_whole(directory / f"{name}.{kind}", data)


def _numbers(runs: Sequence[Outline], found: Mapping[str, Chart]) -> str:
    summaries = [run.numbers or {} for run in runs]
    rows = [
        {
            "coordinate": row.coordinate or None,
            "quantity": row.quantity,
            "values": row.values,
            "ratios": row.ratios,
        }
        for row in comparison(summaries)
    ]
    figures = {
        name: {"title": chart.title, "caption": chart.caption, "thesis": chart.thesis}
        for name, chart in found.items()
    }
    whole = {
        "runs": summaries,
        "comparison": {"against": baselines(summaries), "rows": rows},
        "figures": figures,
    }
    return json.dumps(whole, indent=2, allow_nan=False, ensure_ascii=False) + "\n"


def _page(runs: Sequence[Outline], found: Mapping[str, Chart]) -> str:
    from fpt_ros.analysis.plots.document import plots  # Bokeh takes half a second

    # a page that can be zoomed needs no excerpt, unless curves of long runs lack points
    thinned = any(run.window is not None for run in runs)
    shown = {n: c for n, c in found.items() if c.panels.linked or thinned}
    drawn = plots({name: chart.panels for name, chart in shown.items()})
    return pages.render(
        TEMPLATE,
        title=_title(runs),
        abouts=[_about(run, label) for run, label in zip(runs, run_labels(runs), strict=True)],
        table=content(runs),
        charts=[(chart, drawn.places[name]) for name, chart in shown.items()],
        library=drawn.library,
        script=drawn.script,
        films=_films(runs),
        labels=run_labels(runs),
        costs=_costs(runs),
        cost_headings=HEADINGS,
        nodes=differences(runs),
        real_time=any(run.latency is not None for run in runs),
        versions=sorted({run.info.get("version", "") for run in runs} - {""}),
    )


def _title(runs: Sequence[Run]) -> str:
    """Titles of the experiments, each once."""
    titles = []
    for run in runs:
        given = signals.parameter(run, "recorder", "title")
        titles.append(str(given or run.info.get("experiment", "") or "run"))
    return " and ".join(dict.fromkeys(titles))


def _films(runs: Sequence[Outline]) -> list[tuple[str, str, str]]:
    """Label, film and still of every run of an arm, for the page."""
    found = [(label, film_of(run)) for run, label in zip(runs, run_labels(runs), strict=True)]
    return [
        (label, base64.b64encode(film.film).decode(), base64.b64encode(film.still).decode())
        for label, film in found
        if film is not None
    ]


def _costs(runs: Sequence[Run]) -> list[tuple[str, list[tuple[str, ...]]]]:
    """Label of every run that tells what its processes took, and the rows of the table."""
    return [
        (label, [row(cost.numbers()) for cost in run.costs])
        for run, label in zip(runs, run_labels(runs), strict=True)
        if run.costs
    ]


def _about(run: Outline, label: str) -> About:
    shows = str(signals.parameter(run, "recorder", "shows") or "")
    thesis = str(signals.parameter(run, "recorder", "thesis") or "")
    one = run.numbers or {}
    complete = bool(one["complete"])
    late = run.latency
    reason = str(one["reason"])
    if complete:
        ending = "complete" + (f" ({reason})" if reason else "")
    else:
        ending = f"not complete, ends at {run.end:g} s: {reason or 'reason not known'}"
    facts = (
        f"{one['cycles']} cycles of {one['dt']} s",
        f"settled from {one['settle_time']:g} s on",
        f"engine {str(one['engine']).replace('_', ' ') or 'not known'}",
        f"seed {one['seed']}",
        *(() if late is None else (f"real time, {late.missed} of {late.cycles} deadlines missed",)),
    )
    sentence = shows[:1].upper() + shows[1:]
    changes = tuple(
        f"{change.stamp / SECOND:g} s: {change.node}."
        + ", ".join(f"{name} = {_value_text(value)}" for name, value in change.values.items())
        for change in run.changes
    )
    whole = sentence.rstrip(".") + "." if sentence else ""
    return About(label, whole, thesis, facts, complete, ending, changes)


def differences(runs: Sequence[Run]) -> dict[str, list[Difference]]:
    """All parameters by node, in the order of the first run, each with its value in every run."""
    result = {}
    for node in dict.fromkeys(node for run in runs for node in run.parameters):
        given = [run.parameters.get(node, {}) for run in runs]
        names = dict.fromkeys(name for parameters in given for name in parameters)
        result[node] = [
            Difference(
                name,
                tuple(_value_text(p[name]) if name in p else "" for p in given),
                any(p.get(name) != given[0].get(name) for p in given),
            )
            for name in names
        ]
    return result


def _value_text(value: Value) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return f"{value:.10g}"
    if isinstance(value, str | int):
        return str(value)
    return "[" + ", ".join(_value_text(item) for item in value) + "]"
