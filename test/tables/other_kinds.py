"""The record of :mod:`tables.kinds` in files that are no plain text."""

import bz2
import gzip
import io
import json
import lzma
import zipfile

import numpy as np
import pyarrow
import scipy.io
import zstandard
from pyarrow import feather, parquet
from scipy.io import wavfile
from tables.kinds import PLAIN, T, Y

ROWS = [{"t": t, "y": y} for t, y in zip(T.tolist(), Y.tolist(), strict=True)]
COLUMNS = {"t": T.tolist(), "y": Y.tolist()}


def zipped(name, content):
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        archive.writestr(name, content)
    return buffer.getvalue()


def saved(save):
    buffer = io.BytesIO()
    save(buffer)
    return buffer.getvalue()


ARROW = pyarrow.table(COLUMNS)

SAME = {
    "objects.json": json.dumps(ROWS).encode(),
    "columns.json": json.dumps(COLUMNS).encode(),
    "split.json": json.dumps(
        {"columns": ["t", "y"], "data": list(zip(T, Y, strict=True))}
    ).encode(),
    "of_pandas.json": json.dumps({k: dict(enumerate(v)) for k, v in COLUMNS.items()}).encode(),
    "lines.jsonl": "\n".join(map(json.dumps, ROWS)).encode(),
    "lines.csv": "\n\n".join(map(json.dumps, ROWS)).encode(),
    "s.npz": saved(lambda file: np.savez(file, t=T, y=Y, rate=100.0)),
    "fields.npy": saved(
        lambda file: np.save(file, np.array(list(zip(T, Y, strict=True)), dtype="f8,f8"))
    ),
    "s.mat": saved(lambda file: scipy.io.savemat(file, {"t": T, "y": Y, "rate": 100.0})),
    "s.parquet": saved(lambda file: parquet.write_table(ARROW, file)),
    "s.feather": saved(lambda file: feather.write_feather(ARROW, file)),
    "s.csv.gz": gzip.compress(PLAIN.encode()),
    "s.csv.zst": zstandard.compress(PLAIN.encode()),
    "two_frames.csv.zst": zstandard.compress(PLAIN[:500].encode())
    + zstandard.compress(PLAIN[500:].encode()),
    "s.csv.bz2": bz2.compress(PLAIN.encode()),
    "s.csv.xz": lzma.compress(PLAIN.encode()),
    "s.zip": zipped("s.csv", PLAIN),
}
"""The same numbers under the names t and y."""

SOUND = (1000 * Y).astype(np.int16)


def sound() -> bytes:
    """The record as a sound of 8 kHz, in whole numbers."""
    return saved(lambda file: wavfile.write(file, 8000, SOUND))
