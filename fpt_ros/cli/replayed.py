"""What ``fpt replay`` and ``fpt rerun`` share: settings of a node, and how outcomes are told."""

from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

from fpt_ros.cli.output import console, print_json
from fpt_ros.cli.recordings import say
from fpt_ros.cycle.stages import STAGES
from fpt_ros.errors import BadInput
from fpt_ros.experiments.parameter_file import scalar
from fpt_ros.parameters import Value
from fpt_ros.replay.compared import Difference, plain
from fpt_ros.replay.replayed import Outcome


def settings_of(texts: list[str], node: str = "") -> dict[str, dict[str, Value]]:
    """``NODE.PARAM=VALUE`` by node; of the one that is replayed ``PARAM=VALUE`` is enough.

    Raises:
        BadInput: it is something else, or of another node.
    """
    found: dict[str, dict[str, Any]] = {}
    for text in texts:
        name, equals, value = text.partition("=")
        of, dot, rest = name.strip().partition(".")
        if not (dot and of in STAGES):
            of, rest = node, name.strip()
        if not (equals and of and rest):
            takes = "PARAM=VALUE, as in A=-0.2" if node else "NODE.PARAM=VALUE"
            raise BadInput(f"--set {text}: it takes {takes}")
        if node and of != node:
            raise BadInput(f"--set {text}: the replay is of {node}, it takes parameters of that")
        found.setdefault(of, {})[rest] = scalar(value)
    return found


def show(bag: Path, outcomes: Mapping[str, Outcome], record: Path | None, json: bool) -> None:
    """Tell what came of it: by node, or of the whole ``loop``.

    Raises:
        BadInput: there was nothing to compare.
    """
    notes = list(dict.fromkeys(note for one in outcomes.values() for note in one.notes))
    compared = [one.cycles for one in outcomes.values() if one.cycles]
    if not compared:
        raise BadInput(f"{bag} holds nothing to compare: {'; '.join(notes) or 'no answers'}")
    first = min(
        (one.first for one in outcomes.values() if one.first is not None),
        key=lambda one: one.cycle,
        default=None,
    )
    if json:
        print_json(
            {
                "bag": str(bag),
                "equal": first is None,
                "cycles": min(compared),
                "first_difference": _difference(first),
                "parts": {name: _part(one) for name, one in outcomes.items()},
                "record": str(record) if record is not None else None,
            }
        )
        return
    out = console()
    say(bag, notes)
    for name, one in outcomes.items():
        if not one.cycles:
            out.print(f"{name}: nothing to compare", soft_wrap=True)
        elif one.first is None:
            out.print(f"{name}: {one.cycles} cycles, equal to the last bit", soft_wrap=True)
        else:
            out.print(
                f"{name}: {one.differing} messages of {one.cycles} cycles differ\n  {one.first}",
                soft_wrap=True,
            )
    if record is not None:
        out.print(f"recorded: {record}   (fpt diff {bag} {record})", soft_wrap=True)


def _part(one: Outcome) -> dict[str, Any]:
    return {
        "equal": one.equal if one.cycles else None,
        "cycles": one.cycles,
        "differing": one.differing,
        "first_difference": _difference(one.first),
        "notes": list(one.notes),
    }


def _difference(one: Difference | None) -> dict[str, Any] | None:
    if one is None:
        return None
    return {**asdict(one), "recorded": plain(one.recorded), "now": plain(one.now)}
