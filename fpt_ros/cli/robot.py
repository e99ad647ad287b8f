"""``fpt robot``."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from fpt_ros.cli.options import Json

if TYPE_CHECKING:
    from fpt_ros.robots.robot import Written

File = Annotated[
    str,
    typer.Argument(metavar="FILE", help="MJCF or URDF of an arm, or the name of one that ships."),
]
Out = Annotated[
    Path | None, typer.Option(metavar="DIR", help="Where to write; default: the file's name, here.")
]
Joints = Annotated[
    list[str] | None,
    typer.Option("--joints", metavar="A,B,...", help="That are moved; default: all that can be."),
]
Payload = Annotated[
    float | None,
    typer.Option(metavar="KG", help="At the flange; default: a tenth of what moves, or less."),
]


def robot(
    file: File,
    out: Out = None,
    joints: Joints = None,
    payload: Payload = None,
    json: Json = False,
) -> None:
    """Write an experiment for any robot arm: posture, motion, gain, and controllers as variants.

    The plant is the arm of the file with a payload, the model has half of all its inertias. Then:
    fpt simulate DIR/NAME.yaml, and fpt compare DIR/NAME.yaml for a page of all controllers.

    Example: fpt robot my_arm.urdf --out my_arm
    """
    from fpt_ros.errors import BadInput
    from fpt_ros.extras import need
    from fpt_ros.robots.robot import try_out, write_experiment

    need("robots")
    if payload is not None and not 0.0 <= payload < 1e6:
        raise BadInput(f"--payload {payload:g} is not valid, it takes kg >= 0")
    names = [name.strip() for text in joints or () for name in text.split(",") if name.strip()]
    written = write_experiment(file, out, names, payload)
    errors = try_out(written)
    result = _result(written, errors)
    if json:
        from fpt_ros.cli.output import print_json

        print_json(result)
        return
    _print(written, result)


def _result(written: "Written", errors: dict[str, float | None]) -> dict[str, Any]:
    numbers = written.numbers
    about, motion = numbers.about, numbers.motion
    n = len(about.home)
    return {
        "experiment": str(written.files[0]),
        "files": [str(path) for path in written.files],
        "payload": motion.payload,
        "A": numbers.gain,
        "lambda": written.experiment.nodes["trajectory_generator"]["lambda"],
        "joints": [
            {
                "name": about.arm.names[i],
                "unit": "rad" if about.arm.turns[i] else "m",
                "home": about.home[i],
                "deviation": round(about.reach[i], 4),
                "inertia": float(f"{about.inertia[i]:.3g}"),
                "effort": float(f"{motion.effort[i]:.3g}"),
                "weight": numbers.weights[i] if numbers.weights else 1.0,
            }
            for i in range(n)
        ],
        "fixed": about.fixed,
        "notes": list(motion.notes),
        "error": errors,
    }


def _print(written: "Written", result: dict[str, Any]) -> None:
    from rich.table import Table

    from fpt_ros.cli.output import console

    table = Table(box=None, pad_edge=False)
    table.add_column("joint")
    for heading in ("posture", "moves by", "inertia", "effort", "weight"):
        table.add_column(heading, justify="right")
    for each in result["joints"]:
        unit = each["unit"]
        force, inertia = ("N m", "kg m²") if unit == "rad" else ("N", "kg")
        table.add_row(
            each["name"],
            f"{each['home']:.4g} {unit}",
            f"± {each['deviation']:.3g} {unit}",
            f"{each['inertia']:.3g} {inertia}",
            f"{each['effort']:.3g} {force}",
            f"{each['weight']:.3g}",
        )
    screen = console()
    screen.print(table)
    print(
        f"payload {result['payload']:g} kg, A = {result['A']:g}, lambda = {result['lambda']:g} 1/s"
    )
    for name, why in result["fixed"].items():
        print(f"joint '{name}' {why}: it is fixed")
    for note in result["notes"]:
        print(note)
    own, plain = result["error"]["adaptive"], result["error"]["computed_torque"]
    says = [f"{label} {_words(value)}" for label, value in result["error"].items()]
    print(f"settled rms error over all joints: {', '.join(says)}")
    if own is None or (plain is not None and own > 0.5 * plain):
        print("the transformation does not help here: try fewer --joints, or less --payload")
    path = written.files[0]
    screen.print(f"experiment and variants: {path.parent}", soft_wrap=True)
    screen.print(f"fpt simulate {path}\nfpt compare {path}", soft_wrap=True)


def _words(value: float | None) -> str:
    return "lost" if value is None else f"{value:.3g}"
