"""The two trees: a commit beside the working tree, each run with its own code and entry points."""

import hashlib
import io
import json
import os
import shutil
import subprocess
import sys
import tarfile
from collections.abc import Callable
from dataclasses import asdict, dataclass
from importlib.metadata import version
from pathlib import Path
from tempfile import mkdtemp

from cases import Case

ROOT = Path(__file__).resolve().parents[2]
CACHE = ROOT / ".same_bits"
DUMPER = Path(__file__).with_name("dumper.py")

METADATA = "from setuptools import build_meta as b; b.prepare_metadata_for_build_wheel({!r})"
"""Writes what an installation would: name, version and entry points of a tree."""


class Failed(Exception):
    """A comparison cannot be made: one line that says why, and the exit status."""

    def __init__(self, why: str, status: int = 2) -> None:
        super().__init__(why)
        self.status = status


@dataclass(frozen=True)
class Tree:
    """A tree of this project's sources.

    Attributes:
        root: folder of its ``setup.py``.
        metadata: folder with its entry points.
    """

    root: Path
    metadata: Path

    @property
    def digest(self) -> str:
        """Tells its Python code from any other."""
        digest = hashlib.sha256()
        for path in sorted((self.root / "fpt_ros").rglob("*.py")):
            digest.update(str(path.relative_to(self.root)).encode() + b"\0" + path.read_bytes())
        return digest.hexdigest()[:16]

    def environment(self) -> dict[str, str]:
        """In which a Python runs this tree's code, with its entry points.

        Machine code is kept by the tree's whole source, so that no code of another commit is met.
        """
        environment = {k: v for k, v in os.environ.items() if k not in UNWANTED}
        environment["PYTHONPATH"] = os.pathsep.join(map(str, (self.metadata, self.root)))
        environment["XDG_CACHE_HOME"] = str(CACHE / "compiled" / self.digest)
        return environment

    def run(self, cases: list[Case], folder: Path, done: Callable[[str], None]) -> None:
        """Run cases in this tree, one after the other, and keep each in the folder.

        Raises:
            Failed: the tree's code cannot be imported, or was killed.
        """
        words = [sys.executable, str(DUMPER), str(self.root), str(folder)]
        given = json.dumps([asdict(case) | {"file": case.file} for case in cases])
        pipe = subprocess.PIPE
        with subprocess.Popen(
            words, stdin=pipe, stdout=pipe, text=True, env=self.environment(), cwd=self.root
        ) as process:
            assert process.stdin is not None
            assert process.stdout is not None
            try:
                process.stdin.write(given)
                process.stdin.close()
                for line in process.stdout:
                    done(line.rstrip("\n"))
            except BrokenPipeError:
                pass  # it has said why
            except BaseException:
                process.terminate()
                raise
        if process.returncode:
            raise Failed(f"the tree {self.root} does not run: see above", status=1)


UNWANTED = ("NUMBA_CACHE_DIR", "NUMBA_DISABLE_JIT", "AMENT_PREFIX_PATH", "PYTHONHOME")


def commit_of(revision: str) -> str:
    """The hash of a revision.

    Raises:
        Failed: there is none of this name.
    """
    words = ["git", "rev-parse", "--quiet", "--verify", "--end-of-options", revision + "^{commit}"]
    found = subprocess.run(words, cwd=ROOT, capture_output=True, text=True)
    if found.returncode:
        raise Failed(f"no commit '{revision}' in {ROOT}: git log shows what there is")
    return found.stdout.strip()


def old_tree(commit: str) -> Tree:
    """A commit's tree in the cache, taken out of git once."""
    folder = CACHE / commit[:12]
    if not folder.is_dir():
        CACHE.mkdir(exist_ok=True)
        part = Path(mkdtemp(prefix="part-", dir=CACHE))
        try:
            packed = subprocess.run(
                ["git", "archive", commit], cwd=ROOT, capture_output=True, check=True
            )
            with tarfile.open(fileobj=io.BytesIO(packed.stdout)) as archive:
                archive.extractall(part / "tree", filter="data")
            _write_metadata(part / "tree", part / "metadata")
            part.rename(folder)
        except BaseException:
            shutil.rmtree(part, ignore_errors=True)
            raise
    return Tree(folder / "tree", folder / "metadata")


def new_tree(folder: Path) -> Tree:
    """The working tree as it is; its entry points go into the folder."""
    _write_metadata(ROOT, folder / "metadata")
    return Tree(ROOT, folder / "metadata")


def results_of(commit: str) -> Path:
    """Where a commit's results are kept: by processor and libraries, which make the last bit."""
    cpu = Path("/proc/cpuinfo")
    lines = cpu.read_text().splitlines() if cpu.exists() else []
    model = next((line for line in lines if line.startswith("model name")), "")
    versions = [f"{name} {version(name)}" for name in ("numpy", "numba", "llvmlite", "scipy")]
    sources = [path.read_text() for path in (DUMPER, DUMPER.with_name("cases.py"))]
    key = repr((model, os.uname().machine, sys.version, versions, sources))
    name = hashlib.sha256(key.encode()).hexdigest()[:12]
    folder = CACHE / commit[:12] / f"results-{name}"
    folder.mkdir(exist_ok=True)
    return folder


def forget_machine_code(keep: str) -> None:
    """Remove compiled code of all trees but one; it comes back in half a minute."""
    for folder in (CACHE / "compiled").glob("*"):
        if folder.name != keep:
            shutil.rmtree(folder, ignore_errors=True)


def _write_metadata(root: Path, folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    words = [sys.executable, "-W", "ignore", "-c", METADATA.format(str(folder))]
    made = subprocess.run(words, cwd=root, capture_output=True, text=True)
    if made.returncode:
        last = made.stderr.strip().splitlines()[-1:]
        raise Failed(f"no entry points from {root}/setup.py: {' '.join(last)}", status=1)
    for extra in folder.glob("*.egg-info"):  # an older form of the same
        shutil.rmtree(extra)
