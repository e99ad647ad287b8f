"""``fpt list``."""

from fpt_ros.cli.options import Json


def list_experiments(json: Json = False) -> None:
    """Show all experiments and their variants, and what each shows.

    Example: fpt list
    """
    from fpt_ros.cli.output import console, print_json
    from fpt_ros.experiments.experiment import BASE, available, described

    experiments = []
    for name, variants in available().items():
        about = {variant: described(name, variant) for variant in variants}
        base = about[BASE]
        experiments.append(
            {
                "experiment": name,
                "title": base["title"],
                "thesis": base["thesis"],
                "variants": {variant: each["shows"] for variant, each in about.items()},
            }
        )
    if json:
        print_json({"experiments": experiments})
        return
    from rich.table import Table
    from rich.text import Text

    screen = console()
    for one in experiments:
        heading = Text(str(one["experiment"]), "bold")
        screen.print(heading.append(f"  {one['title']} ({one['thesis']})", "dim"))
        table = Table(box=None, show_header=False, padding=(0, 2, 0, 2))
        shown = one["variants"]
        assert isinstance(shown, dict)
        for variant, shows in shown.items():
            table.add_row(variant, Text(str(shows)))
        screen.print(table)
    screen.print("fpt run NAME --variant VARIANT   (adaptive: the experiment as it is)")
