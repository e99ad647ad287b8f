"""The site: Sphinx, because the docstrings are written for it (:func: roles, Google's sections).

Pages are Markdown (myst). The API is read from the package tree without importing it (autoapi), the
commands are read from the command line's own definition (``commands.py``), so neither can go stale.
"""

import sys
from pathlib import Path
from xml.etree import ElementTree

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))

project = "fpt_ros"
author = "The fpt_ros team"
copyright = author
release = ElementTree.parse(HERE.parent / "package.xml").findtext("version")

extensions = ["myst_parser", "sphinx.ext.napoleon", "autoapi.extension", "site_pages"]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
exclude_patterns = ["_*"]

myst_enable_extensions = ["colon_fence"]
myst_heading_anchors = 3

autoapi_dirs = ["../fpt_ros"]
autoapi_root = "reference/api"
autoapi_options = ["members", "undoc-members", "show-module-summary"]
autoapi_member_order = "bysource"
autoapi_add_toctree_entry = False
autoapi_keep_files = False
autoapi_python_class_content = "both"

html_theme = "furo"
html_title = f"fpt_ros {release}"
html_static_path: list[str] = []
