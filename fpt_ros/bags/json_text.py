"""Messages written as JSON: their numbers by path, as of all other messages."""

import json
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fpt_ros.bags.layout import Bytes, Layout, Leaf, Malformed


def layout(data: bytes) -> Layout:
    """The numbers of one message; another message has a layout of its own.

    Raises:
        Malformed: it is not JSON.
    """
    try:
        content = json.loads(data)
    except (ValueError, RecursionError) as error:
        raise Malformed("it is not JSON") from error
    return _Json(data, list(_walk(content, "")))


class _Json(Layout):
    def __init__(self, data: bytes, found: list[tuple[str, Any]]) -> None:
        self._values = {path: value for path, value in found if not isinstance(value, str)}
        leaves = [Leaf(path, 0, "<f8", None, False) for path in self._values]
        texts = {path: value for path, value in found if isinstance(value, str)}
        super().__init__(data, leaves, texts, [(0, len(data))])

    def numbers(self, messages: Bytes, leaf: Leaf) -> NDArray[Any]:
        """(n, 1): the same in all, for they are the same bytes."""
        return np.full((len(messages), 1), float(self._values[leaf.path]))


def _walk(content: Any, path: str) -> Iterator[tuple[str, Any]]:
    if isinstance(content, dict):
        for key, value in content.items():
            yield from _walk(value, f"{path}.{key}" if path else key)
    elif isinstance(content, list):
        for i, value in enumerate(content):
            yield from _walk(value, f"{path}[{i}]")
    elif content is not None:
        yield path, content
