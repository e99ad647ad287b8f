"""Switches of a loop: constants that choose between ways, known when its code is made.

A specialised loop holds the ways that its switches choose and no others. What is left out costs
nothing then, not even the place of what it would have needed.
"""

from collections.abc import Iterator, Mapping
from functools import cache
from typing import Any, get_type_hints

from fpt_ros.laws import Switch

Switches = tuple[tuple[str, int], ...]
"""Values by place: ``("constants.deformer.adapts", 1)``."""


def read(argument: str, record: Any) -> Switches:
    """The switches of a record, which is this argument of the loop."""
    return tuple(_values(argument, record))


def written(arguments: Mapping[str, Any], values: Switches) -> tuple[str, dict[str, Any]]:
    """A loop's arguments as text, their switches as numbers; and the classes that it names.

    For example, of a record with one switch and one vector::

        >>> class Way(NamedTuple):
        ...     order: Switch
        ...     factors: Vector
        >>> written({"first": int, "way": Way}, (("way.order", 2),))[0]
        'first, Way(2, way.factors)'
    """
    known, classes = dict(values), {}

    def text(place: str, kind: Any) -> str:
        if not any(each.startswith(f"{place}.") for each in known):
            return str(known.get(place, place))
        classes[kind.__name__] = kind
        fields = get_type_hints(kind)
        return f"{kind.__name__}({', '.join(text(f'{place}.{f}', fields[f]) for f in fields)})"

    return ", ".join(text(name, kind) for name, kind in arguments.items()), classes


def _values(place: str, record: Any) -> Iterator[tuple[str, int]]:
    kind: Any = type(record)
    for field, switch in _fields(kind):
        value = getattr(record, field)
        if switch:
            yield f"{place}.{field}", int(value)
        else:
            yield from _values(f"{place}.{field}", value)


@cache
def _fields(kind: Any) -> tuple[tuple[str, bool], ...]:
    """Those of a record that are switches, and those that are records."""
    hints = get_type_hints(kind, include_extras=True) if hasattr(kind, "_fields") else {}
    return tuple(
        (name, hint == Switch)
        for name, hint in hints.items()
        if hint == Switch or hasattr(hint, "_fields")
    )
