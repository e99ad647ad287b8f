"""Does the working tree give the same bits as a commit? All variants, topics and final states."""

import argparse
import sys
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from time import monotonic

from bits import cycles, differences, read, relaid, state_differences
from cases import CYCLES, LONG, Case, cases
from tree import CACHE, Failed, Tree, commit_of, forget_machine_code, new_tree, old_tree, results_of

EXAMPLES = f"""\
examples:
  make same-bits                                  against HEAD: what is not committed yet
  make same-bits REV=v0.1.0                       against a tag, a branch or a hash
  make same-bits REV=main OPTIONS='--variants tora*,swing --cycles 50'
  make same-bits REV=main OPTIONS=--full          whole runs: a few minutes, about 1.5 GB of disk

{CYCLES} cycles each; {", ".join(LONG)} run for 16 s. NaN is NaN whatever its payload; of all other
numbers every bit counts. A final state whose size has changed is named, and not compared.
The commit's tree and results are kept in {CACHE.name}/, so that the next comparison runs only the
working tree; the folder may be removed at any time.
Exit status: 0 the same bits, 1 not the same, 2 bad input, 130 Ctrl-C.
"""


def options() -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(
        prog="same_bits",
        description=__doc__,
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("rev", nargs="?", default="HEAD", help="the commit (default: HEAD)")
    parser.add_argument(
        "--variants", default="*", help="names as in config/, with * and ?, comma between: tora.*"
    )
    parser.add_argument("--cycles", type=int, default=CYCLES, help=f"of each run ({CYCLES})")
    parser.add_argument("--full", action="store_true", help="every run as long as its file says")
    parser.add_argument("--verbose", "-v", action="store_true", help="all fields that differ")
    parser.add_argument("--topics-only", action="store_true", help="leave the final states out")
    chosen = parser.parse_args()
    if chosen.cycles < 1:
        parser.error(f"--cycles {chosen.cycles}: at least 1")
    return chosen


class Progress:
    """One line that is written over, on a terminal only."""

    def __init__(self, total: int) -> None:
        self._total, self._done = total, 0

    def __call__(self, what: str, name: str) -> None:
        self._done += 1
        if sys.stderr.isatty():
            line = f"{what}: {self._done} of {self._total}, {name}"
            print(f"\r\033[K{line}", end="", file=sys.stderr, flush=True)

    @staticmethod
    def clear() -> None:
        if sys.stderr.isatty():
            print("\r\033[K", end="", file=sys.stderr, flush=True)


def compare(
    chosen: list[Case], new: Tree, kept: Path, folder: Path, topics_only: bool, verbose: bool
) -> tuple[int, int]:
    """Run the cases in the working tree, each compared as soon as it is there.

    The first difference of each is told; all of them if ``verbose``.

    Returns:
        Number of cases that differ, and of all cycles.
    """
    progress, by_name = Progress(len(chosen)), {case.name: case for case in chosen}
    differ = total = 0
    layouts: dict[tuple[str, str], list[str]] = {}

    def done(name: str) -> None:
        nonlocal differ, total
        file = by_name[name].file
        before, now = read(kept / file), read(folder / file)
        (folder / file).unlink()
        lines = list(differences(before, now))
        if not topics_only and "refused" not in before.keys() | now.keys():
            lines += state_differences(before, now)
            for stage, sizes in relaid(before, now):
                layouts.setdefault((stage, sizes), []).append(name)
        differ += bool(lines)
        total += cycles(now)
        progress.clear()
        if len(lines) > 1 and not verbose:
            lines = [f"{lines[0]}, and {len(lines) - 1} fields more"]
        for i, line in enumerate(lines):
            print(f"{name if i == 0 else ' ' * len(name)}  {line}", flush=True)
        progress("working tree", name)

    new.run(chosen, folder, done)
    progress.clear()
    for (stage, sizes), names in layouts.items():
        more = f" and {len(names) - 1} more" if len(names) > 1 else ""
        print(f"state of {stage}: layout changed, {sizes}, not compared ({names[0]}{more})")
    return differ, total


def run(chosen: argparse.Namespace, say: Callable[[str], None]) -> int:
    """Compare; returns the exit status."""
    start, commit = monotonic(), commit_of(chosen.rev)
    old, kept = old_tree(commit), results_of(commit)
    length = None if chosen.full else chosen.cycles
    try:
        wanted = cases(old.root / "config", length, chosen.variants.split(","))
    except ValueError as error:
        raise Failed(str(error)) from None
    missing = [case for case in wanted if not (kept / case.file).is_file()]
    with TemporaryDirectory(dir=CACHE, prefix="new-") as name:
        new = new_tree(Path(name))
        if missing:
            say(f"running {commit[:12]}: {len(missing)} variants, kept for the next time")
            progress = Progress(len(missing))
            old.run(missing, kept, lambda name: progress(commit[:12], name))
            progress.clear()
        forget_machine_code(keep=new.digest)
        say(f"running the working tree against {commit[:12]} ({chosen.rev})")
        differ, total = compare(wanted, new, kept, Path(name), chosen.topics_only, chosen.verbose)
    verdict = f"{differ} DIFFER" if differ else "the same bits"
    say(f"{len(wanted)} variants, {total} cycles: {verdict} ({monotonic() - start:.0f} s)")
    return 1 if differ else 0


def main() -> int:
    """The command."""
    try:
        return run(options(), lambda text: print(text, flush=True))
    except Failed as error:
        print(f"same_bits: {error}", file=sys.stderr)
        return error.status
    except KeyboardInterrupt:
        print("\nstopped; what was run of the commit is kept", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main())
