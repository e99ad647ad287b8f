"""The engine beside an earlier commit: how fast is the working tree.

Both trees run one experiment each in turn, in random order, so that what else the machine does
meets both alike; a ratio is of two runs of one turn. The interval holds the median ratio with 95 %
(:func:`scipy.stats.quantile_test`, which assumes nothing about how times are distributed).

    python benchmarks/before.py --rev v0.1.0 --runs 30
"""

import subprocess
import sys
from contextlib import ExitStack
from functools import partial
from math import isfinite
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

from engine import EXPERIMENTS
from measure import alternate, arguments, show
from scipy.stats import quantile_test

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "test" / "same_bits"))
from tree import CACHE, Failed, Tree, commit_of, new_tree, old_tree  # noqa: E402

IN_PYTHON = 500
"""So many times fewer cycles are run without machine code."""


class Runner:
    """A process of one tree that runs what it is told to (``paced.py``)."""

    def __init__(self, tree: Tree) -> None:
        words = [sys.executable, str(HERE / "paced.py")]
        self._process = subprocess.Popen(
            words,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            env=tree.environment(),
            cwd=tree.root,
        )

    def pace(self, experiment: str, cycles: int, how: str) -> float:
        """Cycles a second of a run.

        Raises:
            Failed: the process has ended; it has said why.
        """
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        try:
            print(experiment, cycles, how, file=self._process.stdin, flush=True)
        except BrokenPipeError:
            raise Failed(f"{experiment} does not run: see above", status=1) from None
        answer = self._process.stdout.readline()
        if not answer:
            raise Failed(f"{experiment} does not run: see above", status=1)
        return cycles / float(answer)

    def end(self) -> None:
        """End the process."""
        self._process.kill()
        self._process.communicate()


def in_turn(
    runners: dict[str, Runner], what: tuple[str, int, str], runs: int, quiet: bool
) -> list[list[float]]:
    """Paces of each tree, after one run each that is not counted."""
    for runner in runners.values():
        runner.pace(*what)
    measurements = {
        f"{what[0]}, {what[2]}, {name}": partial(runner.pace, *what)
        for name, runner in runners.items()
    }
    return list(alternate(measurements, runs, quiet).values())


def row(label: str, before: list[float], now: list[float]) -> dict[str, object]:
    """A row of the table."""
    ratios = [b / a for a, b in zip(before, now, strict=True)]
    found = quantile_test(ratios, p=0.5).confidence_interval()
    interval = f"{found.low:.3f} to {found.high:.3f}" if isfinite(found.low + found.high) else None
    return {
        "what": label,
        "before [cycles/s]": median(before),
        "now [cycles/s]": median(now),
        "median of the ratios": f"{median(ratios):.3f}",
        "95 %": interval,
    }


def main() -> int:
    """Measure, and print the table."""
    options = arguments(__doc__ or "", rev="HEAD", cycles=1_000_000, starts=4, only="")
    names = (options.only,) if options.only else EXPERIMENTS
    whats = [(name, options.cycles, "compiled") for name in names]
    whats += [(name, options.cycles // IN_PYTHON, "python") for name in names]
    found: dict[tuple[str, int, str], list[list[float]]] = {what: [[], []] for what in whats}
    try:
        commit = commit_of(options.rev)
        old = old_tree(commit)
        with TemporaryDirectory(dir=CACHE, prefix="new-") as folder:
            trees = {"before": old, "now": new_tree(Path(folder))}
            for _ in range(options.starts):  # one start of Python is faster than another
                with ExitStack() as stack:
                    runners = {name: Runner(tree) for name, tree in trees.items()}
                    for runner in runners.values():
                        stack.callback(runner.end)
                    for what in whats:
                        paces = in_turn(runners, what, options.runs, options.json)
                        for kept, new in zip(found[what], paces, strict=True):
                            kept += new
    except Failed as error:
        print(f"before.py: {error}", file=sys.stderr)
        return error.status
    except KeyboardInterrupt:
        return 130
    rows = [
        row(f"{name}, {cycles:,} cycles, {how}", *found[name, cycles, how])
        for name, cycles, how in whats
    ]
    many = options.starts * options.runs
    show(f"Engine beside {commit[:12]}, {many} turns", rows, options.json)
    return 0


if __name__ == "__main__":
    sys.exit(main())
