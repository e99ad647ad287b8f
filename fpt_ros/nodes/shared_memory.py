"""What killed processes leave in /dev/shm, and taking it away: ``fpt doctor --fix``.

A graph of ours has the folder of its run there. Others' nodes talk over Fast DDS's shared memory,
which removes its segments when a process ends by itself; one that was killed leaves them (half a
megabyte each). LTTng, which rclpy links, leaves two empty files at its first start on a machine.
Fast DDS's ports and semaphores stay: any process may open one by its name at any moment.
"""

import re
from contextlib import suppress
from pathlib import Path
from shutil import rmtree

FOLDER = Path("/dev/shm")
NAMES = re.compile(r"fastrtps_[0-9a-f]{16}(_el)?|lttng-ust-wait-.*")

RUN_FOLDER = "fpt_ros-{}-"
"""Begins the name of the folder of a run, by the process of ``fpt run``, which removes it."""


def leftovers() -> set[Path]:
    """Files that no process uses any more, and folders of runs whose process was killed."""
    found = _files()
    return (found - _used() if found else found) | left_folders()


def left_folders() -> set[Path]:
    """Folders of runs whose process is not there any more."""
    found: set[Path] = set()
    for path in FOLDER.glob(RUN_FOLDER.format("[0-9]*") + "*"):
        if not Path("/proc", path.name.split("-")[1]).exists():
            found.add(path)
    return found


def remove(paths: set[Path]) -> int:
    """Remove files and folders; how many could be."""
    count = 0
    for path in paths:
        with suppress(OSError):  # another user's
            if path.is_dir():
                rmtree(path)
            else:
                path.unlink()
            count += 1
    return count


def _files() -> set[Path]:
    return {path for path in FOLDER.glob("*") if NAMES.fullmatch(path.name)}


def _used() -> set[Path]:
    """Files in shared memory that some process has mapped or open."""
    used: set[Path] = set()
    for process in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):  # it has ended, or is another user's
            for line in (process / "maps").read_text(errors="replace").splitlines():
                at = line.find(f"{FOLDER}/")
                if at >= 0:
                    used.add(Path(line[at:].removesuffix(" (deleted)")))
        with suppress(OSError):
            for descriptor in (process / "fd").iterdir():
                with suppress(OSError):
                    used.add(descriptor.readlink())
    return used
