"""A process that runs nodes: start, signals, exit status."""

import gc
import os
import signal
import sys
from collections.abc import Callable, Sequence

from fpt_ros.errors import BadInput, FptError
from fpt_ros.nodes import middleware
from fpt_ros.nodes.loop_node import LoopNode
from fpt_ros.nodes.spin import spin


class Stop:
    """Set by SIGINT and SIGTERM; the spinner looks at it a few dozen times a second."""

    signal = 0

    def __init__(self) -> None:
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, self._on_signal)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGTERM})  # it may wait since the start

    def _on_signal(self, number: int, frame: object) -> None:
        self.signal = number


def run_process(factories: Sequence[Callable[[], LoopNode]], name: str, about: str) -> None:
    """Run nodes until they finish, a signal comes, or one of them fails; then exit.

    Exit status: 0 finished, or asked to end by SIGINT or SIGTERM, as a launch does; 1 a run that
    failed, 2 bad parameters, both with one line on standard error.
    """
    if "--help" in sys.argv[1:] or "-h" in sys.argv[1:]:
        print(_usage(name, about))
        sys.exit(0)
    stop = Stop()
    try:
        run_nodes(factories, stop, sys.argv)
    except FptError as error:
        print(f"{name}: {error}", file=sys.stderr, flush=True)
        sys.exit(error.exit_status)
    sys.exit(0)


def run_nodes(
    factories: Sequence[Callable[[], LoopNode]], stop: Stop, arguments: list[str]
) -> None:
    """Run nodes until they finish or are stopped; ``arguments``: a command line with ROS's own.

    Raises:
        BadInput, RunFailed: of a node.
    """
    import rclpy
    from rclpy.context import Context
    from rclpy.impl.implementation_singleton import rclpy_implementation
    from rclpy.signals import SignalHandlerOptions
    from rclpy.utilities import get_default_context, try_shutdown

    middleware.configure()
    try:
        rclpy.init(args=arguments, signal_handler_options=SignalHandlerOptions.NO)
    except rclpy_implementation.RCLError as error:
        raise BadInput(f"ROS arguments or parameter file: {str(error).splitlines()[0]}") from error
    context: Context = get_default_context()
    nodes: list[LoopNode] = []
    try:
        for factory in factories:
            nodes.append(_made(factory))
        gc.freeze()  # with all that is there by now, a search for garbage takes 40 ms
        spin(nodes, lambda: bool(stop.signal) or not context.ok(), context)
    finally:
        for node in nodes:
            node.close()
        for node in nodes:
            node.destroy_node()
        try_shutdown()


def _made(factory: Callable[[], LoopNode]) -> LoopNode:
    """A node.

    Raises:
        BadInput: of the node, or of the middleware (no such security, no memory).
    """
    from rclpy.impl.implementation_singleton import rclpy_implementation

    try:
        return factory()
    except rclpy_implementation.RCLError as error:
        raise BadInput(f"the node cannot be made: {' '.join(str(error).split())}") from error


def _usage(name: str, about: str) -> str:
    return f"""{about.strip()}

usage: ros2 run fpt_ros {name} --ros-args --params-file config/tora.yaml
       {name} --ros-args --params-file config/tora.yaml [-p PARAM:=VALUE] [-r __ns:=/NAMESPACE]

parameters: ros2 param list /{name}; ros2 param describe /{name} PARAM
the whole graph at once: fpt run tora"""


def report_progress(cycle: int, paused: bool = False) -> None:
    """Tell the process that started the graph how many cycles are done, less than 0 in a pause."""
    descriptor = os.environ.get("FPT_PROGRESS_FD")
    if descriptor:
        try:
            os.write(int(descriptor), f"{-1 - cycle if paused else cycle}\n".encode())
        except OSError:
            os.environ.pop("FPT_PROGRESS_FD")
