"""A process with the package imported that forks for every command: what is tested is the command.

Importing takes a second or two of every ``fpt``, most of it numba, scipy and matplotlib; here it is
done once. A line of JSON in is a command, with the files that its output goes to; a line out is its
exit status.
"""

import gc
import importlib
import json
import os
import pkgutil
import sys
import traceback

import fpt_ros
from fpt_ros.cli.main import main
from fpt_ros.engine import compiled


def import_all():
    """Import what commands import when they are called; nodes are processes of their own."""
    for module in pkgutil.walk_packages(fpt_ros.__path__, "fpt_ros."):
        if ".nodes" not in module.name:
            importlib.import_module(module.name)
    compiled.cache_directory()
    gc.freeze()


def perform(arguments, cwd, environment, stdout, stderr):
    """Become the command; as in a process of its own, its exit status is all that comes back."""
    for number, path in ((1, stdout), (2, stderr)):
        os.dup2(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC), number)
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    os.chdir(cwd)
    os.environ.clear()
    os.environ.update(environment)
    sys.argv = ["fpt", *arguments]
    status = 1
    try:
        main()
    except SystemExit as end:
        status = end.code
    except BaseException:
        traceback.print_exc()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)


def serve():
    for line in sys.stdin:
        child = os.fork()
        if child == 0:
            perform(**json.loads(line))
        _, status = os.waitpid(child, 0)
        os.write(1, b"%d\n" % os.waitstatus_to_exitcode(status))


if __name__ == "__main__":
    import_all()
    serve()
