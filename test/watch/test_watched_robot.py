"""What is known of a graph's parameters, from answers and from what it tells by itself."""

from fpt_ros.nodes.listening import Changed
from fpt_ros.watch.robot import DEFORMER, Robot

STATE = (frozenset({DEFORMER}), 1)


def test_what_changes_while_all_are_asked_for_is_newer_than_the_answer():
    """Five nodes are asked one after the other: on a busy machine that takes seconds."""
    robot = Robot("/")
    robot.know(DEFORMER, {"A": -0.3})  # before: the answer is newer
    robot.will_be_described()
    answer = {DEFORMER: ([], {"A": -0.1, "K": 0.5, "D": 0.6})}
    robot.know(DEFORMER, {"A": -2e-10})  # set on the page
    robot.take(Changed("/", DEFORMER, 5, {"K": 0.7}))  # set by somebody else
    robot.describe(STATE, answer)
    assert robot.values == {DEFORMER: {"A": -2e-10, "K": 0.7, "D": 0.6}}
    assert robot.gains == [(0, -2e-10)]


def test_the_next_answer_is_newer_than_what_changed_before_it():
    robot = Robot("/")
    robot.will_be_described()
    robot.know(DEFORMER, {"A": -2e-10})
    robot.describe(STATE, {DEFORMER: ([], {"A": -0.1})})
    robot.will_be_described()
    robot.describe(STATE, {DEFORMER: ([], {"A": -0.1})})
    assert robot.values == {DEFORMER: {"A": -0.1}}
