"""A file's plain bytes: from disk or standard input, compressed or not."""

import bz2
import gzip
import lzma
import shutil
import sys
import zipfile
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryFile
from typing import BinaryIO, cast

import zstandard

from fpt_ros.errors import BadInput

STDIN = "-"

BROKEN = (EOFError, OSError, zlib.error, lzma.LZMAError, zstandard.ZstdError, zipfile.BadZipFile)
"""What the libraries raise where compressed data is cut or damaged."""


@dataclass(frozen=True)
class Opened:
    """An open file.

    Attributes:
        file: its plain bytes; can be sought in.
        name: what messages call it.
        suffix: of the file inside of what was compressed, in small letters.
        size: [bytes].
    """

    file: BinaryIO
    name: str
    suffix: str
    size: int

    def head(self, count: int) -> bytes:
        """The first bytes; afterwards the file is at its beginning."""
        self.file.seek(0)
        data = self.file.read(count)
        self.file.seek(0)
        return data


@contextmanager
def opened(path: Path) -> Iterator[Opened]:
    """Open a file; ``-`` is standard input. What is compressed is unpacked to a temporary file.

    Raises:
        BadInput: it cannot be read, or is damaged, or holds several files.
    """
    name = "standard input" if str(path) == STDIN else str(path)
    try:
        with _plain(path) as (file, inner):
            size = file.seek(0, 2)
            file.seek(0)
            yield Opened(file, name, Path(inner).suffix.lower(), size)
    except OSError as error:
        raise BadInput(f"{name} cannot be read: {error.strerror or error}") from error


@contextmanager
def _plain(path: Path) -> Iterator[tuple[BinaryIO, str]]:
    if str(path) == STDIN:
        with TemporaryFile() as spooled:
            shutil.copyfileobj(sys.stdin.buffer, spooled)
            with _unpacked(spooled, "standard input") as (file, inner):
                yield file, inner
        return
    with path.open("rb") as raw, _unpacked(raw, str(path)) as (file, inner):
        yield file, inner


@contextmanager
def _unpacked(raw: BinaryIO, name: str) -> Iterator[tuple[BinaryIO, str]]:
    raw.seek(0)
    magic = raw.read(6)
    raw.seek(0)
    inner = name
    unpack = next((make for start, make in PACKED if magic.startswith(start)), None)
    if unpack is None:
        if not magic.startswith(b"PK\x03\x04"):
            yield raw, name
            return
        inner = _member(raw, name)
        if not inner:
            yield raw, name
            return
        unpack = _unzip
    elif Path(name).suffix.lower() in SUFFIXES:
        inner = str(Path(name).with_suffix(""))
    with TemporaryFile() as plain:
        try:
            shutil.copyfileobj(unpack(raw), plain)
        except BROKEN as error:
            raise BadInput(
                f"{name} cannot be unpacked: it is cut or damaged; give a whole one"
            ) from error
        yield plain, inner


def _member(raw: BinaryIO, name: str) -> str:
    """The one file in a zip archive; empty where the archive is a kind of its own (npz)."""
    try:
        members = [one.filename for one in zipfile.ZipFile(raw).infolist() if not one.is_dir()]
    except zipfile.BadZipFile as error:
        raise BadInput(f"{name} is a damaged zip archive: give a whole one") from error
    finally:
        raw.seek(0)
    if "xl/workbook.xml" in members:
        raise BadInput(f"{name} is an Excel workbook: save the sheet as CSV")
    if members and all(member.endswith(".npy") for member in members):
        return ""
    members = [one for one in members if not one.startswith("__MACOSX/")]
    if len(members) != 1:
        listed = ", ".join(members[:5]) or "nothing"
        raise BadInput(f"{name} has to hold one file, it holds {len(members)}: {listed}")
    return members[0]


def _unzip(raw: BinaryIO) -> BinaryIO:
    archive = zipfile.ZipFile(raw)
    name = next(one for one in archive.namelist() if not one.startswith("__MACOSX/"))
    return cast(BinaryIO, archive.open(name))


def _unzstd(raw: BinaryIO) -> BinaryIO:
    return cast(BinaryIO, zstandard.ZstdDecompressor().stream_reader(raw, read_across_frames=True))


def _unxz(raw: BinaryIO) -> BinaryIO:
    return cast(BinaryIO, lzma.LZMAFile(raw))


PACKED: tuple[tuple[bytes, Callable[[BinaryIO], BinaryIO]], ...] = (
    (b"\x1f\x8b", lambda raw: cast(BinaryIO, gzip.GzipFile(fileobj=raw))),
    (b"\x28\xb5\x2f\xfd", _unzstd),
    (b"BZh", lambda raw: cast(BinaryIO, bz2.BZ2File(raw))),
    (b"\xfd7zXZ\x00", _unxz),
)
"""First bytes of what is compressed, and what unpacks it."""

SUFFIXES = frozenset((".gz", ".zst", ".zstd", ".bz2", ".xz", ".zip"))
"""That stand behind the one of the file inside."""
