"""Layouts name only what is recorded, with units, and are those that ``fpt layout`` makes today."""

import json
import re
from pathlib import Path
from xml.etree import ElementTree

import pytest

from fpt_ros.bags import numbers
from fpt_ros.bags.bag import Bag
from fpt_ros.bags.flat import write_flat
from fpt_ros.bags.reader import read_run
from fpt_ros.errors import BadInput
from fpt_ros.experiments.experiment import load
from fpt_ros.viewers import PROGRAMS
from fpt_ros.viewers.panels import pages

ROOT = Path(__file__).parents[2]
LAYOUTS = ROOT / "layouts"
NAMES = ("tora", "panda")
UNIT = re.compile(r" \[[\w/^ ]+\]$")


def messages(path):
    """Of each topic one layout, the same in all messages."""
    found = {}
    for source, reading in numbers.read(Bag(path), lambda source: True).items():
        found[source.topic] = reading.parts
    return found


@pytest.mark.parametrize("name", NAMES)
def test_foxglove(name):
    layout = json.loads((LAYOUTS / f"foxglove_{name}.json").read_text())
    recorded = messages(ROOT / "bags" / name)
    plots = {key: plot for key, plot in layout["configById"].items() if key.startswith("Plot!")}
    shown = [path for plot in plots.values() for path in plot["paths"]]
    assert len(shown) == 7 * (2 if name == "tora" else 7)
    for path in shown:
        topic, field, element = re.fullmatch(r"([\w/]+)\.(.+)\[(\d+)\]", path["value"]).groups()
        (part,) = recorded[topic]
        assert int(element) < part.numbers[field].shape[1], path["value"]
        # the label says whose number it is
        joint = re.search(r" of (\w+) ", path["label"])[1]
        word = "joint_names" if topic != "/joint_states" else "name"
        assert part.layout.texts[f"{word}[{element}]"] == joint
    labels = [path["label"] for path in shown]
    assert all(UNIT.search(label) for label in labels), labels
    tabs = json.dumps(layout["configById"]["Tab!pages"])
    assert all(f'"{key}"' in tabs for key in plots)


@pytest.mark.parametrize("name", NAMES)
def test_plotjuggler(name, tmp_path):
    write_flat(ROOT / "bags" / name, tmp_path / "flat.mcap")
    recorded = messages(tmp_path / "flat.mcap")
    root = ElementTree.parse(LAYOUTS / f"plotjuggler_{name}.xml").getroot()
    curves = [curve.get("name") for curve in root.iter("curve")]
    assert len(curves) == 7 * (2 if name == "tora" else 7)
    for curve in curves:
        topic, joint, field = curve.rsplit("/", 2)
        (part,) = recorded[topic]
        names = [text for path, text in part.layout.texts.items() if path.startswith("name[")]
        assert part.numbers[field].shape[1] == len(names), curve
        assert joint in names, curve
    for splitter in root.iter("DockSplitter"):
        assert int(splitter.get("count")) == len(splitter) == len(splitter.get("sizes").split(";"))
    assert all(UNIT.search(area.get("name")) for area in root.iter("DockArea"))


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("program", PROGRAMS)
def test_they_are_those_that_the_command_makes(name, program):
    text, ending = PROGRAMS[program]
    expected = text(pages(read_run(ROOT / "bags" / name)))
    assert (LAYOUTS / f"{program}_{name}{ending}").read_text() == expected


def of(name, joint, hand_made, **topics):
    """A run of an experiment's parameters, of one cycle."""
    names = {topic: [joint] for topic in ("joint_states", "state_estimate", "desired", "command")}
    found = {topic: ([0.0], each, {}) for topic, each in {**names, **topics}.items()}
    return hand_made(found, load(name).nodes, namespace="/robot1")


def test_what_is_tuned_has_a_page_and_the_unit_is_the_plants(hand_made):
    found = pages(of("vdp_rfpt", "q1", hand_made, tuning=["a", "b"]))
    assert [page.title for page in found] == ["q1", "tuning"]
    curve = found[0].panels[1].curves[0]
    assert curve.label == "desired response of q1 [1/s^2]"
    assert (curve.topic, curve.field) == ("/robot1/desired", "points[0].accelerations")
    assert [panel.curves[0].element for panel in found[1].panels] == [0, 1]


def test_turns_have_no_layout(hand_made):
    with pytest.raises(BadInput, match="the coordinates take turns"):
        pages(of("swing", "q1", hand_made))
