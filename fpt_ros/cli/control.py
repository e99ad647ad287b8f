"""``fpt pause``, ``resume``, ``step``, ``reset``, ``stop``, ``e-stop``: of a graph that runs."""

from typing import Annotated

import typer

Namespace = Annotated[str, typer.Option(metavar="NS", help="ROS namespace of the graph.")]

PLANT, DEFORMER = "plant_simulator", "fpt_deformer"


def pause(namespace: Namespace = "") -> None:
    """Let a running graph stand still after its cycle, in lockstep and in real time.

    Example: fpt pause && fpt step 10 && fpt resume
    """
    _call(namespace, PLANT, "pause")


def resume(namespace: Namespace = "") -> None:
    """Let a paused graph go on.

    Example: fpt resume
    """
    _call(namespace, PLANT, "resume")


def step(
    cycles: Annotated[int, typer.Argument(metavar="[N]", min=1, help="Cycles.")] = 1,
    namespace: Namespace = "",
) -> None:
    """Let a graph go on for some cycles, and stand still then.

    Example: fpt step 100
    """
    from fpt_ros.nodes.asking import graph

    with graph(namespace) as asked:
        asked.set(PLANT, {"step_cycles": cycles})
        print(asked.trigger(f"{PLANT}/step"))


def reset(namespace: Namespace = "") -> None:
    """Let a running graph begin again: initial state, nothing learned, parameters as they are.

    Stamps go on; the numbers are those of a new run with the same parameters, to the last bit. A
    graph that is paused stands still at its beginning, one that is stopped stays so.

    Example: fpt reset
    """
    from fpt_ros.errors import RunFailed
    from fpt_ros.nodes.asking import graph

    with graph(namespace) as asked:
        here = asked.nodes()
        if PLANT not in here and DEFORMER in here:
            raise RunFailed(
                "reset: this graph has no plant_simulator, and a robot cannot be put back where it "
                "was; what is learned begins anew with fpt e-stop and fpt e-stop --release"
            )
        print(asked.trigger(f"{PLANT}/reset"))


def stop(namespace: Namespace = "") -> None:
    """End a running graph after its cycle; the recording is closed.

    Example: fpt stop
    """
    _call(namespace, PLANT, "stop")


def e_stop(
    release: Annotated[bool, typer.Option("--release", help="Control again, anew.")] = False,
    namespace: Namespace = "",
) -> None:
    """Command the safe effort (fpt_deformer.safe_effort) until the release.

    Example: fpt e-stop; fpt e-stop --release
    """
    _call(namespace, DEFORMER, "release" if release else "e_stop")


def _call(namespace: str, node: str, service: str) -> None:
    from fpt_ros.nodes.asking import graph

    with graph(namespace) as asked:
        print(asked.trigger(f"{node}/{service}"))
