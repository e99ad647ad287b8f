"""The pages lead somewhere: links, navigation, and what is made from the code."""

import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
sys.path.insert(0, str(DOCS))

import site_pages  # noqa: E402

from fpt_ros.cli.app import COMMANDS  # noqa: E402

MADE = {"reference/commands.md", "reference/api/index"}
"""Made at each build of the site."""

LATER = {f"guides/{name}.md" for name in site_pages.GUIDES}
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted(DOCS.glob("**/*.md"))]
LINK = re.compile(r"\]\(([^)\s]+)\)")


def source(page):
    return re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.M | re.S)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_between_files_lead_to_a_file(page):
    for link in LINK.findall(source(page)):
        name, _, anchor = link.partition("#")
        if re.match(r"\w+:", name):
            continue
        target = (page.parent / name).resolve() if name else page
        if target.is_relative_to(DOCS) and str(target.relative_to(DOCS)) in MADE | LATER:
            continue
        assert target.exists(), link
        if anchor:
            headings = re.findall(r"^#+ (.*)", source(target), re.MULTILINE)
            slugs = {re.sub(r"[^\w\- ]", "", each.lower()).replace(" ", "-") for each in headings}
            assert anchor in slugs, link


def test_every_page_is_in_the_navigation_and_every_entry_is_a_page():
    trees = re.findall(r"```\{toctree\}\n(.*?)```", (DOCS / "index.md").read_text(), re.DOTALL)
    entries = [line for tree in trees for line in tree.splitlines() if line and line[0] != ":"]
    pages = {
        str(path.relative_to(DOCS).with_suffix(""))
        for path in DOCS.glob("**/*.md")
        if not path.is_relative_to(DOCS / "reference")
    }
    wanted = {name.removesuffix(".md") for name in MADE | LATER} | pages - {"index"}
    assert sorted(entries) == sorted(wanted)


def test_the_page_of_commands_has_every_command_with_its_options():
    page = site_pages.commands()
    assert re.findall(r"^## fpt ([\w-]+)$", page, re.MULTILINE) == [
        *(name for name, *_ in COMMANDS),
        "params",
    ]
    assert "| `--record DIR` |" in page


def test_the_api_has_every_module_once():
    text = "\n".join(site_pages.api().values())
    named = re.findall(r"automodule:: (\S+)", text)
    package = ROOT / "fpt_ros"
    files = {
        ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")
        for path in package.rglob("*.py")
    }
    assert sorted(named) == sorted(files)
