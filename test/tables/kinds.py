"""One record, 120 samples of a noisy sine, in the kinds of text that people have."""

import numpy as np

N = 120
T = np.round(np.arange(N) / 100, 2)
Y = np.round(np.sin(2 * np.pi * T / 0.37) + 0.1 * np.random.default_rng(5).standard_normal(N), 5)
ROWS = [(f"{t:.2f}", f"{y:.5f}") for t, y in zip(T, Y, strict=True)]


def text(separator=",", decimal=".", head=("t", "y"), quote="", rows=ROWS, end="\n", tail=""):
    """The record as text."""
    lines = [separator.join(head)] if head else []
    for row in rows:
        cells = [f"{quote}{cell.replace('.', decimal)}{quote}" for cell in row]
        lines.append(separator.join(cells) + tail)
    return end.join(lines) + end


PLAIN = text()


def with_line(number, line, base=PLAIN):
    """The record with one line, from 1, in the place of another."""
    lines = base.splitlines()
    lines[number - 1] = line
    return "\n".join(lines) + "\n"


def with_inserted(number, line, base=PLAIN):
    """The record with one line more; it gets this number."""
    lines = base.splitlines()
    lines.insert(number - 1, line)
    return "\n".join(lines) + "\n"


WHOLE = {
    "plain": PLAIN,
    "semicolons": text(";"),
    "semicolons and decimal commas": text(";", ","),
    "tabs": text("\t"),
    "tabs and decimal commas": text("\t", ","),
    "blanks": text(" "),
    "several blanks": text("   "),
    "blanks in front": "\n".join(f"  {line}" for line in text("  ").splitlines()) + "\n",
    "bars": text("|"),
    "comma and blank": text(", "),
    "quoted": text(quote='"'),
    "quoted decimal commas": text(",", ",", quote='"'),
    "carriage returns": text(end="\r"),
    "both line ends": text(end="\r\n"),
    "byte order mark": "\ufeff" + PLAIN,
    "comments": "# scope export\n# rate: 100 Hz\n" + PLAIN,
    "comments of MATLAB": "% scope export\n" + PLAIN,
    "comment among the rows": with_inserted(50, "# event"),
    "header in a comment": text(" ", head=("# t", "y")),
    "header of rostopic": text(",", head=("%t", "y")),
    "preamble": "Model,XYZ\nRate,100\n\n" + PLAIN,
    "preamble without an empty line": "Model,XYZ\n" + PLAIN,
    "preamble of words": "Exported by a logger on Monday\n\n" + PLAIN,
    "separator named": "sep=,\n" + PLAIN,
    "separator named for decimal commas": "sep=;\n" + text(";", ","),
    "header repeated": with_inserted(63, "t,y"),
    "separator behind the data": text(tail=","),
    "separator behind all": text(head=("t", "y", ""), tail=","),
    "tab behind the data": text("\t", tail="\t"),
    "no line break at the end": PLAIN.rstrip("\n"),
    "empty lines at the end": PLAIN + "\n\n",
    "exponents of Fortran": text(" ", rows=[(t, f"{y}D+00") for t, y in ROWS]),
    "minus of typographers": PLAIN.replace("-", "\u2212"),
}
"""All of them hold the same numbers under the names t and y."""

NAMELESS = {
    "no header": text(head=()),
    "no header, decimal commas": text(";", ",", head=()),
    "no header, comment": "# made by hand\n" + text(" ", head=()),
}
"""The same numbers under the names 0 and 1."""

LOST = {
    "word": ("0.60,ERR", "line 62 is 'ERR'"),
    "dash": ("0.60,-", ""),
    "nothing": ("0.60,", ""),
    "NaN": ("0.60,NaN", ""),
    "NA": ("0.60,NA", ""),
    "null": ("0.60,null", ""),
    "None": ("0.60,None", ""),
    "#N/A": ("0.60,#N/A", ""),
    "NUL": ("0.60,0.02031\0", "line 62 is '0.02031\\x00'"),
    "true": ("0.60,True", "line 62 is 'True'"),
}
"""Line 62, whose sample is missing then, and what is said about it."""
