"""``fpt params``: parameters of running nodes, for machines without ``ros2``."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from fpt_ros.cli.options import Json

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fpt_ros.parameters import Value

app = typer.Typer(
    help="Parameters of the nodes of a running graph: look at them, change them in flight.",
    no_args_is_help=True,
    rich_markup_mode=None,
)

Node = Annotated[str, typer.Argument(metavar="NODE", help="As in fpt_deformer.")]
Nodes = Annotated[
    list[str] | None, typer.Argument(metavar="[NODE]...", help="By default all that control.")
]
Names = Annotated[
    list[str] | None, typer.Argument(metavar="[PARAM]...", help="By default all of the node.")
]
Namespace = Annotated[str, typer.Option(metavar="NS", help="ROS namespace of the graph.")]


@app.command("list")
def list_(nodes: Nodes = None, namespace: Namespace = "", json: Json = False) -> None:
    """Names of the parameters.

    Example: fpt params list fpt_deformer
    """
    from fpt_ros.cli.output import print_json
    from fpt_ros.nodes.asking import graph

    with graph(namespace) as asked:
        found = {node: asked.names(node) for node in nodes or asked.nodes()}
    if json:
        print_json(found)
        return
    for node, names in found.items():
        for name in names:
            print(f"{node}.{name}")


@app.command()
def get(node: Node, names: Names = None, namespace: Namespace = "", json: Json = False) -> None:
    """Values of parameters.

    Example: fpt params get fpt_deformer A K
    """
    from fpt_ros.cli.output import print_json
    from fpt_ros.nodes.asking import graph

    with graph(namespace) as asked:
        values = asked.values(node, names or None)
    if json:
        print_json(values)
        return
    for name, value in values.items():
        print(f"{node}.{name} = {_text(value)}")


@app.command("set")
def set_(
    node: Node,
    changes: Annotated[list[str], typer.Argument(metavar="PARAM=VALUE...", help="One or more.")],
    namespace: Namespace = "",
) -> None:
    """Change parameters of a node, all of them or none, at one cycle boundary.

    Example: fpt params set fpt_deformer A=-0.2 K=0.6
    """
    from fpt_ros.nodes.asking import graph

    with graph(namespace) as asked:
        _warn(asked.set(node, dict(map(_change, changes))))


@app.command()
def describe(node: Node, names: Names = None, namespace: Namespace = "") -> None:
    """What parameters mean, their valid values, and whether they can change in flight.

    Example: fpt params describe fpt_deformer A
    """
    from fpt_ros.nodes.asking import graph

    with graph(namespace) as asked:
        for each in asked.describe(node, names or asked.names(node)):
            change = "fixed" if each.read_only else "live"
            print(
                f"{node}.{each.name}: {each.description} ({each.additional_constraints}; {change})"
            )


@app.command()
def dump(
    nodes: Nodes = None,
    out: Annotated[Path | None, typer.Option(metavar="FILE", help="Instead of the output.")] = None,
    namespace: Namespace = "",
) -> None:
    """All parameters as a ROS parameter file, which ``fpt params load`` and nodes take.

    Example: fpt params dump --out tuned.yaml
    """
    import sys
    import tempfile

    from fpt_ros.analysis.whole_files import write_whole
    from fpt_ros.cycle.stages import STAGES
    from fpt_ros.experiments.parameter_file import write
    from fpt_ros.nodes.asking import graph

    with graph(namespace) as asked:
        values = {node: asked.values(node) for node in nodes or asked.nodes()}
    missing = [] if nodes else [node for node in STAGES if node not in values]
    if missing:
        print(f"fpt: not in the graph, so left out: {', '.join(missing)}", file=sys.stderr)
    with tempfile.TemporaryDirectory() as folder:
        write(Path(folder) / "dump.yaml", values)
        text = (Path(folder) / "dump.yaml").read_bytes()
    if out is not None:
        write_whole(out, text)
    else:
        print(text.decode(), end="")


@app.command()
def load(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="A ROS parameter file.")],
    nodes: Annotated[
        list[str] | None, typer.Argument(metavar="[NODE]...", help="By default all of the file.")
    ] = None,
    namespace: Namespace = "",
) -> None:
    """Take the live parameters of a file, those of each node at one cycle boundary.

    What is the same already is left alone. A difference in what cannot change in flight, and a
    node that is not there, are refused before anything is changed.

    Example: fpt params load tuned.yaml fpt_deformer
    """
    from fpt_ros.cycle.stages import STAGES
    from fpt_ros.errors import BadInput
    from fpt_ros.experiments.parameter_file import read
    from fpt_ros.nodes.asking import graph

    given = read(file)
    with graph(namespace) as asked:
        changes: dict[str, dict[str, Value]] = {}
        here = asked.nodes()
        for node in nodes or [name for name in given.nodes if name in STAGES]:
            if node not in given.nodes:
                raise BadInput(f"{file} has no node {node}: it has {', '.join(given.nodes)}")
            if node not in here:
                raise BadInput(
                    f"{file}: the node {node} is not in the graph, which has {', '.join(here)}; "
                    "name those to load"
                )
            now = asked.values(node)
            wanted = {**{k: v for k, v in given.shared.items() if k in now}, **given.nodes[node]}
            differing = {k: v for k, v in wanted.items() if k not in now or now[k] != v}
            for each in asked.describe(node, list(differing)) if differing else ():
                if each.read_only:
                    raise BadInput(
                        f"{file}: {node}.{each.name} cannot change while the loop runs: it is "
                        f"{_text(now[each.name])}, not {_text(differing[each.name])}"
                    )
            if differing:
                changes[node] = differing
        for node, values in changes.items():
            _warn(asked.set(node, values))
            for name, value in values.items():
                print(f"{node}.{name} = {_text(value)}")


@app.command()
def watch(
    count: Annotated[int, typer.Option(metavar="N", help="End after so many; 0: Ctrl-C.")] = 0,
    namespace: Namespace = "",
) -> None:
    """Print changes as they take effect, with the time of their cycle.

    Example: fpt params watch
    """
    from fpt_ros.bags.changes import value_of
    from fpt_ros.nodes.asking import graph

    seen = 0

    def tell(event: Any) -> bool:
        nonlocal seen
        time = event.stamp.sec + 1e-9 * event.stamp.nanosec
        for each in event.changed_parameters:
            node = event.node.rpartition("/")[2]
            print(f"{time:.9g} s  {node}.{each.name} = {_text(value_of(each.value))}", flush=True)
            seen += 1
        return 0 < count <= seen

    with graph(namespace) as asked:
        asked.watch(tell)


def _warn(remark: str) -> None:
    """What a node has to say of a change that it accepts."""
    if remark:
        print(f"fpt: {remark}", file=sys.stderr)


def _change(text: str) -> "tuple[str, object]":
    from fpt_ros.errors import BadInput
    from fpt_ros.experiments.parameter_file import scalar

    name, equals, value = text.partition("=")
    if not equals or not name:
        raise BadInput(f"{text}: it takes PARAM=VALUE, as in A=-0.2")
    return name.strip(), scalar(value)


def _text(value: "Value | Mapping[str, Value]") -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return repr(value) if not isinstance(value, str) else value
