"""Sphinx configuration: `.ci/docs` builds these pages into `target/docs/html`."""

import os
import sys
from importlib.metadata import version as version_of
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "_ext"))
os.environ.setdefault("SAWFLUTTER_PROGRAM", str(Path(sys.prefix) / "bin" / "sawflutter"))
# A backend that the environment names would keep the figures of matplotlib out of the notebooks.
os.environ.pop("MPLBACKEND", None)
# Notebooks are run outside of the checkout and find its scenes and reference values by these.
os.environ["SAWFLUTTER_SCENES"] = str(Path(__file__).parents[1] / "scenes")
os.environ["SAWFLUTTER_REFERENCE"] = str(Path(__file__).parents[1] / "tests" / "reference")

project = "sawflutter"
author = "the sawflutter authors"
copyright = "the sawflutter authors; MIT or Apache-2.0"
release = version = version_of("sawflutter")

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "generated",
    "rust_items",
    "sphinx_design",
]
exclude_patterns = ["_generated", "_ext"]
nitpicky = True
# Types of other packages: their pages are on the net, and this build does not ask the net.
nitpick_ignore_regex = [
    ("py:.*", r"(?!sawflutter\.).*"),
    ("py:.*", r"sawflutter\._.*"),
    ("py:.*", r"sawflutter\.\w+\.[RT]"),
    # Charts are described by `help(sawflutter.plot)`.
    ("py:class", r"sawflutter\.plot\..*"),
]

myst_enable_extensions = ["amsmath", "attrs_inline", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3
os.environ.setdefault("SAWFLUTTER_PROGRAM", str(Path(sys.prefix) / "bin" / "sawflutter"))
# Notebooks are run outside of the checkout, and a cell that fails fails the build. `.ci/docs` keeps what they gave in a
# folder that is named after the program and the scenes; without one they are run anew.
nb_execution_mode = "cache" if "SAWFLUTTER_NOTEBOOKS" in os.environ else "force"
nb_execution_cache_path = os.environ.get("SAWFLUTTER_NOTEBOOKS", "")
nb_execution_in_temp = True
nb_execution_raise_on_error = True
nb_execution_timeout = 300
nb_merge_streams = True

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_default_options = {"members": True, "undoc-members": False, "show-inheritance": False}
napoleon_google_docstring = False
# The fields of a class are listed with it, and not described a second time.
napoleon_use_ivar = True

html_theme = "pydata_sphinx_theme"
html_title = "sawflutter"
html_static_path = ["_static"]
html_css_files = ["sawflutter.css"]
html_show_sourcelink = False
html_copy_source = False
html_theme_options = {
    "show_prev_next": True,
    "navigation_with_keys": False,
    "secondary_sidebar_items": ["page-toc"],
    "footer_start": ["copyright"],
    "footer_end": [],
}
# One file, in the repository: the pages load nothing from the net.
math_eqref_format = "Eq. {number}"
mathjax_path = "mathjax/tex-svg-full.js"
mathjax4_config = mathjax3_config = {"options": {"enableMenu": False}}


def _without_substitutions(app, what, name, obj, options, lines):
    """A magnitude like |λ| is no substitution of reStructuredText."""
    lines[:] = [line.replace("|", r"\|") for line in lines]


def setup(app):
    app.connect("autodoc-process-docstring", _without_substitutions, priority=100)
