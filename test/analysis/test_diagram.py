"""The drawn loop: what runs is there, and nothing lies outside or upon another."""

from xml.etree import ElementTree

import pytest

from fpt_ros.analysis.diagram import svg
from fpt_ros.cli.app import run_command
from fpt_ros.experiments.experiment import available, load

SVG = "{http://www.w3.org/2000/svg}"

SPOILT = (
    "plant_simulator.sensors.kinds=[lost, quantised]",
    "plant_simulator.actuators.kinds=[lag]",
    "plant_simulator.measurement_delay=3",
    "fpt_deformer.sensor_delay=3",
)


def drawn(name, variant="adaptive", settings=()):
    root = ElementTree.fromstring(svg(load(name, variant, settings)))
    texts = [each.text for each in root.iter(f"{SVG}text")]
    boxes = [
        tuple(float(each.get(k)) for k in ("x", "y", "width", "height"))
        for each in root.iter(f"{SVG}rect")
        if each.get("x")
    ]
    size = tuple(float(x) for x in root.get("viewBox").split()[2:])
    return texts, boxes, size


@pytest.mark.parametrize("name", sorted(available()))
def test_every_experiment_is_drawn_within_its_picture(name):
    texts, boxes, (width, height) = drawn(name)
    assert {"nominal motion", "error relaxation", "approximate model", "exact plant"} <= set(texts)
    for x, y, w, h in boxes:
        assert 0 <= x <= x + w <= width
        assert 0 <= y <= y + h <= height
    for i, (x, y, w, h) in enumerate(boxes):
        for a, b, c, d in boxes[i + 1 :]:
            assert x + w <= a or a + c <= x or y + h <= b or b + d <= y


def test_laws_delays_and_units_are_named():
    texts, _, _ = drawn("tora", settings=SPOILT)
    for text in ("sgfpt", "lost", "quantised", "late by 3 cycles", "lag", "spline", "A = -0.1"):
        assert text in texts
    assert any("rad" in text and "m" in text for text in texts if text.startswith("q^N"))
    assert "tuner" not in texts
    assert "deformation" not in drawn("tora", "nonadaptive")[0]
    assert "gram_schmidt: coefficients" in drawn("cart_beam_hamper")[0]


def test_the_command_writes_a_file_or_says_why_not(tmp_path, capsys):
    assert run_command(["diagram", "tora", "--out", str(tmp_path / "a" / "tora.svg")]) == 0
    assert (tmp_path / "a" / "tora.svg").read_text().startswith("<svg")
    assert run_command(["diagram", "tora", "--out", str(tmp_path / "tora.pdf")]) == 2
    assert "ends with .svg" in capsys.readouterr().err
