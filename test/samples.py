"""Exhaustive tests take a sample, the same one every day; with ``--all`` they take everything."""

import random
from collections.abc import Sequence
from typing import TypeVar

Item = TypeVar("Item")

whole = False
"""Set by ``--all`` before tests are collected."""


def sample(items: Sequence[Item], count: int, keep: Sequence[Item] = ()) -> list[Item]:
    """Some of the items in their order, ``keep`` among them; all of them with ``--all``.

    Example: sample(range(1000), 40, keep=(0, 999)) are 40 numbers, 0 and 999 among them.
    """
    if whole or count >= len(items):
        return list(items)
    fixed = set(keep)
    others = [at for at, item in enumerate(items) if item not in fixed]
    drawn = set(random.Random(1).sample(others, count - len(fixed)))
    return [item for at, item in enumerate(items) if item in fixed or at in drawn]
