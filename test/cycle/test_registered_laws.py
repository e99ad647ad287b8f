"""The registry finds laws by their names, and says what there is."""

from importlib.metadata import EntryPoint

import pytest

from fpt_ros import registry
from fpt_ros.errors import BadInput
from fpt_ros.transformations import Transformation

KINDS = {
    "plants": registry.plant,
    "models": registry.model,
    "trajectories": registry.trajectory,
    "disturbances": registry.disturbance,
    "transformations": registry.transformation,
    "tuning": registry.tuning_law,
    "filters": registry.streaming_filter,
}


@pytest.fixture
def group(monkeypatch):
    """Replace the entry points of the transformations."""

    def replace(**points):
        made = {
            name: EntryPoint(name, value, "fpt_ros.transformations")
            for name, value in points.items()
        }
        monkeypatch.setattr(registry, "_group", lambda kind: made)

    registry._load.cache_clear()
    yield replace
    registry._load.cache_clear()


@pytest.mark.parametrize("kind", KINDS)
def test_every_registered_law_can_be_loaded(kind):
    names = registry.names(kind)
    assert names == tuple(sorted(names))
    assert names
    for name in names:
        assert KINDS[kind](name) is KINDS[kind](name)


def test_parameters_of_all_laws_are_described():
    for kind in ("plants", "models", "transformations", "tuning"):
        for name in registry.names(kind):
            parameters = KINDS[kind](name).parameters
            assert len({parameter.name for parameter in parameters}) == len(parameters)
            for parameter in parameters:
                assert parameter.text, f"{kind} {name} {parameter.name}"
                assert "\n" not in parameter.text


@pytest.mark.parametrize("kind", KINDS)
def test_an_unknown_name_lists_what_there_is(kind):
    with pytest.raises(BadInput) as caught:
        KINDS[kind]("magic")
    for name in registry.names(kind):
        assert name in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_law_of_another_package(group):
    group(mine="fpt_ros.transformations.sgfpt:SGFPT")
    assert isinstance(registry.transformation("mine"), Transformation)
    with pytest.raises(BadInput, match=r"'sgfpt' is none of the transformations: none, mine$"):
        registry.transformation("sgfpt")


def test_a_law_that_cannot_be_imported(group):
    group(gone="fpt_ros.no_such_module:LAW", empty="fpt_ros.transformations.sgfpt:LAW")
    for name in ("gone", "empty"):
        with pytest.raises(BadInput, match=f"'{name}' of the transformations cannot be loaded: "):
            registry.transformation(name)


def test_nothing_registered_tells_what_to_do(group):
    group()
    with pytest.raises(BadInput, match="is fpt_ros installed"):
        registry.transformation("sgfpt")
