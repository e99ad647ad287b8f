"""The nodes of the loop as managed nodes: what ``ros2 lifecycle`` asks for, over its services."""

import numpy as np
from command import forked_fpt, forked_fpt_json, start_fpt
from lifecycle_msgs.msg import Transition, TransitionEvent
from lifecycle_msgs.srv import ChangeState, GetState
from watcher import watcher

from fpt_ros.bags.reader import read_run
from fpt_ros.cycle.stages import STAGES

PLANT, DEFORMER, TRAJECTORY = "plant_simulator", "fpt_deformer", "trajectory_generator"
CYCLE = 1_000_000


def state(graph, node):
    return graph.call(GetState, f"/{node}/get_state", GetState.Request()).current_state.label


def change(graph, node, label):
    request = ChangeState.Request(transition=Transition(label=label))
    return graph.call(ChangeState, f"/{node}/change_state", request).success


def test_states_pauses_and_the_safe_effort(tmp_path):
    process = start_fpt(
        "run", "vdp_second_order", "--duration", 1000, "--record", tmp_path / "bag",
        "--set", "plant_simulator.autostart=false",
    )  # fmt: skip
    events = []
    with watcher() as graph:
        graph.node.create_subscription(
            TransitionEvent, f"/{TRAJECTORY}/transition_event", events.append, 10
        )
        assert state(graph, PLANT) == "unconfigured"
        assert change(graph, PLANT, "configure")
        assert change(graph, PLANT, "activate")
        graph.wait_for_next()
        for node in STAGES:  # what an active node has no such transition for harms nobody
            for number in (Transition.TRANSITION_CONFIGURE, Transition.TRANSITION_CREATE, 255):
                request = ChangeState.Request(transition=Transition(id=number))
                assert not graph.call(ChangeState, f"/{node}/change_state", request).success
            assert not change(graph, node, "nonsense")
        assert {state(graph, node) for node in STAGES} == {"active"}
        for node in (TRAJECTORY, PLANT):
            assert change(graph, node, "deactivate")
            first = graph.stands_still()
            assert graph.stands_still() == first
            assert not change(graph, node, "cleanup")
            assert state(graph, node) == "inactive"
            assert change(graph, node, "activate")
            graph.wait_for_next()
        assert [event.goal_state.label for event in events][-6:] == [
            "deactivating", "inactive", "cleaningup", "inactive", "activating", "active",
        ]  # fmt: skip
        healthy = first // CYCLE
        assert change(graph, DEFORMER, "deactivate")
        graph.wait_for_next()
        successful, reason = graph.set_parameter(DEFORMER, "stopped", False)
        assert not successful
        assert "inactive: activate it" in reason
        assert change(graph, DEFORMER, "activate")
        graph.wait_for_next()
        assert forked_fpt("e-stop").returncode == 0
        assert change(graph, DEFORMER, "deactivate")
        assert change(graph, DEFORMER, "activate")
        graph.wait_for_next()
        assert graph.get_parameter(DEFORMER, "stopped") is True  # not released by the way
        assert change(graph, PLANT, "shutdown")
    _, stderr = process.communicate(timeout=60)
    assert process.returncode == 0, stderr
    efforts = read_run(tmp_path / "bag").topics["command"].vectors["effort"]
    forked_fpt_json(
        "simulate",
        "vdp_second_order",
        "--duration",
        healthy / 1000,
        "--record",
        tmp_path / "engine",
    )
    truth = read_run(tmp_path / "engine").topics["command"].vectors["effort"]
    assert np.array_equal(efforts[:healthy], truth)
    acts = efforts[healthy:].any(axis=1)
    changes = np.flatnonzero(np.diff(acts.astype(int)))
    assert acts[0]
    assert len(changes) == 3  # off, on, off to the end
    assert changes[1] - changes[0] > 2
