"""The sections of a parameter file: a node each, and how their parameters are resolved."""

from collections.abc import Callable, Iterable, Set
from functools import partial

from fpt_ros.cycle.stages import STAGES
from fpt_ros.experiments import description
from fpt_ros.experiments.parameter_file import ParameterFile
from fpt_ros.parameters import Parameter, Value, Values, resolve

SECTIONS: dict[str, Callable[[Values], tuple[Parameter, ...]]] = {
    **{name: stage.parameters for name, stage in STAGES.items()},
    description.NODE: description.parameters,
}
"""The nodes of a file, each with its parameters as a function of what is given."""


def resolved(
    node: str,
    file: ParameterFile,
    layers: Iterable[ParameterFile],
    explicit: Set[tuple[str, str]],
) -> dict[str, Value]:
    """Complete, checked parameters of a node.

    A value that belongs to a law which a variant has replaced is dropped; ``layers``: what the file
    was before each of its overlays.
    """
    declared = partial(declared_by, SECTIONS[node])
    before = {name for one in layers for name in declared({**one.shared, **one.nodes[node]})}
    given = {**file.shared, **file.nodes[node]}
    now = declared(given)
    own = {
        name: value
        for name, value in file.nodes[node].items()
        if name in now or name not in before or (node, name) in explicit
    }
    shared = {
        name: value
        for name, value in file.shared.items()
        if name in now or (node, name) in explicit
    }
    return resolve(SECTIONS[node](given), {**shared, **own}, node)


def declared_by(parameters: Callable[[Values], tuple[Parameter, ...]], given: Values) -> set[str]:
    """Names of the parameters that there are, given what is known so far."""
    return {parameter.name for parameter in parameters(given)}
