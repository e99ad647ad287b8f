"""Who is compared, and under which circumstances."""

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import cast

from fpt_ros.denoising.streaming import given_filters
from fpt_ros.errors import BadInput
from fpt_ros.experiments.experiment import BASE, LAID_OVER, Experiment, is_path, load
from fpt_ros.experiments.locate import config_directory
from fpt_ros.parameters import Value

NOISES = (0.1, 1.0, 10.0)
"""Parts of the noise of a noisy circumstance that are tried."""

DELAYS = (1, 2, 3)
"""Cycles by which sensors are late, of a circumstance in which they are."""

NOISE, DELAY = "noise", "delay"


@dataclass(frozen=True)
class Controller:
    """One that is compared.

    Attributes:
        name: of the variant; of an overlay file its stem.
        word: what ``--variant`` takes.
        shows: what the experiment's file says of it.
        family: whether it has a fixed point transformation.
    """

    name: str
    word: str
    shows: str
    family: bool


@dataclass(frozen=True)
class Circumstance:
    """What all controllers meet.

    Attributes:
        name: for tables.
        word: of the variant that is laid below each controller.
        settings: on top of it.
        shows: what the experiment's file says of it.
        grade: :data:`NOISE` or :data:`DELAY` where it is one of several of a kind; empty.
        value: of the noise (standard deviation), or cycles of delay.
        noisy: whether the seed matters.
    """

    name: str
    word: str = BASE
    settings: tuple[str, ...] = ()
    shows: str = ""
    grade: str = ""
    value: float = 0.0
    noisy: bool = False


@dataclass(frozen=True)
class Field:
    """All of a comparison.

    Attributes:
        name: of the experiment, as ``load`` takes it.
        experiment: as it is.
        settings, duration: for all runs.
        groups: circumstances for which a controller is set up once: first what is as usual, then
            each kind of sensors.
        left_out: variants that are neither, and why.
    """

    name: str
    experiment: Experiment
    settings: tuple[str, ...]
    duration: float | None
    controllers: tuple[Controller, ...]
    groups: tuple[tuple[Circumstance, ...], ...]
    left_out: Mapping[str, str]

    def load(self, controller: Controller, circumstance: Circumstance, *more: str) -> Experiment:
        """One controller under one circumstance.

        Raises:
            BadInput: they do not go together.
        """
        word = variant(controller, circumstance)
        settings = (*self.settings, *circumstance.settings, *more)
        return load(self.name, word, settings, self.duration)

    @property
    def circumstances(self) -> tuple[Circumstance, ...]:
        """Those of all groups."""
        return tuple(each for group in self.groups for each in group)

    def digest(self) -> str:
        """Of all parameter files, and of the settings that circumstances bring."""
        folder, stem = _files(self.name)
        paths = [*sorted(folder.glob(f"{stem}.*yaml")), *map(Path, self._overlays())]
        texts = [path.read_text(encoding="utf-8") for path in paths]
        texts += [repr(each) for each in self.circumstances]
        texts.append(json.dumps(self.experiment.nodes, sort_keys=True, default=list))
        return hashlib.sha256("\0".join(texts).encode()).hexdigest()[:16]

    def _overlays(self) -> list[str]:
        words = [each.word for each in self.controllers]
        words += [each.word for each in self.circumstances]
        return [word for word in words if is_path(word)]


def _files(name: str) -> tuple[Path, str]:
    """The folder of an experiment's files, and the first word of their names."""
    return (Path(name).parent, Path(name).stem) if is_path(name) else (config_directory(), name)


def variant(controller: Controller, circumstance: Circumstance) -> str:
    """What ``--variant`` takes for a controller under a circumstance."""
    words = [word for word in (circumstance.word, controller.word) if word != BASE]
    return LAID_OVER.join(words) or BASE


def field(
    name: str,
    controllers: Sequence[str] = (),
    circumstances: Sequence[str] = (),
    settings: Sequence[str] = (),
    duration: float | None = None,
) -> Field:
    """What is asked for, checked.

    Args:
        name: an experiment, or a parameter file.
        controllers: variants or overlay files; empty: all that leave the plant alone.
        circumstances: variants; empty: all that say that they are circumstances.
        settings, duration: for all runs.

    Raises:
        BadInput: an unknown name, or nothing to compare.
    """
    name = str(Path(name).absolute()) if is_path(name) else name
    base = load(name, BASE, settings, duration)
    found, left_out = _variants(name, settings, duration)
    chosen = list(controllers) or [
        word for word, each in found.items() if not each.about["circumstance"]
    ]
    met = list(circumstances) or [
        word for word, each in found.items() if each.about["circumstance"]
    ]
    fighters = []
    for word in dict.fromkeys(chosen):
        one = found.get(word) or load(name, word, settings, duration)
        if not controllers and _changes_plant(base, one):
            left_out[word] = "it changes the plant"
            continue
        adapts = one.loop().deformer.transformation.adapts
        label = Path(word).stem if is_path(word) else word
        whole = str(Path(word).absolute()) if is_path(word) else word
        fighters.append(Controller(label, whole, str(one.about["shows"]), adapts))
    if not fighters:
        raise BadInput("there is nothing to compare: --controllers takes variants (fpt list)")
    usual = [Circumstance("as it is", shows=str(base.about["shows"]), noisy=_noisy(base))]
    graded: list[tuple[Circumstance, ...]] = []
    for word in dict.fromkeys(met):
        if word == BASE:
            continue
        one = found.get(word) or load(name, word, settings, duration)
        shows, grades = str(one.about["shows"]), _grades(word, base, one)
        if grades:
            graded += [(grade,) for grade in grades]
        else:
            usual.append(Circumstance(word, word, (), shows, noisy=_noisy(one)))
    groups = (tuple(usual), *graded)
    return Field(name, base, tuple(settings), duration, tuple(fighters), groups, left_out)


def _variants(
    name: str, settings: Sequence[str], duration: float | None
) -> tuple[dict[str, Experiment], dict[str, str]]:
    """All variants of an experiment, and those that cannot be loaded with these settings."""
    folder, stem = _files(name)
    words = [path.stem.partition(".")[2] for path in sorted(folder.glob(f"{stem}.*.yaml"))]
    found, wrong = {}, {}
    for word in (BASE, *words):
        try:
            found[word] = load(name, word, settings, duration)
        except BadInput as error:
            wrong[word] = str(error)
    return found, wrong


def _changes_plant(base: Experiment, one: Experiment) -> bool:
    return base.nodes["plant_simulator"] != one.nodes["plant_simulator"]


def _noisy(one: Experiment) -> bool:
    plant = one.nodes["plant_simulator"]
    return any(plant[f"noise.{kind}"] for kind in ("position", "velocity"))


def _grades(word: str, base: Experiment, one: Experiment) -> list[Circumstance]:
    """The same circumstance with less and with more noise or delay; none: it has neither."""
    plant, shows = one.nodes["plant_simulator"], str(one.about["shows"])
    label = Path(word).stem if is_path(word) else word
    sigma = cast("float", plant["noise.position"])
    if sigma and sigma != base.nodes["plant_simulator"]["noise.position"]:
        return [
            Circumstance(
                f"{label} {sigma * part:.3g}",
                word,
                _with_noise(one, part),
                shows,
                NOISE,
                sigma * part,
                noisy=True,
            )
            for part in NOISES
        ]
    late = plant["measurement_delay"]
    if late and late != base.nodes["plant_simulator"]["measurement_delay"]:
        return [
            Circumstance(
                f"{label} {cycles}",
                word,
                _with_delay(one, cast("int", late), cycles),
                shows,
                DELAY,
                float(cycles),
                noisy=_noisy(one),
            )
            for cycles in DELAYS
        ]
    return []


def _with_noise(one: Experiment, part: float) -> tuple[str, ...]:
    """More or less noise; a filter that is told of it is told the same, and keeps its bandwidth."""
    if part == 1.0:
        return ()
    plant, filter_ = one.nodes["plant_simulator"], one.nodes["denoiser"]
    found = {
        f"plant_simulator.{name}": _times(plant[name], part)
        for name in ("noise.position", "noise.velocity")
        if plant[name]
    }
    if filter_["method"] == "kalman_bank" and given_filters.are_given(filter_):
        sigma, _, densities = given_filters.given(filter_)
        found["denoiser.sigma"] = _times(sigma, part)
        found["denoiser.densities"] = _times(densities, part * part)
    return tuple(f"{name}={json.dumps(value)}" for name, value in found.items())


def _times(value: Value, factor: float) -> Value:
    if isinstance(value, list):
        return [float(f"{each * factor:.6g}") for each in value]
    return float(f"{cast('float', value) * factor:.6g}")


def _with_delay(one: Experiment, late: int, cycles: int) -> tuple[str, ...]:
    """Another delay; what was told of it is told the same."""
    if cycles == late:
        return ()
    told = {
        "plant_simulator": "measurement_delay",
        "trajectory_generator": "nominal_delay",
        "fpt_deformer": "sensor_delay",
    }
    return tuple(
        f"{node}.{name}={cycles}" for node, name in told.items() if one.nodes[node][name] == late
    )
