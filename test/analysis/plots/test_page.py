"""The page of a report in a real browser: it draws, zooms, hides and asks nobody for anything."""

from dataclasses import replace

import numpy as np
import pytest
import samples
from browser import browser

from fpt_ros.analysis.outline import Outliner, with_numbers
from fpt_ros.analysis.report import write_report
from fpt_ros.runs.changes import Change
from fpt_ros.runs.run import Run, Series

LONG = 1_000_000

WINDOW = "Bokeh.documents[0].get_model_by_name('window')"
READY = "window.Bokeh && Bokeh.documents.length && Bokeh.documents[0].is_idle"


def lines_of(page, figure):
    """Curves of a figure that are drawn now: (name, x, y)."""
    found = page.run(f"""{plots_of(figure)}.flatMap((plot) => plot.renderers)
      .filter((line) => line.glyph.type === 'Line')
      .map((line) => [line.name, line.data_source.data])
      .map(([name, data]) => [name, [...data.x], [...data.y]])""")
    return [(name, np.array(x), np.array(y)) for name, x, y in found]


def plots_of(figure):
    return f"{root_of(figure)}.children.map((child) => child[0])"


def root_of(figure):
    return (
        f"Bokeh.documents[0].get_model_by_id(document.querySelector('#{figure} "
        "[data-root-id]').dataset.rootId)"
    )


def go_to(page, figure):
    """Scroll to a figure, and wait until it shows the window."""
    page.run(f"document.querySelector('#{figure}').scrollIntoView()")
    page.wait_for(f"{root_of(figure)}.seen && !{root_of(figure)}.stale")
    page.wait_for("Bokeh.documents[0].is_idle")


def ink(page, figure):
    """Pixels of a figure's plots that are not white."""
    return page.run(f"""(() => {{
      let count = 0;
      const look = (node) => {{
        [...node.children].forEach(look);
        if (node.shadowRoot) look(node.shadowRoot);
        if (node.nodeName !== 'CANVAS' || !node.width) return;
        const pixels = node.getContext('2d').getImageData(0, 0, node.width, node.height).data;
        for (let i = 0; i < pixels.length; i += 4)
          if (pixels[i + 3] > 0 && pixels[i] + pixels[i + 1] + pixels[i + 2] < 720) count++;
      }};
      look(document.querySelector('#{figure}'));
      return count;
    }})()""")


@pytest.fixture(scope="module")
def page(make, tmp_path_factory):
    """Two runs, one with a change in flight whose text could be taken for a tag."""
    folder = tmp_path_factory.mktemp("page")
    changed = (Change("fpt_deformer", 1_000_000_000, {"A": -2.0, "form": "</script><b>"}),)
    runs = [make("tora", "nonadaptive", 4.0), replace(make("tora", duration=4.0), changes=changed)]
    path = write_report(runs, folder)
    with browser(folder / "browser") as opened:
        opened.open(path)
        opened.wait_for(READY)
        yield opened


def test_every_figure_is_drawn_and_nothing_is_wrong(page):
    figures = page.run("[...document.querySelectorAll('figure')].map((f) => f.id)")
    assert len(figures) == 7
    for figure in figures:
        go_to(page, figure)
        assert ink(page, figure) > 2000
        assert all(len(x) > 100 for _, x, _ in lines_of(page, figure))
    assert page.problems == []
    assert [each for each in page.requests if not each.startswith(("file:", "data:"))] == []


def test_dragging_zooms_in_time_in_all_figures_and_y_follows(page, make):
    go_to(page, "tracking_error")
    box = page.run(
        "(() => { const b = document.querySelector('#tracking_error .paper')"
        ".getBoundingClientRect(); return [b.x, b.y, b.width, b.height] })()"
    )
    left, top, width, _ = box
    page.drag((left + 0.2 * width, top + 130), (left + 0.3 * width, top + 130))
    page.wait_for(f"{WINDOW}.end < 3.9")
    first, last = page.run(f"[{WINDOW}.start, {WINDOW}.end]")
    assert 0.0 < first < last < 4.0
    page.wait_for(f"!{root_of('tracking_error')}.stale")
    for figure in ("tracking_error", "responses", "phase_trajectories"):
        go_to(page, figure)
        for _, x, y in lines_of(page, figure):
            assert len(x) == len(y)
            if figure != "phase_trajectories":
                assert first - 0.0011 <= x[0] < x[-1] <= last + 0.0011
            assert abs(len(x) - (last - first) / 1e-3) < 3
    # the y axis shows no more than what is there
    go_to(page, "tracking_error")
    drawn = [y for _, _, y in lines_of(page, "tracking_error")]
    spans = page.run(f"{plots_of('tracking_error')}.map((p) => [p.y_range.start, p.y_range.end])")
    for at, (low, high) in enumerate(spans):
        both = np.concatenate(drawn[at // 2 * 2 : at // 2 * 2 + 2])  # runs share their scale
        assert low < both.min() < both.max() < high
        assert high - low < 1.2 * np.ptp(both)
    for _ in range(2):
        page.click((left + 0.3 * width, top + 130))
    page.wait_for(f"{WINDOW}.start === 0 && {WINDOW}.end > 3.9")


def test_a_legend_hides_a_kind_of_curve(page):
    go_to(page, "responses")
    legend = f"{plots_of('responses')}.flatMap((p) => p.above).filter((m) => m.type === 'Legend')"
    assert page.run(f"{legend}.map((m) => m.items.length)") == [3, 4]  # one was changed in flight
    assert set(page.run(f"{legend}.map((m) => m.click_policy)")) == {"hide"}
    names = page.run(f"{legend}[1].items.map((i) => i.label.value)")
    assert names == ["changed in flight", "desired", "realised", "deformed"]
    column = f"[{plots_of('responses')}[1], {plots_of('responses')}[3]]"
    hidden = f"{column}.map((p) => p.renderers.filter((r) => !r.visible).map((r) => r.name))"
    entry = page.run(f"""(() => {{
      const items = Bokeh.index.find_one({legend}[1]).shadow_el.querySelectorAll('.bk-item');
      const box = items[3].getBoundingClientRect();
      return [box.x + box.width / 2, box.y + box.height / 2];
    }})()""")
    page.click(entry)
    page.wait_for(f"{hidden}.flat().length > 0")
    assert page.run(hidden) == [["deformed"], ["deformed"]]


def test_what_a_recording_says_is_no_markup(page):
    assert page.run("document.querySelectorAll('figure b, .changes b').length") == 0
    assert "form = </script><b>" in page.run("document.querySelector('.changes').innerText")


def test_a_page_is_not_larger_than_it_may_be_and_keeps_peaks(tmp_path):
    """A million cycles, or a tenth of it; one cycle stands out."""
    count = LONG if samples.whole else LONG // 10
    path, peak = long_page(tmp_path, count)
    assert path.stat().st_size < 30e6
    with browser(tmp_path / "browser") as page:
        page.open(path)
        page.wait_for(READY)
        go_to(page, "tracking_error")
        (_, x, y), *_ = lines_of(page, "tracking_error")
        assert len(x) < 4000
        assert np.abs(y).max() == pytest.approx(5.0, abs=0.01)
        assert x[np.argmax(np.abs(y))] == pytest.approx(peak)
        page.run(f"{WINDOW}.setv({{start: {peak - 1.0}, end: {peak + 1.0}}})")
        page.wait_for(f"!{root_of('tracking_error')}.stale")
        (_, x, y), *_ = lines_of(page, "tracking_error")
        assert peak - 2.0 < x[0] < x[-1] < peak + 2.0
        assert np.abs(y).max() == pytest.approx(5.0, abs=0.01)
        assert page.problems == []


def long_page(folder, count):
    """Page of a made run of so many cycles, and the time of its peak."""
    stamps = 1_000_000 * np.arange(count, dtype=np.int64)
    time = stamps / 1e9
    rng = np.random.default_rng(1)
    names = ("q1", "q2", "q3")
    noise = 1e-3 * rng.standard_normal((count, 3))
    nominal = np.sin(time)[:, None] * np.ones(3)
    position = nominal + noise
    at = count * 7 // 10
    position[at, 0] += 5.0

    def series(**columns):
        return Series(stamps, names, columns)

    topics = {
        "joint_states": series(position=position, velocity=nominal, effort=noise),
        "state_estimate": series(positions=nominal, velocities=nominal, accelerations=noise),
        "desired": series(positions=nominal, velocities=nominal, accelerations=noise),
        "command": series(accelerations=noise, effort=noise),
    }
    parameters = {"recorder": {"settle_time": 1.0}, "plant_simulator": {"dt": 0.001}}
    run = Run({"complete": "true", "experiment": "made"}, parameters, topics)
    outliner = Outliner(parameters, 131_072)
    outliner.take(topics)
    numbers = with_numbers(Run(run.info, parameters, {})).numbers
    return write_report([outliner.result(run, numbers)], folder), time[at]
