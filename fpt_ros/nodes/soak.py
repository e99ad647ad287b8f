"""Runs under random faults, for as long as told: what ``fpt soak`` does."""

import json
import os
import random
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from time import monotonic

from fpt_ros.errors import FptError
from fpt_ros.experiments.experiment import load
from fpt_ros.nodes.child import environment
from fpt_ros.nodes.faults import FAULTS, Victim
from fpt_ros.nodes.intruder import Intruder, intruder
from fpt_ros.replay.recorded import Recorded
from fpt_ros.replay.rerun import rerun

RUNS: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("tora", ()),
    ("tora_auto", ()),  # a tuner is in the loop
    ("tora", ("--composed",)),
)
"""Experiments, and options of ``fpt run``, one after the other."""

DURATION = 16.0
"""Of each run [s]."""

PATIENCE = 60.0
"""Seconds after a fault in which the loop has to go on."""

PAUSE = 1.0
"""Seconds between two faults, on the average."""

BEHIND = 100_000_000
"""The loop has gone on when so much [ns] is recorded that was not before a fault."""


@dataclass
class Tally:
    """What has happened so far.

    Attributes:
        injected, survived: faults by their name.
        runs, cycles: that were completed.
        lost: messages of the loop that should be recorded and are not.
        unequal: runs whose numbers are not those of an undisturbed one.
        problems: what was not survived, a line each.
    """

    injected: dict[str, int] = field(default_factory=lambda: dict.fromkeys(FAULTS, 0))
    survived: dict[str, int] = field(default_factory=lambda: dict.fromkeys(FAULTS, 0))
    runs: int = 0
    cycles: int = 0
    lost: int = 0
    unequal: int = 0
    problems: list[str] = field(default_factory=list)

    @property
    def good(self) -> bool:
        """Whether everything was survived."""
        return not (self.lost or self.unequal or self.problems)


def soak(seconds: float, seed: int, folder: Path, tell: Callable[[str], None]) -> Tally:
    """Run graphs under faults until the time is over; the last run is let come to its end.

    Args:
        seconds: how long.
        seed: of which faults there are, and when.
        folder: of the recordings; those of good runs are removed.
        tell: is told, a line each, what is done.
    """
    os.environ.update(environment())
    tally, chance, end = Tally(), random.Random(seed), monotonic() + seconds
    while monotonic() < end:
        name, options = RUNS[tally.runs % len(RUNS)]
        tell(f"run {tally.runs}: fpt run {' '.join((name, *options))}")
        _one_run(tally, chance, end, folder / f"run_{tally.runs}", name, options, tell)
        tally.runs += 1
    return tally


def _one_run(
    tally: Tally,
    chance: random.Random,
    end: float,
    bag: Path,
    name: str,
    options: tuple[str, ...],
    tell: Callable[[str], None],
) -> None:
    command = [
        *(sys.executable, "-P", "-m", "fpt_ros.cli.main", "run", name, "--json"),
        *("--duration", str(DURATION), "--record", str(bag), "--restarts", "1000", *options),
    ]
    joints = load(name).loop().plant.coordinates
    log = bag.with_name(f"{bag.name}.log")
    with log.open("w") as output, intruder(joints) as somebody:
        process = subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=output, env=dict(environment()), text=True
        )
        try:
            _disturb(tally, chance, end, process, somebody, tell)
            result, _ = process.communicate(timeout=600.0)
        except subprocess.TimeoutExpired:
            tally.problems.append(f"{bag}: the run did not end")
            return
        finally:
            process.terminate()
            process.wait()
    if process.returncode:
        said = log.read_text().strip().splitlines()[-1:]
        tally.problems.append(f"{bag}: exit status {process.returncode}: {''.join(said)}")
        return
    if _judge(tally, bag, json.loads(result)["cycles"], tell):
        for path in (*bag.iterdir(), log):
            path.unlink()
        bag.rmdir()


def _disturb(
    tally: Tally,
    chance: random.Random,
    end: float,
    process: "subprocess.Popen[str]",
    somebody: Intruder,
    tell: Callable[[str], None],
) -> None:
    """One fault after the other, until the run ends, or the time is over."""
    victim = Victim(process.pid, somebody, chance)
    if _goes_on(process, somebody, BEHIND):
        somebody.advertise()
    while monotonic() < end:
        somebody.listen(chance.expovariate(1.0 / PAUSE))
        fault = chance.choice(list(FAULTS))
        if process.poll() is not None:
            return
        before = somebody.stamp
        tally.injected[fault] += 1
        try:
            about = FAULTS[fault](victim)
            good = _goes_on(process, somebody, before + BEHIND)
        except FptError as error:
            about, good = str(error), process.poll() == 0  # there was nobody any more to ask
        tally.survived[fault] += good
        if not good:
            for line in victim.doing():
                tell(line)
            tally.problems.append(f"{fault} {about}, at t = {before / 1e9:g} s")
        tell(f"t = {before / 1e9:.3f} s: {fault} {about}{'' if good else ': NOT SURVIVED'}")


def _goes_on(process: "subprocess.Popen[str]", somebody: Intruder, stamp: int) -> bool:
    """Whether the loop comes to a stamp [ns], or to its end."""
    deadline = monotonic() + PATIENCE
    while somebody.stamp < stamp and monotonic() < deadline:
        if process.poll() is not None:
            return process.returncode == 0
        somebody.listen(0.02)
    return somebody.stamp >= stamp


def _judge(tally: Tally, bag: Path, cycles: int, tell: Callable[[str], None]) -> bool:
    """Whether all of a run is recorded, with the numbers of an undisturbed one."""
    recorded = Recorded(bag)
    (found,) = rerun(recorded).values()
    lost = sum(cycles - count for count in recorded.counts.values())
    tally.cycles += cycles
    tally.lost += lost
    if not found.equal:
        tally.unequal += 1
        tally.problems.append(f"{bag}: the numbers are others")
    if not recorded.complete:
        tally.problems.append(f"{bag}: {recorded.info['reason']}")
    tell(f"{cycles} cycles, {lost} messages lost, numbers {'equal' if found.equal else 'differ'}")
    return found.equal and recorded.complete and not lost
