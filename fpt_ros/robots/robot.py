"""From an arm's file to an experiment on the disk."""

import os
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from fpt_ros.analysis.overall import error_of_all
from fpt_ros.analysis.whole_files import write_whole
from fpt_ros.errors import BadInput
from fpt_ros.experiments.experiment import BASE, Experiment, load
from fpt_ros.experiments.response_map import jacobian, nominal_points
from fpt_ros.gain.contraction import bounds
from fpt_ros.gain.limits import Gain
from fpt_ros.robots.experiment_files import HEADER, Numbers, experiment_files
from fpt_ros.robots.motion import motion
from fpt_ros.robots.survey import survey
from fpt_ros.sweep.run_one import simulate

UNEVEN = 3.0
"""Joints whose answers to the model differ by more than this get weights."""

EVERY = 20
"""Of the points of the nominal motion, one in so many is looked at for the weights."""


@dataclass(frozen=True)
class Written:
    """What was written: the files, that of the experiment itself first."""

    numbers: Numbers
    experiment: Experiment
    files: tuple[Path, ...]


def write_experiment(
    file: str, directory: Path | None, joints: Sequence[str] = (), payload: float | None = None
) -> Written:
    """Write an experiment for an arm, its variants beside it.

    Args:
        file: MJCF or URDF, or the name of an arm that ships.
        directory: where to; ``None``: a folder of the arm's name, here.
        joints: that are moved; empty: all that can be.
        payload: at the flange [kg]; ``None``: what the arm can carry.

    Raises:
        BadInput: the file cannot be used, or the directory cannot be written.
    """
    about = survey(file, joints)
    directory = directory or Path(about.name)
    check_directory(directory, about.name)
    numbers = _with_gain(Numbers(about, motion(about, payload), -1.0, ()))
    texts = experiment_files(numbers)
    try:
        directory.mkdir(parents=True, exist_ok=True)
        for name, text in texts.items():
            write_whole(directory / name, text.encode())
    except OSError as error:
        raise BadInput(f"--out {directory} cannot be written: {error.strerror}") from error
    files = tuple(directory / name for name in texts)
    return Written(numbers, load(str(files[0])), files)


def try_out(written: Written) -> dict[str, float | None]:
    """Settled rms error over all joints with the transformation and without; ``None``: lost."""
    found: dict[str, float | None] = {}
    for variant in (BASE, "computed_torque"):
        experiment = load(str(written.files[0]), variant)
        result = simulate(experiment, experiment.loop())
        found[variant] = error_of_all(result) if result["complete"] else None
    return found


def check_directory(directory: Path, name: str) -> None:
    """The experiment can be written there.

    Raises:
        BadInput: it cannot, or a file of somebody else has its name.
    """
    there = directory.absolute()
    while not there.exists():
        there = there.parent
    if not there.is_dir() or not os.access(there, os.W_OK):
        raise BadInput(f"--out {directory}: give a directory that can be written")
    for path in (directory / f"{name}.yaml", *directory.glob(f"{name}.*.yaml")):
        if path.exists() and not path.read_text(errors="replace").startswith(HEADER):
            raise BadInput(f"--out {directory}: {path} is not of fpt robot, give another directory")


def _with_gain(numbers: Numbers) -> Numbers:
    """With the recommended A, and with weights where these make the slowest learning faster.

    Raises:
        BadInput: no A contracts.
    """
    plain = bounds(_loaded(numbers))
    best, pace = replace(numbers, gain=plain.recommended), _pace(plain)
    weights = _weights(_loaded(numbers))
    if weights:
        weighted = bounds(_loaded(replace(numbers, weights=weights)))
        if _pace(weighted) > pace:
            best, pace = replace(numbers, gain=weighted.recommended, weights=weights), 1.0
    if not pace > 0.0:
        least, greatest = plain.eigenvalues
        raise BadInput(
            f"{numbers.about.file}: no gain contracts, the eigenvalues of M^-1 M^ are between "
            f"{least:.3g} and {greatest:.3g}: take less --payload, or fewer --joints"
        )
    return best


def _pace(found: Gain) -> float:
    """By what part the slowest response error becomes smaller in a cycle; 0: no A contracts."""
    return abs(found.recommended * found.slope) * found.eigenvalues[0] if found.sign else 0.0


def _loaded(numbers: Numbers) -> Experiment:
    """The experiment without Coulomb friction, in which a joint that sticks answers nothing."""
    (name, text), *_ = experiment_files(numbers).items()
    with TemporaryDirectory() as scratch:
        path = Path(scratch) / name
        path.write_text(text, encoding="utf-8")
        return load(str(path), settings=["plant_simulator.exact.coulomb=0.0"])


def _weights(experiment: Experiment) -> tuple[float, ...]:
    """1 / mean diagonal of M^-1 M^ along the motion, the least of them 1; none where even."""
    loop = experiment.loop()
    rows = [np.diag(jacobian(loop, point)) for point in nominal_points(loop)[::EVERY]]
    mean = np.mean([row for row in rows if np.isfinite(row).all()], axis=0)
    if mean.min() <= 0.0 or mean.max() <= UNEVEN * mean.min():
        return ()
    return tuple(float(f"{each:.3g}") for each in mean.max() / mean)
