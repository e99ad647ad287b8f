"""The picture of robustness: a bar for each criterion and variant."""

from collections.abc import Mapping

from matplotlib.figure import Figure

from fpt_ros.analysis import style


def figure(found: Mapping[str, Mapping[str, float]], title: str) -> Figure:
    """Bars, a group for each criterion; ``found``: variant -> criterion -> share."""
    variants = list(found)
    criteria = list(next(iter(found.values())))
    with style.settings():
        picture = Figure(figsize=(8.0, 0.9 + 0.42 * len(criteria) * max(1.6, len(variants))))
        axes = picture.add_subplot()
        thick = 0.8 / len(variants)
        for at, variant in enumerate(variants):
            places = [i + (at - (len(variants) - 1) / 2) * thick for i in range(len(criteria))]
            shares = [100.0 * found[variant][criterion] for criterion in criteria]
            colour = style.COORDINATES[at % len(style.COORDINATES)]
            bars = axes.barh(places, shares, 0.9 * thick, label=variant, color=colour)
            axes.bar_label(bars, fmt="%.0f", padding=3)
        axes.set_yticks(range(len(criteria)), criteria)
        axes.invert_yaxis()
        axes.set_xlim(0.0, 108.0)
        axes.set_xlabel("cases in which the motion is followed [%]")
        axes.set_title(title, loc="left")
        if len(variants) > 1:
            axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0))
        picture.tight_layout()
    return picture
