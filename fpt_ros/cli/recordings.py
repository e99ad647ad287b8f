"""What commands that read recordings say of those that are not whole."""

import sys
from collections.abc import Iterable
from pathlib import Path

SHOWN = 5
"""Lines of one recording; of the rest their number."""


def say(bag: Path, lines: Iterable[str]) -> None:
    """A line each on standard error."""
    found = list(lines)
    for line in found[:SHOWN]:
        print(f"{bag}: {line}", file=sys.stderr)
    if len(found) > SHOWN:
        print(f"{bag}: {len(found) - SHOWN} more (fpt info {bag})", file=sys.stderr)
