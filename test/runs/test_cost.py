"""What the processes of a graph take of the machine."""

import pytest

from fpt_ros.runs.cost import Costs, Report, row


def taken(*reports):
    costs = Costs()
    for each in reports:
        costs.add(Report(*each))
    return {cost.nodes: cost for cost in costs.result()}


def test_mean_largest_and_growth_of_each_node():
    found = taken(
        ("denoiser", "1@robot", 10.0, 80.0),
        ("recorder", "2@robot", 5.0, 90.0),
        ("denoiser", "1@robot", 40.0, 84.0),
        ("denoiser", "1@robot", 10.0, 82.5),
    )
    cost = found["denoiser",]
    assert (cost.reports, cost.mean, cost.largest) == (3, 20.0, 40.0)
    assert (cost.first, cost.last, cost.growth) == (80.0, 82.5, 2.5)
    assert row(cost.numbers()) == ("denoiser", "20.0", "40.0", "80.0", "82.5", "+2.5")
    assert found["recorder",].growth == 0.0


def test_nodes_of_one_process_are_counted_once():
    """The same number on another host is another process."""
    nodes = ("denoiser", "1@robot"), ("fpt_deformer", "1@robot"), ("recorder", "1@desk")
    assert set(taken(*[(*each, 10.0, 80.0) for each in nodes])) == {
        ("denoiser", "fpt_deformer"), ("recorder",),
    }  # fmt: skip


def test_memory_of_a_node_that_was_started_again_counts_from_its_new_start():
    (cost,) = taken(
        ("denoiser", "1@robot", 30.0, 95.0),
        ("denoiser", "7@robot", 10.0, 80.0),
        ("denoiser", "7@robot", 20.0, 81.0),
    ).values()
    assert (cost.mean, cost.largest) == (pytest.approx(20.0), 30.0)
    assert (cost.first, cost.last) == (80.0, 81.0)
