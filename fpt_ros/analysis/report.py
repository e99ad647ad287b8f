"""The report: one page that holds everything, and the figures and numbers beside it."""

import base64
import io
import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from fpt_ros.analysis import pages, signals, style
from fpt_ros.analysis.comparison import baselines, comparison
from fpt_ros.analysis.figures import Chart, charts
from fpt_ros.analysis.labels import run_labels
from fpt_ros.analysis.outline import Outline, with_numbers
from fpt_ros.analysis.tables import content
from fpt_ros.analysis.whole_files import write_whole
from fpt_ros.errors import BadInput
from fpt_ros.parameters import Value
from fpt_ros.runs.run import Run

TEMPLATE = "report.html.j2"


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


def write_report(runs: Sequence[Run], directory: Path) -> Path:
    """Write the report of runs side by side.

    Writes ``index.html`` (complete in itself: no other file, no network), ``figures/NAME.svg`` and
    ``figures/NAME.png`` (150 dpi), and ``summary.json`` (the runs' summaries, their comparison and
    the captions). Each file appears whole or not at all.

    Args:
        runs: at least one.
        directory: made where it does not exist; files of an older report are replaced.

    Returns:
        Path of the page.

    Raises:
        BadInput: the directory cannot be written.
    """
    outlines = [with_numbers(run) for run in runs]
    found = charts(outlines)
    pictures = {name: _rendered(chart, "svg") for name, chart in found.items()}
    page = _page(outlines, found, pictures)
    try:
        (directory / "figures").mkdir(parents=True, exist_ok=True)
        for name, chart in found.items():
            write_whole(directory / "figures" / f"{name}.svg", pictures[name])
            write_whole(directory / "figures" / f"{name}.png", _rendered(chart, "png"))
        write_whole(directory / "summary.json", _numbers(outlines, found).encode())
        write_whole(directory / "index.html", page.encode())
    except OSError as error:
        reason = error.strerror or str(error)
        raise BadInput(
            f"cannot write the report to {directory}: {reason}; it takes a directory to write to"
        ) from error
    return directory / "index.html"


def _rendered(chart: Chart, kind: str) -> bytes:
    buffer = io.BytesIO()
    # no date: the same runs give the same file
    metadata = {"Date": None} if kind == "svg" else {}
    with style.settings():
        chart.figure.savefig(buffer, format=kind, metadata=metadata)
    return buffer.getvalue()


def _numbers(runs: Sequence[Outline], found: dict[str, Chart]) -> str:
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


def _page(runs: Sequence[Outline], found: dict[str, Chart], pictures: dict[str, bytes]) -> str:
    encoded = {name: base64.b64encode(data).decode() for name, data in pictures.items()}
    return pages.render(
        TEMPLATE,
        title=_title(runs),
        abouts=[_about(run, label) for run, label in zip(runs, run_labels(runs), strict=True)],
        table=content(runs),
        charts=[(chart, encoded[name]) for name, chart in found.items()],
        labels=run_labels(runs),
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
    return About(
        label, sentence.rstrip(".") + "." if sentence else "", thesis, facts, complete, ending
    )


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
