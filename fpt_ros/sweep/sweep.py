"""The runs of a sweep: given to a pool in chunks, written to the journal as they come."""

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from functools import partial
from itertools import islice
from pathlib import Path
from typing import Any

from fpt_ros.errors import RunFailed
from fpt_ros.sweep.definition import Sweep
from fpt_ros.sweep.executor import Pool
from fpt_ros.sweep.job import Row
from fpt_ros.sweep.journal import Journal
from fpt_ros.sweep.run_one import run_chunk

JOURNAL = "journal.jsonl"

CHUNK_TIME = 0.3
"""Seconds that one call to a worker should take: long against its cost, short to wait for."""

LARGEST_CHUNK = 256
TRIES = 4
"""Times that runs whose worker died are given to another one."""

Progress = Callable[[int, int], None]
"""Is told how many runs are done, and how many of them are not complete; may raise to end."""


Work = Callable[[Sequence[int]], tuple[float, list[Row]]]
"""Makes the rows with these numbers, in whatever process: seconds that it took, and the rows."""


def run(sweep: Sweep, directory: Path, pool: Pool, progress: Progress) -> Journal:
    """Make all runs that are not in the directory's journal yet.

    Raises:
        RunFailed: workers die again and again, or the scheduler has gone.
    """
    job = sweep.job
    journal = Journal(
        directory / JOURNAL,
        sweep.size,
        len(job.columns),
        1 + len(job.space.axes),
    )
    try:
        progress(journal.done, journal.lost)
        for rows in rows_of(partial(run_chunk, job), journal, pool, progress):
            journal.append(rows)
            progress(journal.done, journal.lost)
    except BaseException:
        journal.close()
        raise
    return journal


def rows_of(work: Work, journal: Journal, pool: Pool, progress: Progress) -> Iterator[list[Row]]:
    """Rows as they come; a few chunks for each worker are under way at any time.

    Raises:
        RunFailed: workers die again and again, or the scheduler has gone.
    """
    numbers = journal.missing()
    again: deque[tuple[list[int], int]] = deque()
    running: dict[Future[Any], tuple[list[int], int]] = {}
    left, size = journal.missing_count, 1
    try:
        while True:
            while len(running) < 2 * pool.slots + 1:
                chunk, tries = again.popleft() if again else (list(islice(numbers, size)), 0)
                if not chunk:
                    break
                running[pool.submit(work, chunk)] = chunk, tries
            if not running:
                return
            ready, _ = wait(running, timeout=0.2, return_when=FIRST_COMPLETED)
            progress(journal.done, journal.lost)
            broken: BaseException | None = None
            for future in ready:
                chunk, tries = running.pop(future)
                failure = future.exception()
                if failure is None:
                    seconds, rows = future.result()
                    left -= len(rows)
                    wanted = round(CHUNK_TIME * len(rows) / max(seconds, 1e-9))
                    even = left // (4 * pool.slots) + 1  # so that all end together
                    size = max(1, min(wanted, even, LARGEST_CHUNK))
                    yield rows
                else:
                    broken = failure
                    again.append((chunk, tries + 1))
            if broken is not None:
                if any(tries >= TRIES for _, tries in again):
                    raise RunFailed(f"workers die again and again: {_line(broken)}") from broken
                pool.repair(broken)
    finally:
        for future in running:
            future.cancel()


def _line(error: BaseException) -> str:
    return (str(error) or type(error).__name__).splitlines()[0]
