"""Pages that are made at each build: the commands and the API, from the code itself.

They are written to ``docs/reference/``, out of version control, before Sphinx reads its sources.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import typer
from typer.main import get_command

from fpt_ros.cli.app import app

HERE = Path(__file__).parent
PACKAGE = HERE.parent / "fpt_ros"
REFERENCE = HERE / "reference"
GUIDES = {"denoise": "Denoise a file", "filters": "Filters in the loop"}
"""Guides that have a place in the navigation whether they are written yet or not."""


def setup(sphinx: Any) -> dict[str, bool]:
    """Sphinx calls this once."""
    sphinx.connect("builder-inited", lambda _: write_pages())
    sphinx.connect("autodoc-process-docstring", escape_bars)
    sphinx.connect("autodoc-process-docstring", keep_sentence, priority=400)  # before napoleon
    sphinx.connect("missing-reference", neighbour)
    return {"parallel_read_safe": True}


def escape_bars(sphinx: Any, kind: str, name: str, of: Any, options: Any, lines: list[str]) -> None:
    """An absolute value, ``|x|``, is none of Sphinx's substitutions."""
    lines[:] = [
        "``".join(
            part if at % 2 else part.replace("|", "\\|") for at, part in enumerate(line.split("``"))
        )
        for line in lines
    ]


def keep_sentence(
    sphinx: Any, kind: str, name: str, of: Any, options: Any, lines: list[str]
) -> None:
    """What stands before a colon in the text of a constant is not its type."""
    if kind in ("data", "attribute"):
        lines.insert(0, "")


def neighbour(sphinx: Any, environment: Any, node: Any, content: Any) -> Any:
    """Find ``:mod:`healing``` or ``:func:`style.settings``` in the folder of the module itself.

    A bare name that has no entry (a constant without a sentence of its own) stays without a link.
    """
    if node.get("refdomain") != "py" or node["reftype"] == "class":
        return None
    folder = node.get("py:module", "").rpartition(".")[0]
    target = f"{folder}.{node['reftarget']}"
    found = environment.domains["py"].resolve_xref(
        environment, node["refdoc"], sphinx.builder, node["reftype"], target, node, content
    )
    return found or (None if "." in node["reftarget"] else content)


def write_pages() -> None:
    """Write all of them; files that have not changed are left alone."""
    wanted = {"commands.md": commands(), **api()}
    for name, text in wanted.items():
        _write(REFERENCE / name, text)
    for path in REFERENCE.rglob("*"):
        if path.is_file() and str(path.relative_to(REFERENCE)) not in wanted:
            path.unlink()
    for name, title in GUIDES.items():
        path = HERE / "guides" / f"{name}.md"
        if not path.exists():
            _write(path, f"# {title}\n\nThis guide is not written yet: see `fpt {name} --help`.\n")


def _all_commands(group: Any, context: Any, before: str = "") -> Iterator[tuple[str, Any, Any]]:
    """Name, command and context of each, those of a group behind it."""
    for name in group.list_commands(context):
        command = group.get_command(context, name)
        inner = typer.Context(command, info_name=name, parent=context)
        yield f"{before}{name}", command, inner
        if hasattr(command, "list_commands"):
            yield from _all_commands(command, inner, f"{before}{name} ")


def commands() -> str:
    """The page of all commands."""
    root = get_command(app)
    context = typer.Context(root, info_name="fpt")
    parts = ["# Commands\n", f"{root.help}\n", "Each command explains itself with `--help`.\n"]
    for name, command, inner in _all_commands(root, context):
        usage = " ".join(command.collect_usage_pieces(inner))
        parts.append(f"## fpt {name}\n\n```text\nfpt {name} {usage}\n```\n")
        for paragraph in command.help.split("\n\n"):
            text = " ".join(paragraph.split())
            example = text.removeprefix("Example: ")
            parts.append(f"```sh\n{example}\n```\n" if example != text else f"{text}\n")
        rows = [record for each in command.params if (record := each.get_help_record(inner))]
        rows += [
            (each.make_metavar(inner), each.help)
            for each in command.params
            if each.param_type_name == "argument" and not each.get_help_record(inner)
        ]
        parts.append("| argument or option | meaning |\n| --- | --- |")
        parts += [f"| `{_cell(what)}` | {_cell(meaning)} |" for what, meaning in rows]
        parts.append("")
    return "\n".join(parts)


def _cell(text: str | None) -> str:
    return " ".join((text or "").split()).replace("|", "\\|")


def api() -> dict[str, str]:
    """A page for each folder of the package, with all modules in it."""
    pages, names = {}, []
    for folder in [PACKAGE, *sorted(path for path in PACKAGE.rglob("*") if path.is_dir())]:
        if not (folder / "__init__.py").exists():
            continue
        name = ".".join(folder.relative_to(PACKAGE.parent).parts)
        names.append(name)
        parts = [_title(name, "="), _module(name)]
        for path in sorted(folder.glob("*.py")):
            if not path.stem.startswith("_"):
                parts += [_title(path.stem, "-"), _module(f"{name}.{path.stem}")]
        pages[f"api/{name}.rst"] = "\n".join(parts)
    tree = "\n".join(f"   {name}" for name in names)
    pages["api/index.rst"] = (
        _title("API", "=") + "\nA page for each folder of ``fpt_ros``, from its docstrings.\n\n"
        f".. toctree::\n   :maxdepth: 1\n\n{tree}\n"
    )
    return pages


def _module(name: str) -> str:
    return f".. automodule:: {name}\n   :members:\n   :member-order: bysource\n"


def _title(text: str, line: str) -> str:
    return f"{text}\n{line * len(text)}\n"


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")
