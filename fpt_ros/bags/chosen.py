"""Topics of a recording that a user asks for by name."""

from fpt_ros.bags.bag import Bag
from fpt_ros.bags.block import Source
from fpt_ros.errors import BadInput


class Chosen:
    """Some topics, or all; with the slash in front or without."""

    def __init__(self, topics: tuple[str, ...]) -> None:
        self._wanted = {_absolute(topic) for topic in topics}

    def __call__(self, source: Source) -> bool:
        """Whether it is one of them."""
        return not self._wanted or _absolute(source.topic) in self._wanted

    def check(self, bag: Bag) -> None:
        """Each of them is there; for when the recording has been read.

        Raises:
            BadInput: one is not.
        """
        names = {_absolute(source.topic) for source in bag.kinds}
        for topic in sorted(self._wanted - names):
            there = ", ".join(sorted(names)) or "none"
            raise BadInput(f"{bag.path} has no topic '{topic}': there are {there}")


def _absolute(topic: str) -> str:
    return f"/{topic.lstrip('/')}"
