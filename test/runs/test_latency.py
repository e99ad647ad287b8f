"""Latency from sensor to command: its counts, what is worked out from them, and its figure."""

import json
from dataclasses import replace

import numpy as np
import pytest

from fpt_ros.analysis.comparison import comparison
from fpt_ros.analysis.figures import charts
from fpt_ros.analysis.metrics import summary
from fpt_ros.analysis.report import write_report
from fpt_ros.analysis.tables import content
from fpt_ros.errors import BadInput
from fpt_ros.runs.latency import EDGES, PER_DECADE, Histogram, Latencies, parse

BIN = 10.0 ** (1.0 / PER_DECADE)


def counted(latencies, missed=0, cycles=None):
    histogram = Histogram()
    for each in latencies:
        histogram.add(float(each))
    counts = tuple(histogram.counts)
    return Latencies(counts, histogram.largest, missed, cycles or len(latencies))


@pytest.fixture
def timed(make):
    """A run of TORA whose plant has told its latencies: a log-normal bulk and a tail."""
    rng = np.random.default_rng(4)
    latencies = np.concatenate(
        (3e-4 * np.exp(0.2 * rng.standard_normal(980)), rng.uniform(2e-3, 4e-3, 20))
    )
    return replace(make("tora", duration=1.0), latency=counted(latencies, 21, 1001)), latencies


def test_quantiles_are_those_of_the_numbers_to_a_bin():
    rng = np.random.default_rng(1)
    latencies = 5e-4 * np.exp(rng.standard_normal(20_000))
    found = counted(latencies)
    assert found.total == 20_000
    for share in (0.01, 0.5, 0.9, 0.99, 1.0):
        assert found.quantile(share) == pytest.approx(np.quantile(latencies, share), rel=BIN - 1)
    assert found.quantile(1.0) == found.largest == latencies.max()


def test_every_latency_has_a_bin_that_holds_it():
    for latency in (0.0, 1e-9, EDGES[0], 3.3e-4, EDGES[-1], 60.0):
        histogram = Histogram()
        histogram.add(latency)
        (at,) = np.flatnonzero(histogram.counts)
        assert at == 0 or EDGES[at - 1] <= latency
        assert at == len(EDGES) or latency < EDGES[at]


def test_of_nothing_there_are_no_quantiles(make):
    assert np.isnan(counted([]).quantile(0.5))
    run = replace(make("tora", duration=1.0), latency=counted([], 7, 7))
    found = summary(run)["real_time"]
    assert found == {
        "cycles": 7, "missed_deadlines": 7,
        "latency_median_ms": None, "latency_p99_ms": None, "latency_max_ms": None,
    }  # fmt: skip
    assert "latency" not in charts([run])


def test_the_text_of_the_counts_is_read_again():
    histogram = Histogram()
    for at, edge in enumerate((0.0, *EDGES)):
        for _ in range(at % 4):
            histogram.add(edge * (1.0 + 1e-9))
    assert parse(histogram.text()) == tuple(histogram.counts)
    assert parse("") == (0,) * (len(EDGES) + 1)


@pytest.mark.parametrize("text", ["x", "0.3", "0.3:x", "-1:2", "1e9:3", "nan:1", "0.3:1.5"])
def test_other_text_is_refused(text):
    with pytest.raises(BadInput, match="is no bin of latencies"):
        parse(text)


def test_metrics_and_table(timed, make):
    run, latencies = timed
    found = summary(run)["real_time"]
    assert (found["cycles"], found["missed_deadlines"]) == (1001, 21)
    assert found["latency_median_ms"] == pytest.approx(1e3 * np.median(latencies), rel=BIN - 1)
    assert found["latency_p99_ms"] == pytest.approx(1e3 * np.quantile(latencies, 0.99), rel=BIN - 1)
    assert found["latency_max_ms"] == pytest.approx(1e3 * latencies.max())
    lockstep = make("tora", duration=1.0)
    assert summary(lockstep)["real_time"] is None
    rows = {row.quantity: row for row in comparison([summary(lockstep), summary(run)])}
    assert rows["missed_deadlines"].values == (None, 21)
    assert rows["latency_p99_ms"].ratios == (None, None)
    lines = {line.quantity: line for line in content([lockstep, run]).lines}
    assert [cell.value for cell in lines["missed deadlines"].cells] == ["", "21"]
    assert "missed deadlines" not in {line.quantity for line in content([lockstep]).lines}


def test_the_figure_marks_median_p99_and_deadline(timed):
    run, _ = timed
    chart = charts([run])["latency"]
    (axes,) = [each for each in chart.figure.axes if each.axison]
    assert axes.get_xscale() == axes.get_yscale() == "log"
    assert "21 of 1001 deadlines missed" in axes.get_title(loc="right")
    marked = [line.get_xdata()[0] for line in axes.get_lines()]
    late = run.latency
    assert marked == pytest.approx([1e3 * late.quantile(0.5), 1e3 * late.quantile(0.99), 1.0])
    (bars,) = axes.patches
    values, edges, _ = bars.get_data()
    assert sum(values) == late.total
    low, high = axes.get_xlim()
    assert low < edges[0] < edges[-1] < high
    assert low < 1.0 < high


def test_the_report_of_a_run_in_real_time(timed, make, tmp_path):
    run, _ = timed
    page = write_report([run], tmp_path / "one").read_text()
    assert 'id="latency"' in page
    assert "real time, 21 of 1001 deadlines missed" in page
    found = json.loads((tmp_path / "one" / "summary.json").read_text())
    assert found["runs"][0]["real_time"]["missed_deadlines"] == 21
    page = write_report([make("tora", duration=1.0)], tmp_path / "two").read_text()
    assert 'id="latency"' not in page
    assert "Missed deadline" not in page
