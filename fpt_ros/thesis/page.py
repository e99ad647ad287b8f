"""The page about what of the thesis reproduces: claims judged by runs, on all cores."""

import base64
import io
import json
import math
import multiprocessing
import os
import re
import signal
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from fpt_ros import __version__
from fpt_ros.analysis import pages, style
from fpt_ros.analysis.tables import number_text
from fpt_ros.analysis.whole_files import write_whole
from fpt_ros.errors import BadInput, RunFailed
from fpt_ros.thesis.claim import STATUSES, Chapter, Claim, Picture, Setup, Source, Verdict, chapters
from fpt_ros.thesis.commands import commands

TEMPLATE = "page.html.j2"
DPI = 110
COLOURS = 128


@dataclass(frozen=True)
class Shown:
    """A picture as the page has it; ``data``: PNG."""

    thesis: str
    title: str
    caption: str
    data: bytes


@dataclass(frozen=True)
class Outcome:
    """What became of one claim.

    Attributes:
        endings: of its runs that did not come to their end, by key: why.
    """

    verdict: Verdict
    pictures: tuple[Shown, ...]
    endings: Mapping[str, str]


def wanted(numbers: Sequence[int]) -> list[Chapter]:
    """Chapters by their numbers; all where there are none.

    Raises:
        BadInput: one of them has no claims.
    """
    known = chapters()
    for number in numbers:
        if number not in known:
            valid = ", ".join(map(str, known))
            raise BadInput(f"--chapter {number}: it takes one of {valid}")
    return [chapter for number, chapter in known.items() if number in numbers or not numbers]


def judge_all(
    asked: Sequence[Chapter], progress: Callable[[int], None], workers: int | None = None
) -> dict[str, Outcome]:
    """Make all runs of the claims, judge and draw them, in processes of their own.

    Args:
        asked: chapters.
        progress: is told how many claims are done.
        workers: processes; ``None``: as many as there are cores to use.

    Returns:
        By claim, in the order of the chapters.

    Raises:
        RunFailed: a worker was killed.
        KeyboardInterrupt: Ctrl-C; the workers are ended.
    """
    tasks = [(chapter.number, name) for chapter in asked for name in chapter.claims]
    before = set(multiprocessing.active_children())
    found: dict[str, Outcome] = {}
    pool = ProcessPoolExecutor(
        min(workers or len(os.sched_getaffinity(0)), len(tasks)),
        multiprocessing.get_context("spawn"),
    )
    try:
        # the longest first, so that no core waits for it at the end
        order = sorted(tasks, key=lambda task: -_effort(chapters()[task[0]].claims[task[1]]))
        with _held_interrupts(), _one_thread_each():  # by the workers too, which are started here
            futures = {pool.submit(outcome_of, *task): task[1] for task in order}
        progress(0)
        for done, future in enumerate(as_completed(futures), 1):
            found[futures[future]] = future.result()
            progress(done)
    except BrokenProcessPool as error:
        raise RunFailed(
            "a worker process was killed, most likely for want of memory: a core takes up to 1 GB"
        ) from error
    except BaseException:
        for process in set(multiprocessing.active_children()) - before:
            process.terminate()
        raise
    finally:
        pool.shutdown(cancel_futures=True)
    return {name: found[name] for _, name in tasks}


@contextmanager
def _held_interrupts() -> Iterator[None]:
    """Processes that are started meanwhile never see Ctrl-C: the parent ends them.

    They inherit the blocked signal. One that comes meanwhile waits, and is not lost.
    """
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def _one_thread_each() -> Iterator[None]:
    """Processes that are started meanwhile do their linear algebra on one thread.

    There are as many of them as cores; small systems on more threads only wait for each other.
    """
    names = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")
    before = {name: os.environ.get(name) for name in names}
    os.environ.update(dict.fromkeys(names, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def _effort(claim: Claim[Any]) -> float:
    """A rough measure of how long a claim takes."""
    return sum(source.effort for source in claim.runs.values()) + 4.0 * len(claim.pictures)


def outcome_of(chapter: int, name: str) -> Outcome:
    """Make the runs of one claim, judge them, and draw its pictures."""
    claim = chapters()[chapter].claims[name]
    runs = claim.perform()
    endings = {key: claim.runs[key].ending(result) for key, result in runs.items()}
    endings = {key: reason for key, reason in endings.items() if reason}
    with style.settings():
        pictures = [_shown(picture, runs) for picture in claim.pictures]
    return Outcome(claim.judge(runs), tuple(p for p in pictures if p is not None), endings)


def _shown(picture: Picture[Any], runs: Mapping[str, Any]) -> Shown | None:
    drawn = picture.draw(runs)
    if drawn is None:
        return None
    figure, remarks = drawn
    caption = " ".join(filter(None, [picture.caption, *remarks]))
    return Shown(picture.thesis, picture.title, caption, _png(figure))


def _png(figure: Figure) -> bytes:
    """The figure in few colours: a third of the size, and nothing to be seen of it."""
    canvas = FigureCanvasAgg(figure)
    figure.set_dpi(DPI)
    canvas.draw()  # type: ignore[no-untyped-call]
    pixels = np.asarray(canvas.buffer_rgba())  # type: ignore[no-untyped-call]
    image = Image.fromarray(pixels[:, :, :3].copy())
    buffer = io.BytesIO()
    image.quantize(COLOURS, Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE).save(
        buffer, format="png", optimize=True
    )
    return buffer.getvalue()


def as_json(asked: Sequence[Chapter], found: Mapping[str, Outcome]) -> dict[str, object]:
    """All verdicts as one object; a number that does not exist is ``None``."""
    claims = []
    for chapter in asked:
        for name, claim in chapter.claims.items():
            outcome = found[name]
            verdict = outcome.verdict
            claims.append(
                {
                    "id": name,
                    "chapter": chapter.number,
                    "section": claim.section,
                    "figures": claim.figures,
                    "claim": claim.text,
                    "status": verdict.status,
                    "measured": {key: _plain(value) for key, value in verdict.measured.items()},
                    "reason": verdict.reason,
                    "table": None
                    if verdict.table is None
                    else [list(verdict.table.headings), *map(list, verdict.table.rows)],
                    "not_complete": dict(outcome.endings),
                    "runs": {key: setup.command() for key, setup in claim.runs.items()},
                }
            )
    counted = count(found.values())
    return {"version": __version__, "count": counted, "claims": claims}


def _plain(value: float | str | None) -> float | str | None:
    if isinstance(value, float | int):
        return float(value) if math.isfinite(value) else None
    return value


def count(outcomes: Iterable[Outcome]) -> dict[str, int]:
    """How many claims have which status."""
    counter = Counter(one.verdict.status for one in outcomes)
    return {status: counter[status] for status in STATUSES}


def write_page(
    asked: Sequence[Chapter], found: Mapping[str, Outcome], directory: Path, seconds: float
) -> Path:
    """Write ``index.html`` (complete in itself) and ``claims.json``, each whole or not at all.

    Args:
        asked, found: chapters, and what became of their claims.
        directory: made where it does not exist; files of an older page are replaced.
        seconds: how long it took.

    Returns:
        Path of the page.

    Raises:
        BadInput: the directory cannot be written.
    """
    text = json.dumps(as_json(asked, found), indent=2, allow_nan=False, ensure_ascii=False) + "\n"
    page = _page(asked, found, seconds)
    try:
        directory.mkdir(parents=True, exist_ok=True)
        write_whole(directory / "claims.json", text.encode())
        write_whole(directory / "index.html", page.encode())
    except OSError as error:
        raise cannot_write(directory, error) from error
    return directory / "index.html"


def check_directory(directory: Path) -> None:
    """The page can be written there: better said before the runs than after.

    Raises:
        BadInput: it cannot.
    """
    there = directory.absolute()
    while not there.exists():
        there = there.parent
    if not there.is_dir() or not os.access(there, os.W_OK):
        why = "is not a directory" if not there.is_dir() else "cannot be written to"
        raise BadInput(f"--out {directory}: {there} {why}, give a directory that can be written")


def cannot_write(directory: Path, error: OSError) -> BadInput:
    """What to say where writing fails."""
    reason = error.strerror or str(error)
    return BadInput(
        f"cannot write the page to {directory}: {reason}; it takes a directory to write to"
    )


@dataclass(frozen=True)
class Block:
    """A claim as the page shows it."""

    name: str
    claim: Claim[Any]
    outcome: Outcome
    measured: tuple[tuple[str, str], ...]
    commands: tuple[str, ...]
    pictures: tuple[tuple[Shown, str], ...]
    kind: str


def _page(asked: Sequence[Chapter], found: Mapping[str, Outcome], seconds: float) -> str:
    blocks = {
        chapter.number: [_block(name, claim, found[name]) for name, claim in chapter.claims.items()]
        for chapter in asked
    }
    sources = [
        _kind(source)
        for chapter in asked
        for claim in chapter.claims.values()
        for source in claim.runs.values()
    ]
    return pages.render(
        TEMPLATE,
        package=__package__,
        chapters=asked,
        blocks=blocks,
        count=count(found.values()),
        runs=sources.count("run"),
        trials=sources.count("trial"),
        pictures=sum(len(outcome.pictures) for outcome in found.values()),
        seconds=seconds,
        version=__version__,
    )


def _kind(source: Source[Any]) -> str:
    return "run" if isinstance(source, Setup) else "trial"


def _block(name: str, claim: Claim[Any], outcome: Outcome) -> Block:
    measured = tuple(
        (label.strip(), number_words(value)) for label, value in outcome.verdict.measured.items()
    )
    pictures = tuple((p, base64.b64encode(p.data).decode()) for p in outcome.pictures)
    kind = next(map(_kind, claim.runs.values()), "")
    return Block(name, claim, outcome, measured, tuple(commands(claim)), pictures, kind)


def number_words(value: float | str | None) -> str:
    """A measured quantity in words."""
    if value is None:
        return "–"
    if isinstance(value, str):
        return value
    if not math.isfinite(value):
        return "lost"
    if float(value).is_integer() and abs(value) < 1e6:
        return f"{value:.0f}"
    return re.sub(r"e([-+])0?", r"e\1", number_text(value))
