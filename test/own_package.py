"""A package of a user's own, as it would be installed: a module and its entry points."""

import os
import subprocess
import sys
from pathlib import Path

from command import BIN


def write(folder: Path, name: str, module: str, points: dict[str, dict[str, str]]) -> Path:
    """Put it into a folder that stands on the path; ``points``: name -> object, by group."""
    info = folder / f"{name}-1.0.dist-info"
    info.mkdir(parents=True, exist_ok=True)
    (folder / f"{name}.py").write_text(module, encoding="utf-8")
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n")
    lines = []
    for group, objects in points.items():
        lines += [f"[fpt_ros.{group}]", *(f"{key} = {name}:{o}" for key, o in objects.items())]
    (info / "entry_points.txt").write_text("\n".join(lines) + "\n")
    return folder


def environment(folder: Path) -> dict[str, str]:
    return {**os.environ, "PYTHONPATH": str(folder)}


def python(folder: Path, text: str) -> str:
    """What a program prints, in a process of its own."""
    done = subprocess.run(
        [sys.executable, "-c", text],
        capture_output=True,
        text=True,
        check=True,
        env=environment(folder),
        cwd=folder,
    )
    return done.stdout


def fpt(folder: Path, *arguments: object) -> "subprocess.CompletedProcess[str]":
    """The command line with the package installed."""
    return subprocess.run(
        [str(BIN / "fpt"), *map(str, arguments)],
        capture_output=True,
        text=True,
        check=False,
        env=environment(folder),
        cwd=folder,
    )
