"""The parameter files of an experiment for an arm: those of ``panda``, with the arm's own numbers.

What the experiment ``panda`` shows, its controllers and its circumstances, any arm gets: each file
``panda.VARIANT.yaml`` is read, and what stands in it for this arm alone is replaced.
"""

import io
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from ruamel.yaml import YAML
from ruamel.yaml.comments import CommentedMap, CommentedSeq

from fpt_ros.experiments.locate import config_directory
from fpt_ros.robots.motion import SATURATED, Motion
from fpt_ros.robots.survey import Survey, tool_inertia

TEMPLATE, GAIN = "panda", -3.16
"""Whose files are taken, and its A: the gains of all variants keep their ratio to it."""

DISTANCE = 75.0
"""The template's ``Motion.distance``."""

DAMPING = 30.0
"""K_D of Slotine and Li's control over a joint's inertia [1/s]: twice the template's lambda."""

HEADER = "# Made by fpt robot"
"""First words of the files that are written here, and so may be written again."""


@dataclass(frozen=True)
class Numbers:
    """What is an arm's own in its experiment.

    Attributes:
        gain: A of the transformation.
        weights: of the response errors, one a joint; empty: ones.
    """

    about: Survey
    motion: Motion
    gain: float
    weights: tuple[float, ...]


def experiment_files(numbers: Numbers) -> dict[str, str]:
    """Names and texts of the parameter files, that of the experiment itself first."""
    found = {}
    for path in sorted(config_directory().glob(f"{TEMPLATE}.*"), key=lambda path: len(path.stem)):
        variant = path.stem.partition(".")[2]
        name = ".".join(filter(None, (numbers.about.name, variant, "yaml")))
        found[name] = _text(path, numbers, variant)
    return found


def _text(path: Path, numbers: Numbers, variant: str) -> str:
    yaml = YAML()
    yaml.width = 4096
    content = yaml.load(path.read_text(encoding="utf-8"))
    lines = [HEADER + f" from {numbers.about.file}."]
    if variant:
        lines += [line for line in path.read_text().splitlines() if line.startswith("# ")]
    else:
        lines += _about(numbers)
    content.yaml_set_start_comment("\n".join(line.removeprefix("# ") for line in lines))
    for section in content.values():
        _replace(section["ros__parameters"], numbers)
    deformer = content.get("/**/fpt_deformer", {}).get("ros__parameters", {})
    if deformer.get("scale", 1.0) > 1.0:
        deformer["scale"] *= _widening(numbers.motion)
    if not variant:
        _complete(content, numbers)
    buffer = io.StringIO()
    yaml.dump(content, buffer)
    return buffer.getvalue()


def _widening(motion: Motion) -> float:
    """How many times as far as the template's the transformation has to reach, in two digits."""
    return float(f"{max(1.0, motion.distance / DISTANCE):.2g}")


def _about(numbers: Numbers) -> list[str]:
    motion, about = numbers.motion, numbers.about
    lines = [
        f"# {motion.payload:g} kg at the flange; the model has half of all inertias, no friction",
        "# and no payload.",
        "#",
        "# The nominal motion is two tones a joint about the posture, inside of the joint limits.",
    ]
    lines += [f"# {note[:1].upper()}{note[1:]}." for note in motion.notes]
    lines += [f"# Joint '{name}' {why}: it is fixed." for name, why in about.fixed.items()]
    return lines


def _complete(content: CommentedMap, numbers: Numbers) -> None:
    """What the template's base file says of its own arm alone."""
    nodes = {name.rsplit("/", 1)[-1]: body["ros__parameters"] for name, body in content.items()}
    about, motion = numbers.about, numbers.motion
    exact, shared = nodes["plant_simulator"]["exact"], nodes["**"]
    exact["tool"] = motion.payload
    exact["tool_inertia"] = tool_inertia(motion.payload)
    if motion.limits:
        exact["torque_limit"] = _row(motion.limits)
    if about.fixed:
        for part in (exact, shared["approximate"]):
            part["joints"] = _row(about.arm.names)
    nodes["trajectory_generator"]["lambda"] *= motion.speed
    deformer = nodes["fpt_deformer"]
    deformer.ca.items.pop("A", None)
    if numbers.weights:
        deformer["weights"] = _row(numbers.weights)
    nodes["recorder"]["title"] = about.name


def _replace(tree: CommentedMap, numbers: Numbers) -> None:
    for key, value in tree.items():
        if isinstance(value, Mapping):
            _replace(tree[key], numbers)
        elif key == "file":
            tree[key] = numbers.about.file
        elif key == "A":
            tree[key] = float(f"{value * numbers.gain / GAIN:.4g}")
        elif isinstance(value, Sequence) and not isinstance(value, str):
            tree[key] = _row(_list(key, value, numbers))


def _list(key: str, value: Sequence[Any], numbers: Numbers) -> Sequence[Any]:
    """A list of the template's seven joints, for this arm's."""
    about, motion, n = numbers.about, numbers.motion, len(numbers.about.home)
    own: dict[str, Callable[[], Sequence[Any]]] = {
        "controlled": lambda: about.arm.names,
        "joints": lambda: about.arm.names,
        "initial_position": lambda: about.home,
        "offset": lambda: about.home,
        "inertia": lambda: [float(f"{each:.3g}") for each in about.inertia],
        "K_D": lambda: [float(f"{DAMPING * each:.3g}") for each in about.inertia],
        "torque_limit": lambda: [float(f"{SATURATED * x:.3g}") for x in motion.effort],
        "amplitude": lambda: [round(value[0] * fit, 5) for fit in motion.fit],
        "frequency": lambda: _spread(value, n, motion.speed),
        "phase": lambda: _steps(value, n),
    }
    kind = key.removeprefix("second_")
    if kind in own:
        return own[kind]()
    if len(set(value)) == 1 and len(value) > 1:
        return [value[0]] * n
    return value


def _spread(value: Sequence[float], n: int, speed: float) -> list[float]:
    """As many numbers between the same ends; of one joint the first."""
    found = np.linspace(value[0], value[-1], n) * speed
    return [round(float(each), 5) for each in found]


def _steps(value: Sequence[float], n: int) -> list[float]:
    """As many numbers in the same steps."""
    step = value[1] - value[0]
    return [round(value[0] + i * step, 5) for i in range(n)]


def _row(values: Sequence[Any]) -> CommentedSeq:
    row = CommentedSeq(each if isinstance(each, str) else _plain(each) for each in values)
    row.fa.set_flow_style()
    return row


def _plain(number: float) -> float:
    return float(number) if math.isfinite(number) else number
