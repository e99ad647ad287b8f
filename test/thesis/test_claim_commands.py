"""The shell lines of the page make what the claims are judged by."""

import shlex
from itertools import pairwise

from fpt_ros.experiments.experiment import load
from fpt_ros.thesis.claim import Claim
from fpt_ros.thesis.commands import commands
from fpt_ros.thesis.setup import Setup


def test_a_command_makes_the_run_that_it_is_of():
    setup = Setup("tora", "strong", ("trajectory_generator.amplitude=[0.3, 1.0]",), 2.0)
    words = shlex.split(setup.command())
    assert words[:5] == ["fpt", "simulate", "tora", "--variant", "strong"]
    settings = [after for word, after in pairwise(words) if word == "--set"]
    again = load(words[2], words[4], settings, float(words[words.index("--duration") + 1]))
    assert again.nodes == setup.experiment().nodes


def test_a_scan_is_a_loop_of_the_shell():
    runs = {f"{A}": Setup("tora", settings=(f"fpt_deformer.A={A}",)) for A in range(-6, 0)}
    claim = Claim("1", "", "", {**runs, "none": Setup("tora", "nonadaptive")}, lambda _: None)
    assert commands(claim) == [
        "for x in -6 -5 -4 -3 -2 -1; do fpt simulate tora --set fpt_deformer.A=$x; done",
        "fpt simulate tora --variant nonadaptive",
    ]
