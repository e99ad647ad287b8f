"""The registry finds laws by their names, and says what there is."""

from importlib.metadata import EntryPoint, EntryPoints

import pytest

from fpt_ros import registry
from fpt_ros.compensators import COMPENSATORS
from fpt_ros.denoising.streaming import FILTERS
from fpt_ros.disturbances import DISTURBANCES
from fpt_ros.errors import BadInput
from fpt_ros.plants import MODELS, PLANTS
from fpt_ros.relaxations import RELAXATIONS
from fpt_ros.trajectories import TRAJECTORIES
from fpt_ros.transformations import TRANSFORMATIONS, Transformation
from fpt_ros.tuning import TUNING_LAWS

KINDS = (
    PLANTS,
    MODELS,
    TRAJECTORIES,
    RELAXATIONS,
    DISTURBANCES,
    TRANSFORMATIONS,
    TUNING_LAWS,
    COMPENSATORS,
    FILTERS,
)


def group_of(kind):
    return kind.group


every_kind = pytest.mark.parametrize("kind", KINDS, ids=group_of)


@pytest.fixture
def points(monkeypatch):
    """Replace the entry points of the transformations: (name, value) each."""

    def replace(*pairs):
        made = [EntryPoint(name, value, "fpt_ros.transformations") for name, value in pairs]
        monkeypatch.setattr(registry, "entry_points", lambda: EntryPoints(made))

    registry.forget()
    yield replace
    registry.forget()


@every_kind
def test_every_registered_law_can_be_loaded_and_names_its_parameters_once(kind):
    assert kind.names()
    for name in kind.names():
        parameters = [parameter.name for parameter in getattr(kind[name], "parameters", ())]
        assert len(set(parameters)) == len(parameters)


@every_kind
def test_an_unknown_name_lists_what_there_is(kind):
    with pytest.raises(BadInput) as caught:
        kind["magic"]
    for name in kind.names():
        assert name in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_law_of_another_package(points):
    points(("mine", "fpt_ros.transformations.sgfpt:SGFPT"))
    assert isinstance(TRANSFORMATIONS["mine"], Transformation)
    with pytest.raises(BadInput, match=r"'sgfpt' is none of the transformations: mine$"):
        TRANSFORMATIONS["sgfpt"]


def test_a_law_that_cannot_be_imported(points):
    points(("gone", "fpt_ros.no_such:LAW"), ("empty", "fpt_ros.transformations.sgfpt:LAW"))
    for name in ("gone", "empty"):
        with pytest.raises(BadInput, match=f"'{name}' of the transformations cannot be loaded, "):
            TRANSFORMATIONS[name]


def test_an_entry_point_that_is_something_else(points):
    points(("mine", "fpt_ros.transformations.sgfpt:prepare"))
    with pytest.raises(BadInput, match=r"'mine' of the transformations is a function, not a Trans"):
        TRANSFORMATIONS["mine"]


def test_two_packages_with_one_name(points):
    points(
        ("mine", "fpt_ros.transformations.sgfpt:SGFPT"),
        ("mine", "fpt_ros.transformations.rfpt:RFPT"),
    )
    with pytest.raises(BadInput, match=r"two packages register 'mine' .*sgfpt:SGFPT and .*rfpt:RF"):
        TRANSFORMATIONS["mine"]


def test_nothing_registered_tells_what_to_do(points):
    points()
    with pytest.raises(BadInput, match="is fpt_ros installed"):
        TRANSFORMATIONS["sgfpt"]
