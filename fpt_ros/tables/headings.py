"""What a column's heading says: its name and its unit."""

import re
from collections.abc import Sequence

_BASE = (
    r"(?:[kMGmuµμnpfc]|milli|micro)?"
    r"(?:s|sec|Hz|V|A|W|N|Nm|N·m|N\.m|N\*m|Pa|g|m|rad|T|F|H|J|C|Ω|[Oo]hm|bar|L|l|eV|mol|cd|B)"
)
_OTHER = (
    r"min|h|hr|d|days?|hours?|minutes?|seconds?|msec|usec|deg|degrees|°C?|°F|degC|degF|K|psi|rpm"
    r"|g's|ppm|ppb|dB|dBm|dBFS|dBA|lsb|LSB|counts?|cts|ticks?|steps?|samples?|px|%|‰|in|inch|ft|mph"
    r"|kph|kn|lb|lbf|oz|gal|Torr|mmHg|cP|VA|VAr|kgf|n/a|none|Smp|Avg|1|-"
)
_FACTOR = rf"(?:{_BASE}|{_OTHER})(?:\^?-?\d|[²³⁻¹]+)?"
UNIT = re.compile(rf"{_FACTOR}(?:[ ]?[·*/.][ ]?\(?{_FACTOR}\)?)*")
"""Units that measuring people write."""

BEHIND = re.compile(r"(?P<name>.*?)\s*(?:\[(?P<square>[^\[\]]*)\]|\((?P<round>[^()]*)\))\s*")
OVER = re.compile(r"(?P<name>[^/]+?)(?:\s+/\s*|/)(?P<unit>[^/\s]+)")
"""As in ``t/s``, of times only, and ``U / V``."""

TIME_UNITS = {
    **dict.fromkeys(("s", "sec", "secs", "second", "seconds"), 1.0),
    **dict.fromkeys(("ms", "msec", "millis", "milliseconds"), 1e-3),
    **dict.fromkeys(("us", "µs", "μs", "usec", "micros", "microseconds"), 1e-6),
    **dict.fromkeys(("ns", "nsec", "nanos", "nanoseconds"), 1e-9),
    **dict.fromkeys(("min", "minute", "minutes"), 60.0),
    **dict.fromkeys(("h", "hr", "hour", "hours"), 3600.0),
    **dict.fromkeys(("d", "day", "days"), 86400.0),
}
"""Units of time [s]."""

TIME_NAME = re.compile(
    r"(?:[%#\s]*)(?:t|time|zeit|temps|tiempo|tempo|tid|stamp|time[ _]?stamp|date|datum|clock|epoch"
    r"|date[ _/-]?time|elapsed|elapsed[ _]?time|rel(?:ative)?[ _]?time|abs(?:olute)?[ _]?time"
    r"|unix[ _]?time|log[ _]?time|receive[ _]?time|secs?|seconds?|time[ _]?(?:since|from)[ _]\w+"
    r"|.*[._/]stamp|.*[._/ ]?time_?stamp|__time)"
    r"(?:[._ ](?P<unit>s|sec|secs|seconds|ms|msec|millis|us|usec|µs|micros|ns|nsec|nanos))?",
    re.I,
)
"""Names of columns of times; a unit may follow. ``T`` alone is a temperature."""

WHOLE_NAMES = {"millis": "ms", "micros": "us", "nanos": "ns"}
INDEX_NAME = re.compile(r"|#|no\.?|n|i|idx|index|samples?|sample[ _]?(?:no\.?|number|index)", re.I)
"""Names of columns that count the rows."""


def is_unit(cell: str) -> bool:
    """Whether a cell of a row below the header can be a unit, as in ``V``, ``[m/s]``, ``(-)``."""
    text = cell.strip()
    if text[:1] + text[-1:] in ("[]", "()"):
        return True
    return not text or bool(UNIT.fullmatch(text))


def split(heading: str) -> tuple[str, str]:
    """Name and unit; the unit is empty where the heading has none."""
    text = " ".join(heading.split())
    match = BEHIND.fullmatch(text)
    if match and match["name"]:
        unit = (match["square"] or match["round"] or "").strip()
        if UNIT.fullmatch(unit) and not unit.isdigit():
            return match["name"], "" if unit == "-" else unit
    match = OVER.fullmatch(text)
    if match and UNIT.fullmatch(match["unit"]):
        spaced = re.search(r"\s/", text)
        if spaced or (is_time_name(match["name"]) and match["unit"] in TIME_UNITS):
            return match["name"].strip(), match["unit"]
    if text.casefold() in WHOLE_NAMES:
        return text, WHOLE_NAMES[text.casefold()]
    match = TIME_NAME.fullmatch(text)
    return text, (match["unit"] or "").casefold() if match else ""


def is_time_name(name: str) -> bool:
    """Whether a column of this name is one of times."""
    text = name.strip()
    return text != "T" and (bool(TIME_NAME.fullmatch(text)) or text.casefold() in WHOLE_NAMES)


def is_index_name(name: str) -> bool:
    """Whether a column of this name counts the rows."""
    return bool(INDEX_NAME.fullmatch(name.strip()))


def are_units(cells: Sequence[str]) -> bool:
    """Whether the cells of a row are units."""
    return all(map(is_unit, cells)) and any(cell.strip() for cell in cells)


def bare(unit: str) -> str:
    """A unit without brackets; empty for ``-`` and its like."""
    text = unit.strip()
    if text[:1] + text[-1:] in ("[]", "()"):
        text = text[1:-1].strip()
    return "" if text.casefold() in ("-", "1", "n/a", "none") else text
