"""A consumer that keeps all that an engine gives."""

from fpt_ros.runs.chunks import Chunk, joined
from fpt_ros.runs.run import Series


class Consumed:
    """Keeps copies: the engine uses its arrays again."""

    def __init__(self) -> None:
        self._parts: dict[str, list[Series]] = {}

    def take(self, chunk: Chunk) -> None:
        for name, series in chunk.items():
            self._parts.setdefault(name, []).append(series.copy())

    def topics(self) -> dict[str, Series]:
        return {name: joined(parts) for name, parts in self._parts.items()}
