"""The loop of an experiment as a drawing: blocks, laws, delays, signals with their units, as SVG.

The thesis draws its schemes by hand (4.1, 4.2, 4.7, 4.8, 5.1); here the drawing follows from the
parameters, so that it shows what runs: stages left out are not drawn.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from xml.sax.saxutils import escape

from fpt_ros.cycle.stages import Loop
from fpt_ros.experiments.experiment import Experiment
from fpt_ros.parameters import flag, integer, number, word, words

WIDTH, HEIGHT, GAP, MARGIN = 190, 92, 66, 24
INK, QUIET, FILL, SIGNAL = "#1c2430", "#5b6675", "#f2f5f9", "#1f5fa8"


@dataclass(frozen=True)
class Block:
    """A box: its title, and lines on what it does."""

    title: str
    lines: tuple[str, ...]


@dataclass(frozen=True)
class Arrow:
    """What goes from one box to the next."""

    text: str


def blocks(experiment: Experiment, loop: Loop) -> list[tuple[Block, Arrow]]:
    """The boxes around the loop, each with the signal that leaves it."""
    plant, denoiser, motion = loop.plant, loop.denoiser, loop.trajectory
    deformer, of = loop.deformer, loop.plant.plant
    units, derivative = sorted(set(of.units)), {2: "''", 1: "'", 0: ""}[of.order]
    per = {2: "/s²", 1: "/s", 0: ""}[of.order]
    unit = f" [{', '.join(units)}]" if any(units) else ""
    rate = f" [{', '.join(x + per for x in units)}]" if any(units) else ""
    effort_units = sorted(set(of.effort_units))
    effort = f" [{', '.join(effort_units)}]" if any(effort_units) else ""
    names = ", ".join(motion.controlled)
    found = [
        (
            Block(
                "nominal motion",
                (
                    word(motion.values, "trajectory"),
                    f"of {names}",
                    *_if(motion.constants.late, f"late by {motion.constants.late:g} s"),
                    *_if(motion.constants.slots, "time sharing"),
                ),
            ),
            Arrow(f"q^N{unit}"),
        ),
        (
            Block(
                "error relaxation",
                (
                    word(motion.values, "error_relaxation"),
                    f"Λ = {number(motion.values, 'lambda'):g} /s",
                ),
            ),
            Arrow(f"desired q{derivative}{rate}"),
        ),
    ]
    if deformer.transformation.adapts:
        values = deformer.values
        delay = integer(values, "learning_delay")
        found.append(
            (
                Block(
                    "deformation",
                    (
                        word(values, "transformation"),
                        f"A = {deformer.gain:g}",
                        *_if(delay > 1, f"learning delay {delay} cycles"),
                        *_if(flag(values, "synchronised"), "synchronised with the filter"),
                    ),
                ),
                Arrow(f"r{rate}"),
            )
        )
    compensator = word(deformer.values, "compensator.kind")
    found.append(
        (
            Block(
                "approximate model",
                (
                    word(deformer.values, "model"),
                    *_if(compensator != "none", f"with {compensator}"),
                ),
            ),
            Arrow(f"effort{effort}"),
        )
    )
    actuators = words(plant.values, "actuators.kinds")
    if actuators:
        found.append((Block("actuators", tuple(actuators)), Arrow(f"effort that acts{effort}")))
    disturbance = word(plant.values, "disturbance.kind")
    amplitude = number(plant.values, "disturbance.amplitude")
    found.append(
        (
            Block(
                "exact plant",
                (
                    word(plant.values, "plant"),
                    f"dt = {plant.dt * 1e3:g} ms",
                    "integrates itself"
                    if of.advance is not None
                    else word(plant.values, "integrator.kind"),
                    *_if(disturbance != "none" and amplitude, f"disturbed by {disturbance}"),
                ),
            ),
            Arrow(f"q{unit}"),
        )
    )
    late = integer(plant.values, "measurement_delay")
    sensors = [
        *words(plant.values, "sensors.kinds"),
        *_if(plant.noisy, "noise"),
        *_if(late, f"late by {late} cycles"),
        *_if(word(plant.values, "measured") == "position", "positions only"),
    ]
    if sensors:
        found.append((Block("sensors", tuple(sensors)), Arrow(f"measured q{unit}")))
    healing, method = word(denoiser.values, "healing.kind"), word(denoiser.values, "method")
    found.append(
        (
            Block(
                "filter" if method != "none" else "differences",
                (
                    method if method != "none" else "no filter",
                    *_if(healing != "none", f"healing: {healing}"),
                ),
            ),
            Arrow("motion as found"),
        )
    )
    return found


def _if(condition: object, line: str) -> tuple[str, ...]:
    return (line,) if condition else ()


def svg(experiment: Experiment) -> str:
    """The drawing as the text of an SVG file."""
    loop = experiment.loop()
    around = blocks(experiment, loop)
    top = (len(around) + 1) // 2
    places = [(column, 0) for column in range(top)]
    places += [(top - 1 - column, 1) for column in range(len(around) - top)]
    parts = []
    tuner = loop.tuner.active
    width = 2 * MARGIN + top * WIDTH + (top - 1) * GAP + (GAP if tuner else 0)
    height = 3 * MARGIN + 40 + 2 * HEIGHT + 90 + (HEIGHT + 50 if tuner else 0)
    for (block, _), place in zip(around, places, strict=True):
        parts += _box(block, *_corner(place))
    for i, (_, arrow) in enumerate(around):
        parts += _arrow(arrow.text, places[i], places[(i + 1) % len(around)], i + 1 == len(around))
    titles = [block.title for block, _ in around]
    if "deformation" in titles:
        parts += _observed(places[titles.index("deformation")])
    if tuner:
        parts += _tuner(loop, around, places)
    about = experiment.about
    title = f"{experiment.name} · {experiment.variant}: {about['title']}"
    return "\n".join(
        (
            (
                f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
                f'width="{width}" height="{height}" font-family="sans-serif" role="img">'
            ),
            f"<title>{escape(title)}</title>",
            (
                '<defs><marker id="head" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="7" '
                f'markerHeight="7" orient="auto"><path d="M0 0L10 5L0 10z" fill="{SIGNAL}"/>'
                "</marker></defs>"
            ),
            f'<rect width="{width}" height="{height}" fill="white"/>',
            _text(MARGIN, MARGIN + 14, title, 15, INK, weight="bold"),
            *parts,
            "</svg>",
            "",
        )
    )


def _corner(place: tuple[int, int]) -> tuple[int, int]:
    column, row = place
    return MARGIN + column * (WIDTH + GAP), 2 * MARGIN + 40 + row * (HEIGHT + 90)


def _box(block: Block, x: int, y: int) -> list[str]:
    lines = [
        (
            f'<rect x="{x}" y="{y}" width="{WIDTH}" height="{HEIGHT}" rx="7" fill="{FILL}" '
            f'stroke="{INK}"/>'
        ),
        _text(x + WIDTH / 2, y + 22, block.title, 14, INK, "middle", "bold"),
    ]
    for i, line in enumerate(block.lines[:4]):
        lines.append(_text(x + WIDTH / 2, y + 40 + 15 * i, line, 12, QUIET, "middle"))
    return lines


def _arrow(text: str, start: tuple[int, int], end: tuple[int, int], last: bool) -> list[str]:
    """From a box to the next; the last one goes back to the error relaxation, the second box."""
    if last:
        end = (1, 0)
    (x, y), (to_x, to_y) = _corner(start), _corner(end)
    middle = y + HEIGHT / 2
    if start[1] == end[1]:
        right = end[0] > start[0]
        begin = x + WIDTH if right else x
        stop = to_x if right else to_x + WIDTH
        label = (begin + stop) / 2
        return [
            _line(f"M{begin} {middle}L{stop} {middle}"),
            _text(label, middle - HEIGHT / 2 - 7, text, 12, SIGNAL, "middle"),
        ]
    x_a, x_b = x + WIDTH / 2, to_x + WIDTH / 2
    y_a, y_b = (y + HEIGHT, to_y) if end[1] else (y, to_y + HEIGHT)
    half = (y_a + y_b) / 2
    anchor = "end" if end[1] else "start"
    at = x_a - 8 if end[1] else x_b + 8
    return [
        _line(f"M{x_a} {y_a}L{x_a} {half}L{x_b} {half}L{x_b} {y_b}"),
        _text(at, half - 7, text, 12, SIGNAL, anchor),
    ]


def _observed(deformation: tuple[int, int]) -> list[str]:
    """The response observed goes on from the relaxation to the deformation."""
    (x, y), (to_x, _) = _corner((1, 0)), _corner(deformation)
    half, end = y + HEIGHT + 45, to_x + 30
    return [
        _line(f"M{x + WIDTH / 2} {half}L{end} {half}L{end} {y + HEIGHT}"),
        _text(end - 8, half - 7, "observed response", 12, SIGNAL, "end"),
    ]


def _tuner(
    loop: Loop, around: Sequence[tuple[Block, Arrow]], places: Sequence[tuple[int, int]]
) -> list[str]:
    """The tuner under the loop, from the filter to what it tunes."""
    values = loop.tuner.values
    method = word(values, "method")
    tunes = loop.tuner.law.tunes or "nothing"
    guard = "precursor guard" if flag(values, "precursor_guard") else "precursor"
    lines = (f"{method}: {tunes}",) if method != "none" else (guard,)
    source = places[-1]
    titles = [block.title for block, _ in around]
    wanted = "approximate model" if tunes == "coefficients" else "deformation"
    target = places[titles.index(wanted)] if wanted in titles else places[1]
    x, y = _corner((source[0], 2))
    y -= 40
    to_x, to_y = _corner(target)
    edge = to_x + WIDTH - 20
    return [
        *_box(Block("tuner", lines), x, y),
        _line(f"M{x + WIDTH / 2} {_corner(source)[1] + HEIGHT}L{x + WIDTH / 2} {y}"),
        _line(
            f"M{x + WIDTH} {y + HEIGHT / 2}L{edge + 44} {y + HEIGHT / 2}"
            f"L{edge + 44} {to_y + HEIGHT + 20}L{edge} {to_y + HEIGHT + 20}"
            f"L{edge} {to_y + HEIGHT}"
        ),
    ]


def _line(path: str) -> str:
    return (
        f'<path d="{path}" fill="none" stroke="{SIGNAL}" stroke-width="1.6" '
        'marker-end="url(#head)"/>'
    )


def _text(
    x: float, y: float, text: str, size: int, colour: str, anchor: str = "start", weight: str = ""
) -> str:
    bold = f' font-weight="{weight}"' if weight else ""
    return (
        f'<text x="{x:g}" y="{y:g}" font-size="{size}" fill="{colour}" '
        f'text-anchor="{anchor}"{bold}>{escape(text)}</text>'
    )
