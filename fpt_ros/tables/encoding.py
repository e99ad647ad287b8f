"""How a text's characters are encoded: by its byte order mark, by its NULs, or by trying."""

import codecs
import io
from typing import BinaryIO

MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
"""That of UTF-32 begins as that of UTF-16, so it comes first."""

BLOCK = 1 << 20
SHOWN = {"utf-8-sig": "UTF-8", "utf-8": "UTF-8", "cp1252": "Windows-1252", "latin-1": "Latin-1"}


def encoding(file: BinaryIO) -> str:
    """Python's name for the encoding of all the text; the file is left at its beginning."""
    file.seek(0)
    head = file.read(4096)
    file.seek(0)
    for mark, name in MARKS:
        if head.startswith(mark):
            return name
    even, odd = head[::2].count(0), head[1::2].count(0)
    if even + odd > len(head) // 4:  # without a mark: every second byte is NUL
        return "utf-16-le" if odd > even else "utf-16-be"
    for name in ("utf-8", "cp1252"):
        if _decodes(file, name):
            return name
    return "latin-1"


def _decodes(file: BinaryIO, name: str) -> bool:
    decoder = codecs.getincrementaldecoder(name)()
    try:
        while block := file.read(BLOCK):
            decoder.decode(block)
        decoder.decode(b"", final=True)
    except UnicodeDecodeError:
        return False
    finally:
        file.seek(0)
    return True


def text(file: BinaryIO, name: str) -> io.TextIOWrapper:
    """The whole text in this encoding; any line ending counts. ``detach`` it after use.

    What a UTF-16 text has lost at its end (half a character) is replaced by a mark.
    """
    file.seek(0)
    return io.TextIOWrapper(file, encoding=name, errors="replace", newline=None)


def shown(name: str) -> str:
    """The encoding's name for people."""
    return SHOWN.get(name, name.upper())
