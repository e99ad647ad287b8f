"""Shell lines that make what a claim is judged by; many that differ in one value are a loop."""

import shlex
from collections.abc import Sequence
from typing import Any

from fpt_ros.thesis.claim import Claim
from fpt_ros.thesis.setup import Setup
from fpt_ros.thesis.trials import Trial

LOOP = 4
"""Runs that differ in one value are written as one loop of the shell where they are more."""


def commands(claim: Claim[Any]) -> list[str]:
    """The lines, each once."""
    setups: dict[tuple[str, str], list[Setup]] = {}
    trials: dict[tuple[str, tuple[str, ...], range], list[Trial]] = {}
    lines = []
    for source in claim.runs.values():
        if isinstance(source, Setup):
            setups.setdefault((source.name, source.variant), []).append(source)
        elif isinstance(source, Trial):
            trials.setdefault((source.method, source.settings, source.seeds), []).append(source)
        else:
            lines.append(source.command())
    for runs in setups.values():
        lines += _loop(runs) if len(runs) > LOOP else [setup.command() for setup in runs]
    for same in trials.values():
        lines += _signals(same) if len(same) > 1 else [same[0].command()]
    return list(dict.fromkeys(lines))


def _signals(trials: Sequence[Trial]) -> list[str]:
    """Trials of one method as a loop over their signals."""
    line = trials[0].command()
    words = trials[0].noisy.text("$s")
    names = " ".join(trial.noisy.text("$s").removesuffix(",seed=$s") for trial in trials)
    return [f"for y in {names}; do {line.replace(words, '$y,seed=$s')}; done"]


def _loop(setups: Sequence[Setup]) -> list[str]:
    """Setups of one experiment and variant, those that differ in their first setting as loops."""
    rest: dict[tuple[str, tuple[str, ...], float | None], list[str]] = {}
    lines = []
    for setup in setups:
        if not setup.settings:
            lines.append(setup.command())
            continue
        target, _, value = setup.settings[0].partition("=")
        rest.setdefault((target, setup.settings[1:], setup.duration), []).append(value)
    first = setups[0]
    for (target, more, duration), values in rest.items():
        if len(values) <= LOOP:
            lines += [
                Setup(first.name, first.variant, (f"{target}={value}", *more), duration).command()
                for value in values
            ]
            continue
        mark = "XVALUEX"
        one = Setup(first.name, first.variant, (f"{target}={mark}", *more), duration).command()
        words = " ".join(map(shlex.quote, values))
        lines.append(f"for x in {words}; do {one.replace(mark, '$x')}; done")
    return lines
