"""Python processes that cannot import some packages, as where they are not installed."""

import os
import subprocess
import sys

BLOCKER = """
import sys

class Blocker:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {blocked!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)

sys.meta_path.insert(0, Blocker())
"""


def python_without(modules, folder, *arguments, timeout=240):
    """Run ``python ARGUMENTS``; neither it nor its children find the modules."""
    (folder / "sitecustomize.py").write_text(BLOCKER.format(blocked=set(modules)))
    return subprocess.run(
        [sys.executable, *map(str, arguments)],
        env={**os.environ, "PYTHONPATH": str(folder)},
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=timeout,
        check=False,
    )
