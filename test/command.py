"""Running the command ``fpt`` as its users do: a process, its exit status and what it prints."""

import json
import subprocess
import sys
from pathlib import Path

BIN = Path(sys.executable).parent
TIMEOUT = 120.0


def fpt(*arguments, timeout=TIMEOUT, cwd=None):
    return subprocess.run(
        [BIN / "fpt", *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=timeout,
        cwd=cwd,
        check=False,
    )


def fpt_json(*arguments, **options):
    done = fpt(*arguments, "--json", **options)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def start_fpt(*arguments):
    return subprocess.Popen(
        [BIN / "fpt", *map(str, arguments)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
