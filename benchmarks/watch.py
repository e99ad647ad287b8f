"""What ``fpt watch``, its page open in a browser on the same machine, costs the graph in lockstep.

In real time the loop has time to spare; in lockstep it takes what the machine has, so that all that
watches is taken from its pace.
"""

import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from graph import measure_graph
from measure import alternate, arguments, median, show

sys.path.insert(0, str(Path(__file__).parents[1] / "test"))
from browser import browser

FPT = str(Path(sys.executable).with_name("fpt"))


@contextmanager
def watched(wanted: bool) -> Iterator[None]:
    """A browser that shows the page of all graphs."""
    if not wanted:
        yield
        return
    command = [FPT, "watch", "--no-browser"]
    server = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    try:
        assert server.stdout is not None
        url = server.stdout.readline().split()[0]
        with (
            tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder,
            browser(Path(folder)) as page,
        ):
            page.call("Page.navigate", url=url)
            page.wait_for("window.Bokeh && Bokeh.documents.length")
            yield
    finally:
        server.terminate()
        server.wait()


def main() -> None:
    """Measure, and print the table."""
    options = arguments(__doc__ or "", seconds=16.0)
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"

    def pace(wanted: bool) -> float:
        with watched(wanted):
            return measure_graph("tora", options.seconds, composed=False, recorded=False)

    found = median(
        alternate(
            {"alone": lambda: pace(False), "watched in a browser": lambda: pace(True)},
            options.runs,
            options.json,
        )
    )
    rows = [
        {"tora, separate processes": name, "cycles/s": each, "share": each / found["alone"]}
        for name, each in found.items()
    ]
    show("Watching a graph", rows, options.json)


if __name__ == "__main__":
    main()
