"""Claims judged by their runs, on all cores."""

import io
import multiprocessing
import os
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from fpt_ros.analysis import style
from fpt_ros.errors import RunFailed
from fpt_ros.thesis.chapters import Chapter, chapters
from fpt_ros.thesis.claim import STATUSES, Claim, Picture, Verdict
from fpt_ros.thesis.worker_processes import held_interrupts, one_thread_each

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
        with held_interrupts(), one_thread_each():  # by the workers too, which are started here
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


def count(outcomes: Iterable[Outcome]) -> dict[str, int]:
    """How many claims have which status."""
    counter = Counter(one.verdict.status for one in outcomes)
    return {status: counter[status] for status in STATUSES}
