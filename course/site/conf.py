"""Sphinx configuration of the site; ``course.site.building`` adds machine-dependent settings."""

import gc

gc.set_threshold(100_000)  # parsed pages are many objects, and little of them is garbage

project = "An executable SLAM course"
author = "the slamlab authors"
copyright = author
language = "en"
extensions = [
    "course.site.docstrings",
    "course.site.katex",
    "course.site.symbol_search",
    "myst_nb",
    "sphinx.ext.autodoc",
    "numpydoc",
    "sphinx.ext.viewcode",
    "sphinx_copybutton",
]
exclude_patterns = ["_static/**"]

_SCRIPTS = ("progress.js", "scrolling.js", "sliders.js", "films_on_page.js")
html_theme = "furo"
html_title = project
html_math_renderer = "katex"
html_copy_source = False
html_show_sourcelink = False
html_show_search_summary = False  # pages opened as files cannot fetch it
html_static_path = ["_static"]
html_css_files = ["katex/katex.min.css", "player.css", "site.css"]
html_js_files = [(name, {"defer": "defer"}) for name in _SCRIPTS]
html_theme_options = {"navigation_with_keys": True, "top_of_page_buttons": []}
pygments_style = "a11y-high-contrast-light"
pygments_dark_style = "a11y-high-contrast-dark"
copybutton_selector = ".cell_input div.highlight > pre"

nb_execution_mode = "off"  # notebooks are stored with their outputs
nb_merge_streams = True
nb_mime_priority_overrides = [("html", "text/html", 0)]
myst_enable_extensions = ["dollarmath", "amsmath", "deflist", "attrs_inline"]
myst_heading_anchors = 3
suppress_warnings = ["mystnb.unknown_mime_type"]

autodoc_member_order = "bysource"
autodoc_typehints = "none"
numpydoc_show_class_members = False
numpydoc_validation_checks = set()
