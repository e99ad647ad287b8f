"""The site: Sphinx, because the docstrings are written for it (:func: roles, Google's sections).

Pages are Markdown (myst). ``site_pages.py`` makes commands and API from the code at each build.
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

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "site_pages"]
exclude_patterns = ["_*"]
myst_heading_anchors = 3

autodoc_typehints_format = "short"
napoleon_use_ivar = True  # fields are listed once
suppress_warnings = ["ref.python"]  # a field's name that several records have
nitpick_ignore_regex = [  # of other libraries
    ("py:class", ".*"),
    ("py:obj", ".*"),
    ("py:exc", r"csv\..*"),
]

html_theme = "furo"
html_title = f"fpt_ros {release}"
