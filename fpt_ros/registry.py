"""One registry for everything that has a name in a parameter file: Python entry points.

A plant, model, trajectory, relaxation, disturbance, transformation, tuning law, compensator or
filter is found by the name under which a package (this one, or a user's own) lists it in the group
``fpt_ros.<kind>``. Each folder of laws has the :class:`Kind` of its own.
"""

from collections import Counter
from functools import cache
from importlib.metadata import EntryPoint, EntryPoints, entry_points
from typing import Generic, TypeVar, cast

from fpt_ros.errors import BadInput
from fpt_ros.extras import remedy

Law = TypeVar("Law")


class Kind(Generic[Law]):
    """All laws of one kind, by name: ``PLANTS["tora"]``.

    Args:
        kind: the classes that its laws are instances of.
        group: of the entry points, without ``fpt_ros.``.
        called: what messages call them, where the group's name is no plural.
    """

    def __init__(
        self, kind: type[Law] | tuple[type[Law], ...], group: str, called: str = ""
    ) -> None:
        self._kind = kind
        self.group = group
        self.called = called or group

    def names(self) -> tuple[str, ...]:
        """All registered names, sorted."""
        return tuple(sorted(_points(self.group)))

    def __getitem__(self, name: str) -> Law:
        """The law registered as ``name``.

        Raises:
            BadInput: there is none, or it cannot be loaded.
        """
        law = _load(self.group, self.called, name)
        if not isinstance(law, self._kind):
            kinds = self._kind if isinstance(self._kind, tuple) else (self._kind,)
            wanted = " or ".join(kind.__name__ for kind in kinds)
            raise BadInput(
                f"'{name}' of the {self.called} is a {type(law).__name__}, not a {wanted}: name "
                f"the object in setup.py, {_points(self.group)[name].value.partition(':')[0]}:NAME"
            )
        return law


@cache
def _installed() -> EntryPoints:
    """The entry points of all packages: their files are read once."""
    return cast("EntryPoints", entry_points())  # Python 3.11 has another name for the same


def forget() -> None:
    """Look at the installed packages anew: there is another one since."""
    for each in (_installed, _points, _load):
        each.cache_clear()


@cache
def _points(group: str) -> dict[str, EntryPoint]:
    """The entry points of a group by name.

    Raises:
        BadInput: two packages have the same name.
    """
    found = _installed().select(group=f"fpt_ros.{group}")
    points = {(point.name, point.value): point for point in found}
    for name, count in Counter(name for name, _ in points).items():
        if count > 1:
            values = " and ".join(value for other, value in points if other == name)
            raise BadInput(
                f"two packages register '{name}' in the group fpt_ros.{group}, {values}: rename one"
            )
    return {name: point for (name, _), point in points.items()}


def _none_first(name: str) -> tuple[bool, str]:
    return name != "none", name


@cache
def _load(group: str, called: str, name: str) -> object:
    points = _points(group)
    if not points:
        raise BadInput(f"no {called} are registered: is fpt_ros installed? run make setup")
    if name not in points:
        raise BadInput(
            f"'{name}' is none of the {called}: {', '.join(sorted(points, key=_none_first))}"
        )
    try:
        return points[name].load()
    except SyntaxError as error:
        raise BadInput(
            f"'{name}' of the {called} cannot be loaded: {error.filename}, line {error.lineno}: "
            f"{error.msg}"
        ) from error
    except Exception as error:  # whatever a module of somebody else's does at its import
        first = str(error).splitlines()[0] if str(error) else type(error).__name__
        why = remedy(error) or first
        raise BadInput(
            f"'{name}' of the {called} cannot be loaded, entry point {points[name].value}: {why}"
        ) from error
