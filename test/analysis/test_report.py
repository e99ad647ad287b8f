import io
import json
import re
import stat
from pathlib import Path

import pytest
from rich.console import Console

from fpt_ros.analysis import whole_files
from fpt_ros.analysis.metrics import summary
from fpt_ros.analysis.report import differences, write_report
from fpt_ros.analysis.tables import console_table, content, number_text, ratio_text
from fpt_ros.errors import BadInput
from fpt_ros.runs.run import Run


@pytest.fixture(scope="module")
def pair(make):
    return [make("tora", "nonadaptive"), make("tora")]


def with_one_figure(run):
    """Little of it: drawing is what takes time."""
    kept = {name: run.topics[name] for name in ("joint_states", "command")}
    return Run(run.info, run.parameters, kept)


@pytest.fixture(scope="module")
def written(pair, tmp_path_factory):
    directory = tmp_path_factory.mktemp("report") / "deep" / "out"
    assert write_report(pair, directory) == directory / "index.html"
    return directory


def test_page_holds_every_figure_but_the_excerpt(written):
    page = (written / "index.html").read_text()
    figures = list(json.loads((written / "summary.json").read_text())["figures"])
    assert len(figures) == 8
    figures.remove("responses_zoom")  # all points are in the page: it can be zoomed
    assert re.findall(r'<figure class="card" id="(\w+)"', page) == figures
    assert page.count('data-root-id="') == len(figures)


def test_figures_for_print_are_made_in_the_formats_that_are_asked_for(make, tmp_path):
    short = [with_one_figure(make("tora", duration=1.0))]
    write_report(short, tmp_path, ("svg", "pdf", "png"))
    begins = {"svg": b"<?xml", "pdf": b"%PDF", "png": b"\x89PNG"}
    names = {path.stem for path in (tmp_path / "figures").iterdir()}
    assert names == {"forces", "uncontrolled"}
    for path in (tmp_path / "figures").iterdir():
        assert path.read_bytes().startswith(begins[path.suffix[1:]])
    write_report(short, tmp_path, ("pdf",))  # what is older does not stay beside it
    assert {path.suffix for path in (tmp_path / "figures").iterdir()} == {".pdf"}


def test_page_says_what_the_runs_show_and_how_they_compare(written):
    page = (written / "index.html").read_text()
    assert "<h1>TORA</h1>" in page
    assert "What the wrong model costs without deformation." in page
    assert "÷30.2" in page
    assert "0.0003169" in page
    assert "Thesis, Fig. 3.22" in page
    assert "prefers-color-scheme: dark" in page
    assert "@media print" in page


def test_only_parameters_that_differ_are_marked(written, pair):
    page = (written / "index.html").read_text()
    marked = re.findall(r'<tr class="differs"><th scope="row"><code>(.*?)</code>', page)
    assert {"transformation", "A", "variant"} <= set(marked)
    assert not {"dt", "exact.m", "approximate.m"} & set(marked)
    rows = {row.name: row for row in differences(pair)["fpt_deformer"]}
    assert rows["transformation"].values == ("none", "sgfpt")
    assert rows["A"].values == ("", "-0.1")
    assert not rows["approximate.m"].differs


def test_summary_file_is_strict_json(written, pair):
    def refuse(word):
        raise AssertionError(word)

    found = json.loads((written / "summary.json").read_text(), parse_constant=refuse)
    performance = [run.pop("performance") for run in found["runs"]]
    assert [run.pop("costs") for run in found["runs"]] == [[], []]
    assert found["runs"] == [summary(run) for run in pair]
    assert set(performance[0]) == {"q1", "q2", "q3"}
    assert performance[0]["q3"]["iae"] > 10 * performance[1]["q3"]["iae"]
    assert found["comparison"]["against"] == [0, 0]
    assert found["comparison"]["rows"][0]["ratios"][1] == pytest.approx(0.0331273, rel=1e-3)


def test_nothing_half_written_is_left_and_files_can_be_read_by_all(written):
    files = [path for path in written.rglob("*") if path.is_file()]
    assert sorted(path.name for path in files) == ["index.html", "summary.json"]
    assert all(stat.S_IMODE(path.stat().st_mode) == 0o644 for path in files)


def test_the_same_runs_give_the_same_files(make, tmp_path):
    short = [with_one_figure(make("tora", duration=1.0))]
    formats = ("svg", "pdf", "png")
    pages = [write_report(short, tmp_path / name, formats) for name in ("first", "second")]
    first, second = (
        # Bokeh counts the objects of a process
        {
            p.relative_to(page.parent): re.sub(rb'"p\d+"', b"", p.read_bytes())
            for p in page.parent.rglob("*.*")
        }
        for page in pages
    )
    assert Path("figures/forces.svg") in first
    assert first == second


def test_text_is_escaped(make, shorten, tmp_path):
    run = shorten(make("tora", duration=1.0), 50)
    evil = "<script>alert(1)</script> $x"
    nodes = {**run.parameters, "recorder": {**run.parameters["recorder"], "title": evil}}
    info = {**run.info, "variant": evil, "reason": evil, "version": evil}
    short = with_one_figure(Run(info, nodes, run.topics))
    page = write_report([short], tmp_path).read_text()
    assert "<script>alert" not in page
    assert "&lt;script&gt;alert(1)&lt;/script&gt; $x" in page
    assert "not complete, ends at 0.049 s: &lt;script&gt;" in page


def test_a_run_without_messages_has_a_page(tmp_path):
    page = write_report([Run({}, {}, {})], tmp_path).read_text()
    assert "There is nothing to draw" in page
    assert json.loads((tmp_path / "summary.json").read_text())["figures"] == {}


def test_a_directory_that_cannot_be_written_is_bad_input(make, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(BadInput, match=r"cannot write the report to .*file") as caught:
        write_report([with_one_figure(make("vdp_rfpt", duration=1.0))], tmp_path / "file")
    assert "\n" not in str(caught.value)
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_a_write_that_fails_leaves_the_old_file(tmp_path, monkeypatch):
    target = tmp_path / "index.html"
    target.write_text("old")

    def fail(*_):
        raise OSError("disk full")

    monkeypatch.setattr(whole_files.os, "replace", fail)
    with pytest.raises(OSError, match="disk full"):
        whole_files.write_whole(target, b"new")
    assert target.read_text() == "old"
    assert list(tmp_path.iterdir()) == [target]


def test_table_is_the_same_from_runs_and_from_summaries(pair):
    from_runs, from_summaries = content(pair), content([summary(run) for run in pair])
    assert [line.cells for line in from_runs.lines] == [line.cells for line in from_summaries.lines]
    assert from_runs.headings == ("nonadaptive", "adaptive")
    assert from_runs.note == "÷ and ×: against nonadaptive"
    assert from_runs.lines[0].quantity == "error, rms settled [m]"
    assert from_summaries.lines[0].quantity == "error, rms settled"
    assert [c.better for c in from_runs.lines[0].cells] == [None, True]
    assert [c.better for c in from_runs.lines[-1].cells] == [None, None]  # chatter is no error


def test_console_table_prints_errors_beside_each_other(pair):
    console = Console(width=100, record=True, file=io.StringIO())
    console.print(console_table(pair))
    text = console.export_text()
    assert re.search(r"q3\s+error, rms settled \[m\]\s+0\.009566\s+0\.0003169\s+÷30\.2", text)


@pytest.mark.parametrize(
    ("ratio", "text"), [(1.0, "×1"), (0.0331, "÷30.2"), (25.31, "×25.3"), (0.0, "×0")]
)
def test_ratios_can_be_pictured(ratio, text):
    assert ratio_text(ratio) == text


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.00031688, "0.0003169"), (3.254e-5, "3.254e-05"), (134.886, "134.9"), (1234.5, "1234")],
)
def test_numbers_keep_four_digits(value, text):
    assert number_text(value) == text
