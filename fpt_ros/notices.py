"""What a user should know although the run goes on: one line on standard error, once."""

import sys
from functools import cache
from multiprocessing import current_process


@cache
def notice(text: str) -> None:
    """Say something once; of the processes of a sweep the first one speaks for all."""
    if current_process().name == "MainProcess" or current_process().name.endswith("-1"):
        print(f"fpt: {text}", file=sys.stderr, flush=True)
