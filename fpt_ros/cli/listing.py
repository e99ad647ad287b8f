"""``fpt list``."""

from fpt_ros.cli.options import Json


def list_experiments(json: Json = False) -> None:
    """Show all experiments and their variants, and what each shows.

    Example: fpt list
    """
    from fpt_ros.cli.output import console, print_json
    from fpt_ros.loop.experiment import available, load

    experiments = [
        {
            "experiment": name,
            "title": load(name).about["title"],
            "thesis": load(name).about["thesis"],
            "variants": {variant: load(name, variant).about["shows"] for variant in variants},
        }
        for name, variants in available().items()
    ]
    if json:
        print_json({"experiments": experiments})
        return
    from rich.table import Column, Table

    names = Column("experiment", no_wrap=True), Column("variant", no_wrap=True)
    shows_column = Column("what it shows", overflow="fold")
    table = Table(*names, shows_column, "thesis", box=None, pad_edge=False)
    for each in experiments:
        first = True
        variants = each["variants"]
        assert isinstance(variants, dict)
        for variant, shows in variants.items():
            head = (str(each["experiment"]), str(each["thesis"])) if first else ("", "")
            table.add_row(head[0], variant, str(shows), head[1])
            first = False
        table.add_row()
    console().print(table)
    console().print("fpt run NAME --variant VARIANT   (adaptive: the experiment as it is)")
