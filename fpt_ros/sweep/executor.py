"""Where the runs are made: processes of this machine, or a dask cluster."""

import asyncio
import ctypes
import logging
import multiprocessing
import os
import signal
import threading
from abc import ABC, abstractmethod
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, Executor, Future, ProcessPoolExecutor
from contextlib import suppress
from multiprocessing.connection import Connection
from types import TracebackType
from typing import Any

from fpt_ros.errors import BadInput, RunFailed
from fpt_ros.extras import need

CONNECT = 10.0
"""Seconds that a scheduler has to answer."""

M_TRIM_THRESHOLD, M_MMAP_THRESHOLD = -1, -3
"""Options of glibc's ``mallopt``."""

LARGEST_KEPT = 32 * 2**20
"""Bytes of the largest array that is kept; glibc takes no more."""


class Pool(ABC):
    """Takes calls, and survives the death of a worker."""

    executor: Executor

    def __enter__(self) -> "Pool":
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """Call a function some time, somewhere."""
        return self.executor.submit(function, *arguments)

    @property
    @abstractmethod
    def slots(self) -> int:
        """Calls that can run side by side at the moment, at least 1."""

    @abstractmethod
    def repair(self, error: BaseException) -> None:
        """Be ready again after a call failed with ``error``.

        Raises:
            RunFailed: that cannot be.
        """

    @abstractmethod
    def close(self) -> None:
        """End the workers that are ours; what is under way is dropped."""


class LocalPool(Pool):
    """Processes of this machine; they end when this process ends, however it does."""

    def __init__(self, workers: int) -> None:
        self._workers = workers
        self._start()

    def _start(self) -> None:
        context = multiprocessing.get_context("spawn")
        ours, self._lifeline = context.Pipe(duplex=False)
        self._ours = ours
        self._processes = ProcessPoolExecutor(
            self._workers, context, initializer=_begin_worker, initargs=(ours,)
        )
        self.executor: Executor = self._processes

    @property
    def slots(self) -> int:
        """Number of processes."""
        return self._workers

    @property
    def pids(self) -> tuple[int, ...]:
        """Of the processes that have been started."""
        return tuple(self._processes._processes)

    def repair(self, error: BaseException) -> None:
        """Start new processes where one has died."""
        if not isinstance(error, BrokenExecutor):
            raise error
        self.close()
        self._start()

    def close(self) -> None:
        """The lifeline is cut: all workers end at once."""
        self._lifeline.close()
        self._ours.close()
        self.executor.shutdown(wait=True, cancel_futures=True)


def _begin_worker(lifeline: Connection) -> None:
    """Leave Ctrl-C to the parent, and end with it."""
    keep_memory()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with, args=(lifeline,), daemon=True).start()


def keep_memory() -> None:
    """Let this process keep what one run frees for the next one.

    glibc would give it back to the system and take it again, a page fault for every 4 kB: a quarter
    of the time of a run of 16,000 cycles. Where there is another libc it stays as it is.
    """
    with suppress(OSError, AttributeError):
        set_option = ctypes.CDLL(None).mallopt
        set_option(M_MMAP_THRESHOLD, LARGEST_KEPT)
        set_option(M_TRIM_THRESHOLD, 8 * LARGEST_KEPT)


def _end_with(lifeline: Connection) -> None:
    with suppress(EOFError, OSError):
        lifeline.recv()
    os._exit(0)


class ClusterPool(Pool):
    """The workers of a dask scheduler; its client is a drop-in executor."""

    def __init__(self, address: str) -> None:
        need("cluster")
        import distributed

        logging.getLogger("distributed").setLevel(logging.CRITICAL)
        client: Any = distributed.Client  # dask has no types
        try:
            asyncio.run(_call(address))
            self._client: Any = client(address, timeout=CONNECT, set_as_default=False)
        except Exception as error:  # a dozen kinds, from a bad name to a foreign protocol
            raise BadInput(
                f"--scheduler {address}: no dask scheduler answers there, "
                "it takes an address such as tcp://127.0.0.1:8786"
            ) from error
        self.executor: Executor = self._client.get_executor(pure=False)

    @property
    def slots(self) -> int:
        """Threads of all workers that are there now."""
        cores: int = sum(self._client.ncores().values())
        return max(1, cores)

    def repair(self, error: BaseException) -> None:
        """Dask restarts workers itself; only the scheduler must still be there."""
        if self._client.status != "running":
            raise RunFailed("the scheduler has gone: start one, and the same command goes on")

    def close(self) -> None:
        """Leave the cluster as it is."""
        with suppress(Exception):
            self.executor.shutdown(wait=False)
        with suppress(Exception):
            self._client.close(timeout=5)


async def _call(address: str) -> None:
    """Whether anything answers: a client that finds nothing leaves threads and tracebacks."""
    import distributed.comm

    call: Any = getattr(distributed.comm, "connect")  # noqa: B009  # not exported for checkers
    comm = await call(address, timeout=CONNECT)
    comm.abort()


def pool(scheduler: str | None, workers: int | None) -> Pool:
    """The pool that the options ask for.

    Raises:
        BadInput: no workers, or no scheduler answers.
    """
    if scheduler is not None:
        return ClusterPool(scheduler)
    return LocalPool(local_workers(workers))


def local_workers(workers: int | None) -> int:
    """Number of processes: as many as there are cores for us, where none is given.

    Raises:
        BadInput: less than one.
    """
    if workers is not None and workers < 1:
        raise BadInput(f"--workers {workers} is not valid, it takes 1 or more")
    return workers or len(os.sched_getaffinity(0))
