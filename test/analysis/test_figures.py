from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from samples import sample

from fpt_ros.analysis import decimate, style
from fpt_ros.analysis.captions import CAPTIONS
from fpt_ros.analysis.figures import charts
from fpt_ros.analysis.labels import labels_of
from fpt_ros.runs.changes import Change
from fpt_ros.runs.latency import EDGES, Latencies
from fpt_ros.runs.run import Run, Series

TORA = ["tracking", "tracking_error", "errors_together", "phase_trajectories", "responses"]
TORA += ["responses_zoom", "forces", "uncontrolled"]


def visible(chart):
    return [axes for axes in chart.figure.axes if axes.axison]


def test_tora_side_by_side_has_the_figures_of_the_thesis(make):
    found = charts([make("tora", "nonadaptive"), make("tora")])
    assert list(found) == TORA
    numbers = [found[name].thesis for name in TORA]
    assert numbers == [
        "Fig. 3.21",
        "Fig. 3.22",
        "",
        "Fig. 3.23",
        "Fig. 3.24",
        "Fig. 3.25",
        "",
        "Fig. 3.26",
    ]
    assert charts([make("tora", "strong", 2.0)])["responses_zoom"].thesis == "Fig. 3.27"


def test_columns_share_the_scale_of_a_row(make):
    found = charts([make("tora", "nonadaptive"), make("tora")])
    del found["errors_together"]  # all runs are in one column there
    for chart in found.values():
        axes = visible(chart)
        for left, right in zip(axes[::2], axes[1::2], strict=True):
            assert left.get_ylim() == right.get_ylim()


def test_units_stand_in_the_labels(make):
    found = charts([make("tora", duration=1.0)])
    labels = {n: [a.get_ylabel() for a in visible(c)] for n, c in found.items()}
    assert labels["tracking"] == ["$q_{3}$ [m]", "$q_{2}$ [rad]"]
    assert labels["responses"][1].endswith("[rad/s²]")
    assert labels["forces"] == ["$Q_{1}$ [N m]", "$Q_{2}$ [N m]"]  # Q3 is zero by construction
    vdp = charts([make("vdp_rfpt", duration=1.0)])
    assert visible(vdp["tracking"])[0].get_ylabel() == "$q_{1}$"


def test_transient_leaves_the_scale_of_the_responses_and_the_caption_says_so(make):
    chart = charts([make("tora")])["responses"]
    low, high = visible(chart)[0].get_ylim()
    assert -4.0 < low < -2.8
    assert 2.8 < high < 4.0
    assert "10.3 (q3)" in chart.caption


def test_excerpt_is_half_a_period_about_the_settle_time(make):
    line = visible(charts([make("tora")])["responses_zoom"])[0].lines[0]
    times = line.get_xdata()
    assert times[0] == pytest.approx(3.0, abs=0.01)
    assert times[-1] == pytest.approx(5.0, abs=0.01)


def test_realised_response_is_drawn_at_the_cycle_of_its_command(make):
    run = make("tora", duration=1.0)
    line = visible(charts([run])["responses"])[0].lines[1]
    expected = run.topics["state_estimate"].column("accelerations", "q3")[1:]
    assert line.get_xdata()[0] == 0.0
    assert line.get_ydata() == pytest.approx(expected)


def test_tuned_parameters_stand_beside_their_exact_values(make):
    chart = charts([make("vdp_rfpt", duration=2.0)])["parameters"]
    found = {}
    for axes in visible(chart):
        exact = [line for line in axes.lines if len(set(line.get_xdata())) == 2]
        found[axes.get_ylabel()] = exact[0].get_ydata()[0] if exact else None
    coefficients = {"m": 10.0, "mu": 1.0, "mu_c": 3.0, "k": 100.0, "beta": 1.0, "lambda": 2.0}
    assert found == {**coefficients, "precursor": None}
    assert chart.thesis == "Fig. 2.11"


def test_only_runs_with_a_tuner_have_a_column_of_parameters(make):
    runs = [make("vdp_rfpt", "fixed_model", 1.0), make("vdp_rfpt", duration=1.0)]
    # six coefficients and the precursor; a guard's factor only where there is one
    assert len(visible(charts(runs)["parameters"])) == 7
    assert "parameters" not in charts(runs[:1])


def test_a_run_that_the_common_scale_would_flatten_has_a_finer_one_and_says_so(make):
    chart = charts([make("vdp_rfpt", "no_rfpt"), make("vdp_rfpt")])["tracking_error"]
    lost, kept = visible(chart)
    assert lost.get_ylim()[1] > 20 * kept.get_ylim()[1]
    assert "finer scale" in kept.get_title(loc="right")
    assert "finer scale" not in lost.get_title(loc="right")
    assert "flatten" in chart.caption


def test_different_experiments_stand_in_rows_of_their_own(make):
    chart = charts([make("tora", duration=1.0), make("vdp_rfpt", duration=1.0)])["tracking"]
    assert len(chart.figure.axes) == 6
    assert len(visible(chart)) == 3
    assert chart.thesis == "tora: Fig. 3.21"  # the thesis has none of van der Pol


@pytest.mark.parametrize(
    ("name", "cycles"),
    sample(
        [*product(("tora", "vdp_rfpt"), (0, 1, 2, 3, 10))],
        4,
        keep=[("tora", 0), ("vdp_rfpt", 1), ("tora", 2)],
    ),
)
def test_runs_cut_after_a_few_cycles_are_drawn(make, shorten, name, cycles):
    run = make(name, duration=1.0)
    short = shorten(run, cycles)
    assert ("tracking" in charts([short])) == (cycles > 0)
    assert "tracking" in charts([short, run, short, run])


def test_nothing_is_drawn_of_nothing():
    assert charts([Run({}, {}, {})]) == {}
    assert charts([]) == {}


def test_topics_of_different_lengths_are_drawn(make):
    run = make("vdp_rfpt", duration=1.0)
    topics = dict(run.topics)
    for name, count in (("command", 400), ("state_estimate", 0), ("tuning", 1)):
        series = topics[name]
        vectors = {key: vector[:count] for key, vector in series.vectors.items()}
        topics[name] = Series(series.stamps[:count], series.names, vectors)
    assert "responses" in charts([Run(run.info, run.parameters, topics)])


def test_captions_exist_for_every_figure_and_every_figure_has_its_name(make):
    counts = [0] * (len(EDGES) + 1)
    counts[9] = 3
    timed = replace(make("tora", duration=1.0), latency=Latencies(tuple(counts), 1e-5, 0, 4))
    found = charts([make("vdp_rfpt", duration=1.0), timed])
    found |= charts([make("noisy_tora", duration=1.0), make("noisy_tora", "raw", 1.0)])
    assert set(found) == set(CAPTIONS)
    assert all(chart.name == name and chart.caption for name, chart in found.items())


def test_changes_in_flight_are_marked_where_they_are_in_the_figure(make):
    changes = tuple(Change("fpt_deformer", round(t * 1e9), {"A": -2.0}) for t in (0.25, 0.75))
    found = charts([replace(make("tora", duration=1.0), changes=changes)])
    for name in ("tracking", "forces", "responses"):
        for axes in visible(found[name]):
            marks = [line for line in axes.lines if line.get_color() == style.CHANGE["color"]]
            assert [line.get_xdata()[0] for line in marks] == [0.25, 0.75]
    zoom = visible(found["responses_zoom"])[0]
    assert zoom.get_xlim()[0] > 0.25
    assert found["forces"].panels.legend[-1].label == "changed in flight"


def test_errors_of_runs_of_one_plant_stand_on_top_of_each_other(make):
    one, two = make("tora", "nonadaptive", 1.0), make("tora", duration=1.0)
    panel = charts([one, two])["errors_together"].panels.taken["q3", 0]
    assert [curve.label for curve in panel.curves] == ["nonadaptive", "adaptive"]
    assert panel.curves[0].style["color"] != panel.curves[1].style["color"]
    assert "errors_together" not in charts([one])
    assert "errors_together" not in charts([one, make("vdp_rfpt", duration=1.0)])


def test_labels_can_be_spoken():
    assert style.spoken(style.label(style.symbol("q12"), "m")) == "q₁₂ [m]"
    assert style.spoken(r"$q_{3}$$^{\,N}-\,$$q_{3}$") == "q₃ᴺ − q₃"
    assert style.spoken(style.symbol("a$b_c")) == "a$b_c"


def test_labels_tell_runs_apart():
    assert labels_of([("tora", "adaptive")]) == ["tora · adaptive"]
    assert labels_of([("tora", "adaptive"), ("tora", "strong")]) == ["adaptive", "strong"]
    assert labels_of([("tora", "a"), ("swing", "a")]) == ["tora · a", "swing · a"]
    assert labels_of([("tora", "a"), ("tora", "a")]) == ["a (1)", "a (2)"]


def test_decimation_keeps_extremes_and_ends():
    rng = np.random.default_rng(1)
    signal = rng.standard_normal(100_000)
    signal[31_415] = 50.0
    signal[92_653] = -50.0
    kept = decimate.keep(signal, limit=1000)
    assert len(kept) <= 1100
    assert {0, 31_415, 92_653, 99_999} <= set(kept.tolist())
    assert np.all(np.diff(kept) > 0)


def test_decimation_keeps_chatter_as_wide_as_it_is():
    count = 50_000
    envelope = np.linspace(1.0, 2.0, count)
    signal = envelope * (-1.0) ** np.arange(count)
    shown = signal[decimate.keep(signal, limit=500)]
    assert shown.max() == pytest.approx(2.0, rel=1e-3)
    assert np.mean(np.abs(shown)) > 1.4
    assert abs(np.mean(np.sign(shown))) < 0.1


def test_decimation_keeps_gaps():
    signal = np.sin(np.linspace(0.0, 60.0, 40_000))
    signal[20_000:20_003] = np.nan
    kept = decimate.keep(signal, limit=900)
    assert np.isnan(signal[kept]).any()
    assert len(kept) < 1100
    assert len(decimate.keep(np.full(10_000, np.nan), limit=100)) <= 150


def test_decimation_leaves_short_curves_alone():
    assert decimate.keep(np.zeros(5)).tolist() == [0, 1, 2, 3, 4]
    assert decimate.keep(np.zeros(0)).tolist() == []
    assert decimate.keep_path(np.zeros(0), np.zeros(0)).tolist() == []


def test_a_decimated_path_stays_round_where_it_is_fast():
    time = np.linspace(0.0, 1.0, 100_000)
    angle = 2 * np.pi * np.clip(50 * time, 0.0, 1.0)  # a circle in a fiftieth of the time
    x, y = np.cos(angle), np.sin(angle)
    kept = decimate.keep_path(x, y, limit=1000)
    assert len(kept) <= 1100
    assert np.max(np.hypot(np.diff(x[kept]), np.diff(y[kept]))) < 0.05
    assert len(decimate.keep_path(np.zeros(9000), np.zeros(9000), limit=100)) <= 110


def test_robust_span_leaves_out_rare_spikes_only():
    curve = np.sin(np.linspace(0.0, 100.0, 10_000))
    curve[7] = 1e6
    low, high = style.span([curve], robust=True)
    assert -1.7 < low < -1.0
    assert 1.0 < high < 1.7
    assert style.span([curve])[1] > 1e6
    assert style.span([np.full(3, np.nan), np.array([np.inf])]) is None
    low, high = style.span([np.array([2.0, 2.0])])
    assert low < 2.0 < high


def test_names_are_no_mathematics_unless_they_are_coordinates():
    assert style.symbol("q2") == "$q_{2}$"
    assert style.symbol("q2", force=True) == "$Q_{2}$"
    assert style.symbol("v") == "$v$"
    assert style.symbol("a$b_c") == r"a\$b_c"
