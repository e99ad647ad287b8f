"""The policy for DDS Security names what the nodes really publish, hear, offer and ask for."""

import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest
import rclpy
from command import forked_fpt

from fpt_ros.cycle.stages import STAGES
from fpt_ros.experiments.experiment import load
from fpt_ros.nodes.fpt_deformer import DeformerNode
from fpt_ros.nodes.plant_node import PlantNode
from fpt_ros.nodes.recorder import Recorder
from fpt_ros.nodes.stage_node import StageNode

POLICY = Path(__file__).parents[2] / "config" / "security" / "policy.xml"
OF_ITS_OWN = {"plant_simulator": PlantNode, "fpt_deformer": DeformerNode, "recorder": Recorder}


def allowed(name, kind, way):
    """Resolved names of ``topics`` or ``services``."""
    profile = ElementTree.parse(POLICY).find(f".//profile[@node='{name}']")
    found = profile.findall(f"{kind}[@{way}='ALLOW']/*")
    return {
        each.text.replace("~", f"/{name}") if "~" in each.text else f"/{each.text}"
        for each in found
    }


@pytest.fixture
def made(tmp_path, monkeypatch):
    """Makes a node, with everything that it may have."""
    experiment = load("cart_beam_hamper").for_graph(realtime=False)
    for node in (*STAGES, "recorder"):
        if node == "plant_simulator":
            experiment = experiment.with_values(node, await_recorder=True)
        else:
            experiment = experiment.with_values(node, ends_with_plant=True)
    experiment = experiment.with_values("recorder", directory=str(tmp_path / "bag"))
    experiment.write(tmp_path / "all.yaml")
    arguments = ["node", "--ros-args", "--params-file", str(tmp_path / "all.yaml")]
    monkeypatch.setattr(sys, "argv", arguments)
    rclpy.init(args=arguments)
    nodes = []

    def make(name):
        nodes.append(OF_ITS_OWN[name]() if name in OF_ITS_OWN else StageNode(STAGES[name]))
        return nodes[-1]

    yield make
    for node in nodes:
        node.destroy_node()
    rclpy.try_shutdown()


@pytest.mark.parametrize("name", [*STAGES, "recorder"])
def test_the_policy_names_what_a_node_does(made, name):
    node = made(name)
    about = (name, "/")
    publishes = {topic for topic, _ in node.get_publisher_names_and_types_by_node(*about)}
    hears = {topic for topic, _ in node.get_subscriber_names_and_types_by_node(*about)}
    offers = {service for service, _ in node.get_service_names_and_types_by_node(*about)}
    assert publishes
    assert publishes == allowed(name, "topics", "publish")
    assert hears <= allowed(name, "topics", "subscribe")
    assert offers == allowed(name, "services", "reply")


def test_without_the_libraries_one_line_says_so(monkeypatch, tmp_path):
    monkeypatch.setenv("ROS_SECURITY_ENABLE", "true")
    monkeypatch.setenv("ROS_SECURITY_STRATEGY", "Enforce")
    monkeypatch.setenv("ROS_SECURITY_KEYSTORE", str(tmp_path))
    done = forked_fpt("run", "siso_affine")
    assert done.returncode == 2
    assert "SECURITY ERROR" in done.stderr
    assert "Traceback" not in done.stderr
