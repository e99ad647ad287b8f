"""Reading a table of any kind: the kind is found from the first bytes, not from the name."""

from pathlib import Path

from fpt_ros.errors import BadInput
from fpt_ros.tables.arrays import read_mat, read_npy, read_npz, read_wav
from fpt_ros.tables.arrow import read_arrow
from fpt_ros.tables.encoding import encoding
from fpt_ros.tables.objects import is_objects, read_objects
from fpt_ros.tables.opening import Opened, opened
from fpt_ros.tables.table import Table
from fpt_ros.tables.text import Done, read_text

TAKES = "CSV and other text, JSON, NPY, NPZ, Parquet, MAT and WAV, compressed or not"
"""What can be read, for messages."""

FOREIGN = (
    (b"SQLite format 3\0", "is a database file, as of a recording: give the recording's folder"),
    (b"\x89MCAP0\r\n", "is an MCAP recording: name it .mcap"),
    (b"\x89HDF\r\n\x1a\n", "is an HDF5 file: save the signal as NPY, Parquet or CSV"),
    (b"\xd0\xcf\x11\xe0", "is an Excel workbook: save the sheet as CSV"),
    (b"#ROSBAG V2.0", "is a ROS 1 bag: name it .bag"),
    (b"\x89PNG", f"is a picture: it takes {TAKES}"),
    (b"%PDF", f"is a PDF: it takes {TAKES}"),
)
"""First bytes of what is no table, and what would be right."""


def read(path: Path, wanted: str | None = None, done: Done = lambda _: None) -> Table:
    """Read a table.

    Args:
        path: a file; ``-`` is standard input.
        wanted: name of a column, for files that hold arrays of several lengths.
        done: is told how many bytes of a text have been read.

    Raises:
        BadInput: in one line, with the line of the file where one is wrong.
    """
    with opened(path) as file:
        return _read(file, wanted, done)


def _read(file: Opened, wanted: str | None, done: Done) -> Table:
    head = file.head(4096)
    if not head:
        raise BadInput(f"{file.name} is empty: it takes a table with one signal a column")
    for start, complaint in FOREIGN:
        if head.startswith(start):
            raise BadInput(f"{file.name} {complaint}")
    if head.startswith(b"\x93NUMPY"):
        return read_npy(file)
    if head.startswith(b"PK\x03\x04"):
        return read_npz(file, wanted)
    if head.startswith(b"PAR1"):
        return read_arrow(file, parquet=True)
    if head.startswith((b"ARROW1", b"FEA1")):
        return read_arrow(file, parquet=False)
    if head.startswith((b"RIFF", b"RIFX", b"RF64")):
        return read_wav(file)
    if head.startswith(b"MATLAB ") or file.suffix == ".mat":
        return read_mat(file, wanted)
    if file.suffix in (".npy", ".npz", ".parquet", ".feather", ".wav"):
        raise BadInput(f"{file.name} is no {file.suffix[1:].upper()} file, whatever its name says")
    code = encoding(file.file)
    if is_objects(head.decode(code, errors="ignore")):
        return read_objects(file)
    odd = sum(byte < 32 and byte not in b"\t\n\r\f\x1a\x1b\0" for byte in head)
    if odd > len(head) // 20 and not code.startswith(("utf-16", "utf-32")):
        raise BadInput(f"{file.name} is of a kind that cannot be read: it takes {TAKES}")
    return read_text(file, done)
