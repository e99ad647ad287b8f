"""The film of a run of an arm: its motion, and what another process makes of it."""

import json
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from fpt_ros.analysis.outline import Outline
from fpt_ros.runs.run import Array

PLANT = "mujoco"

RATE = 10
"""Pictures a second."""

LONGEST = 6.0
"""Of the film [s]: the end of the run."""

PATIENCE = 120.0
"""Seconds that the pictures of a run may take."""

WAYS = ("egl", "osmesa", "lines")
"""How they are drawn: what is tried first, first."""


@dataclass(frozen=True)
class Film:
    """A run to look at; ``film``: WebP, ``still``: PNG, ``way``: of :data:`WAYS`."""

    film: bytes
    still: bytes
    way: str


def film_of(run: Outline) -> Film | None:
    """The film of a run; ``None``: it is not of an arm, or nothing can draw it here."""
    motion = motion_of(run)
    if motion is None:
        return None
    exact = {
        name.removeprefix("exact."): value
        for name, value in run.parameters["plant_simulator"].items()
        if name.startswith("exact.")
    }
    asked = os.environ.get("MUJOCO_GL", "")
    for way in dict.fromkeys((asked, *WAYS) if asked in WAYS else WAYS):
        found = _drawn(exact, motion, way)
        if found is not None:
            return found
    return None


def motion_of(run: Outline) -> dict[str, Array] | None:
    """By joint (2, frames): nominal and realised position; ``None`` where there is no arm."""
    plant = run.parameters.get("plant_simulator", {})
    moved = {name: one for name, one in run.motions.items() if len(one.time) > 1}
    if plant.get("plant") != PLANT or not moved:
        return None
    end = min(float(one.time[-1]) for one in moved.values())
    times = np.arange(max(0.0, end - LONGEST), end, 1.0 / RATE)
    found = {}
    for name, one in moved.items():
        known = np.isfinite(one.nominal) & np.isfinite(one.position)
        if not known.any():
            return None
        found[name] = np.array(
            [np.interp(times, one.time[known], x[known]) for x in (one.nominal, one.position)]
        )
    return found


def _drawn(exact: dict[str, Any], motion: dict[str, Array], way: str) -> Film | None:
    with TemporaryDirectory() as scratch:
        folder = Path(scratch)
        np.save(folder / "motion.npy", np.array(list(motion.values())))
        about = {"exact": exact, "joints": list(motion)}
        (folder / "arm.json").write_text(json.dumps(about, default=list))
        environment = {**os.environ, "MUJOCO_GL": "disable" if way == "lines" else way}
        command = [sys.executable, "-m", "fpt_ros.analysis.arm.artist", scratch, way, str(RATE)]
        try:
            done = subprocess.run(
                command, env=environment, capture_output=True, timeout=PATIENCE, check=False
            )
            if done.returncode == 0:
                film, still = folder / "film.webp", folder / "still.png"
                return Film(film.read_bytes(), still.read_bytes(), way)
        except (OSError, subprocess.TimeoutExpired):
            pass
    return None
