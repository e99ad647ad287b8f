"""Which core the loop runs on in lockstep.

Plant, denoiser, trajectory generator and deformer work one after the other then, so that more cores
gain nothing, and cost: each message wakes a core that sleeps. On one core they are a fifth faster.
The tuner, which works beside the trajectory generator, and the recorder may run anywhere.
"""

import os
from pathlib import Path
from time import sleep

LOOK = 0.05
"""Seconds over which it is seen how busy the cores are."""

STAT = Path("/proc/stat")


def idlest() -> int | None:
    """The core with the most idle time of those that this process may use; None: not known."""
    allowed = os.sched_getaffinity(0)
    before = _idle_time()
    sleep(LOOK)
    after = _idle_time()
    idle = {core: after[core] - before[core] for core in allowed & before.keys() & after.keys()}
    return max(idle, key=lambda core: (idle[core], core)) if idle else None


def keep_on(core: int, process: int) -> None:
    """All threads of a process run on this core from now on, as long as it lets us."""
    try:
        for thread in os.listdir(f"/proc/{process}/task"):
            os.sched_setaffinity(int(thread), {core})
    except OSError:  # it is ending
        return


def _idle_time() -> dict[int, int]:
    """Ticks that each core has been idle."""
    try:
        lines = STAT.read_text().splitlines()
    except OSError:
        return {}
    words = [line.split() for line in lines if line.startswith("cpu") and line[3].isdigit()]
    return {int(each[0][3:]): int(each[4]) + int(each[5]) for each in words}
