"""The thesis's figures one by one."""


def numbers(figures: str) -> list[str]:
    """The single figures of a text: ``2.1-2.3, 3.4`` are 2.1, 2.2, 2.3 and 3.4."""
    found = []
    for part in filter(None, figures.split(", ")):
        first, _, last = part.partition("-")
        chapter, _, start = first.partition(".")
        end = last.partition(".")[2] or start
        found += [f"{chapter}.{i}" for i in range(int(start), int(end) + 1)]
    return found
