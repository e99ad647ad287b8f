"""Experiments: parameter files, their variants, and what was changed on the command line."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import cast

from fpt_ros.cycle.denoiser import Denoiser
from fpt_ros.cycle.fpt_deformer import FptDeformer
from fpt_ros.cycle.limits import COMMAND_TIMEOUT
from fpt_ros.cycle.parameter_tuner import ParameterTuner, in_the_loop
from fpt_ros.cycle.plant_simulator import PlantSimulator
from fpt_ros.cycle.stage import REALTIME
from fpt_ros.cycle.stages import Loop
from fpt_ros.cycle.trajectory_generator import TrajectoryGenerator
from fpt_ros.errors import BadInput
from fpt_ros.experiments import description, parameter_file
from fpt_ros.experiments.checks import check_fit
from fpt_ros.experiments.derived import (
    asks_for_weights,
    derive_names,
    filter_noise,
    heal_losses,
    share_synchronised,
    weights_of,
)
from fpt_ros.experiments.locate import config_directory
from fpt_ros.experiments.parameter_file import ParameterFile
from fpt_ros.experiments.sections import SECTIONS, declared_by, resolved
from fpt_ros.parameters import Value

BASE = "adaptive"
"""Name of the variant that is the file itself, without an overlay."""


LAID_OVER = "+"
"""Between variants that are laid over each other."""


@dataclass(frozen=True)
class Experiment:
    """A run that could be made: complete, checked parameters of every node.

    Attributes:
        name, variant: what it goes by.
        nodes: parameters by node; the recorder's section is the description.
        source: words that name it on the command line, as they were given.
    """

    name: str
    variant: str
    nodes: dict[str, dict[str, Value]] = field(repr=False)
    source: tuple[str, ...] = field(default=(), repr=False, compare=False)

    @property
    def about(self) -> dict[str, Value]:
        """The description: title, shows, thesis, settle_time."""
        return self.nodes[description.NODE]

    def loop(self) -> Loop:
        """Fresh stages.

        Raises:
            BadInput: the stages do not fit each other.
        """
        loop = Loop(
            PlantSimulator(self.nodes[PlantSimulator.name]),
            Denoiser(self.nodes[Denoiser.name]),
            TrajectoryGenerator(self.nodes[TrajectoryGenerator.name]),
            ParameterTuner(self.nodes[ParameterTuner.name]),
            FptDeformer(self.nodes[FptDeformer.name]),
        )
        check_fit(loop)
        return loop

    def with_values(self, node: str, **changes: Value) -> "Experiment":
        """The same experiment with some parameters of a node changed."""
        return replace(self, nodes={**self.nodes, node: {**self.nodes[node], **changes}})

    def for_graph(self, realtime: bool) -> "Experiment":
        """The same experiment, its nodes told what only a graph of them has to know."""
        nodes = {node: dict(values) for node, values in self.nodes.items()}
        deformer, speed = nodes[FptDeformer.name], nodes[PlantSimulator.name].get("speed", 1.0)
        timeout, told = deformer.get(COMMAND_TIMEOUT.name), deformer.get(REALTIME.name) is True
        if realtime and not told and isinstance(timeout, float) and isinstance(speed, float):
            # a plant with a slow clock is heard more seldom: the deformer waits so much longer
            deformer[COMMAND_TIMEOUT.name] = timeout / speed
        for values in nodes.values():
            values[REALTIME.name] = realtime
        return replace(self, nodes=nodes)

    def write(self, path: Path) -> None:
        """Write it as one parameter file for all nodes."""
        parameter_file.write(path, self.nodes)


def available() -> dict[str, list[str]]:
    """Names of all experiments of this package, each with its variants, the base first."""
    found: dict[str, list[str]] = {}
    for path in sorted(config_directory().glob("*.yaml")):
        name, _, variant = path.stem.partition(".")
        variants = found.setdefault(name, [BASE])
        if variant:
            variants.append(variant)
    return found


def load(
    name: str,
    variant: str = BASE,
    settings: Iterable[str] = (),
    duration: float | None = None,
    seed: int | None = None,
) -> Experiment:
    """Read an experiment and apply a variant and settings to it.

    Args:
        name: of an experiment of the package, or the path of a parameter file.
        variant: its overlay ``NAME.VARIANT.yaml``; ``adaptive``: none; or the path of an overlay
            file of any name, whose stem is then the variant's name. Several, joined by ``+``, are
            laid over each other in this order, as in ``noisy+pid``.
        settings: ``NODE.PARAM=VALUE`` each.
        duration: length of the run [s].
        seed: random seed.

    Raises:
        BadInput: anything that is not valid, in one line that says what is.
    """
    path, source = _path_of(name), (name, *(("--variant", variant) if variant != BASE else ()))
    base = parameter_file.read(path)
    for section in SECTIONS:
        if section not in base.nodes:
            raise BadInput(f"{path} lacks the section '{section}': it takes {', '.join(SECTIONS)}")
    _check_nodes(path, base)
    layers, names, file = [base], [], base.overlay(ParameterFile())
    for word in _words(variant):
        overlay_path = _variant_path(path, word)
        overlay = parameter_file.read(overlay_path)
        _check_nodes(overlay_path, overlay)
        if is_path(word):
            _check_owner(overlay_path, overlay, path.stem)
            word = overlay_path.stem
        names.append(word)
        layers.append(file)
        file = file.overlay(overlay)
    variant = LAID_OVER.join(names) or BASE
    changes = [_setting(text) for text in settings]
    if duration is not None:
        changes.append((PlantSimulator.name, "duration", duration))
    if seed is not None:
        changes.append((PlantSimulator.name, "seed", seed))
    for node, parameter, value in changes:
        _apply(file, node, parameter, value)
    file.nodes[description.NODE].update(experiment=path.stem, variant=variant)
    share_synchronised(file)
    filter_noise(file)
    heal_losses(file)
    weighs = asks_for_weights(file)
    in_loop = in_the_loop(file.nodes[ParameterTuner.name])
    for node, parameter, value in changes:
        if parameter == "await_tuning" and value != in_loop:
            raise BadInput(f"{node}.await_tuning follows from parameter_tuner.method: {in_loop}")
    for section_values in file.nodes.values():
        section_values.pop("await_tuning", None)
    file.shared["await_tuning"] = in_loop
    explicit = {(node, parameter) for node, parameter, _ in changes}
    derive_names(file, resolved(PlantSimulator.name, file, layers, explicit), changes)
    _check_shared(path, file, layers)
    nodes = {node: resolved(node, file, layers, explicit) for node in SECTIONS}
    experiment = Experiment(path.stem, variant, nodes, source)
    loop = experiment.loop()
    if weighs:
        experiment = experiment.with_values(FptDeformer.name, weights=weights_of(loop))
    return experiment


def described(name: str, variant: str) -> dict[str, object]:
    """What the files of an experiment of the package say of a variant; it is not made."""
    path = _path_of(name)
    file = parameter_file.read(path)
    for word in _words(variant):
        file = file.overlay(parameter_file.read(_variant_path(path, word)))
    defaults = {each.name: each.default for each in description.PARAMETERS}
    return {**defaults, **file.nodes[description.NODE]}


def complete(file: ParameterFile) -> dict[str, dict[str, Value]]:
    """Complete, checked parameters of the nodes that a file has sections for.

    Raises:
        BadInput: as :func:`load`.
    """
    return {node: resolved(node, file, [file], set()) for node in SECTIONS if node in file.nodes}


def _check_nodes(path: Path, file: ParameterFile) -> None:
    """Every section of a file is a node's."""
    for node in file.nodes:
        if node not in SECTIONS:
            raise BadInput(f"{path}: there is no node '{node}', only {', '.join(SECTIONS)}")


def _check_shared(path: Path, file: ParameterFile, layers: Sequence[ParameterFile]) -> None:
    """Every shared value is known to a node, or was to one before a variant."""
    known: set[str] = set()
    for version in (*layers, file):
        for node, parameters in SECTIONS.items():
            known |= declared_by(parameters, {**version.shared, **version.nodes[node]})
    for name in file.shared:
        if name not in known:
            raise BadInput(
                f"{path}: no node has the parameter '{name}' of the section "
                f"{parameter_file.SHARED}: there are {', '.join(sorted(known))}"
            )


def _words(variant: str) -> list[str]:
    """The variants that are laid over each other."""
    if is_path(variant) and Path(variant).exists():
        return [variant]
    return [word for word in variant.split(LAID_OVER) if word != BASE]


def is_path(text: str) -> bool:
    """Whether a word is the path of a parameter file, and no name."""
    return text.endswith((".yaml", ".yml")) or "/" in text


def parameter_files(name: str, variant: str) -> list[Path]:
    """The files that are read for an experiment, but for those of the package.

    Raises:
        BadInput: there is no such experiment or variant.
    """
    path = _path_of(name)
    paths = [path, *(_variant_path(path, word) for word in _words(variant))]
    return [each for each in paths if each.parent != config_directory()]


def _check_owner(path: Path, overlay: ParameterFile, experiment: str) -> None:
    """An overlay given by its path is of this experiment.

    What it says itself (``recorder.experiment``) counts, otherwise its name, ``NAME.VARIANT.yaml``.
    """
    owner = overlay.nodes.get(description.NODE, {}).get("experiment")
    if owner is None and path.stem.partition(".")[0] in available():
        owner = path.stem.partition(".")[0]
    if owner is not None and owner != experiment:
        raise BadInput(f"{path} is of the experiment {owner}, not of {experiment}")


def _path_of(name: str) -> Path:
    if is_path(name):
        return Path(name)
    if name not in available():
        raise BadInput(f"no experiment '{name}': there are {', '.join(available())}")
    return config_directory() / f"{name}.yaml"


def _variant_path(path: Path, variant: str) -> Path:
    if is_path(variant):
        return Path(variant)
    found = [p.stem.partition(".")[2] for p in sorted(path.parent.glob(f"{path.stem}.*.yaml"))]
    if variant not in found:
        valid = ", ".join([BASE, *found])
        raise BadInput(f"{path.stem} has no variant '{variant}': it has {valid}")
    return path.with_name(f"{path.stem}.{variant}.yaml")


def _setting(text: str) -> tuple[str, str, object]:
    """Split ``NODE.PARAM=VALUE``."""
    target, equals, value = text.partition("=")
    node, dot, parameter = target.strip().partition(".")
    if not (equals and dot and parameter):
        raise BadInput(f"--set {text}: it takes NODE.PARAM=VALUE, as in fpt_deformer.A=-0.2")
    return node, parameter, parameter_file.scalar(value)


def _apply(file: ParameterFile, node: str, parameter: str, value: object) -> None:
    """Set one value; one that nodes share is set for all of them."""
    if node not in SECTIONS:
        raise BadInput(f"there is no node '{node}': there are {', '.join(SECTIONS)}")
    target = file.nodes[node]
    if parameter in file.shared and parameter not in target:
        target = file.shared
    target[parameter] = cast(Value, value)
