"""Sphinx extension that typesets all formulas with one call of KaTeX during the build.

Pages then need no JavaScript for formulas; MathML is included for screen readers.
"""

import hashlib
import html
import json
import re
import subprocess
from pathlib import Path

from docutils import nodes
from sphinx.errors import ExtensionError
from sphinx.util import logging

HERE = Path(__file__).parent
DERIVATION = 'class="slamlab-derivation"'  # an output in HTML, its formulas between dollars
_OPEN = '<div class="formula" role="group" aria-label="Formula">'
_BETWEEN_DOLLARS = re.compile(r"\$([^$]+)\$")
_logger = logging.getLogger(__name__)


def setup(app):
    """Register with Sphinx."""
    app.add_config_value("katex_modules", None, "", types=str)
    app.add_html_math_renderer("katex", (_visit_inline, None), (_visit_block, None))
    app.connect("env-updated", _typeset_all)
    app.connect("doctree-resolved", _set_derivations)
    return {"parallel_read_safe": True, "version": "1"}


def _typeset_all(app, env):
    """Typeset each formula that is not cached."""
    known = _read(app)
    wanted = {}
    for name in env.found_docs:
        for formula, line in _formulas(env.get_doctree(name)):
            wanted.setdefault(_key(*formula), (formula, (name, line)))
    missing = {key: found for key, found in wanted.items() if key not in known}
    if missing:
        results = _typeset([formula for formula, _ in missing.values()], app.config.katex_modules)
        for (key, (formula, place)), made in zip(missing.items(), results, strict=True):
            if "error" in made:
                _logger.warning("formula %s: %s", formula[0], made["error"], location=place)
            else:
                known[key] = made["html"]
        _file(app).write_text(json.dumps(known), encoding="utf-8")
    app.env.katex_html = known
    return []


def _formulas(doctree):
    """Yield each formula of a page as (LaTeX, whether displayed) with its line."""
    for node in doctree.findall(lambda node: isinstance(node, nodes.math | nodes.math_block)):
        yield (node.astext(), isinstance(node, nodes.math_block)), node.line
    for node in doctree.findall(_is_derivation):
        for latex in _BETWEEN_DOLLARS.findall(node.astext()):
            yield (html.unescape(latex), False), node.line


def _is_derivation(node):
    return isinstance(node, nodes.raw) and DERIVATION in node.astext()


def _set_derivations(app, doctree, _):
    """Typeset the LaTeX formulas of derivations, which notebooks store as HTML."""

    def formula(found):
        made = app.env.katex_html.get(_key(html.unescape(found[1]), False), found[0])
        return f"{_OPEN}{made}</div>" if found[1].startswith(r"\displaystyle") else made

    for node in doctree.findall(_is_derivation):
        node[0] = nodes.Text(_BETWEEN_DOLLARS.sub(formula, node.astext()))


def _typeset(formulas, modules):
    """Typeset each formula (LaTeX, whether displayed) in one process; return its HTML or error."""
    command = ["node", str(HERE / "typeset.mjs"), modules]
    done = subprocess.run(
        command, input=json.dumps(formulas), capture_output=True, text=True, encoding="utf-8"
    )
    if done.returncode:
        raise ExtensionError(f"KaTeX failed:\n{done.stderr[-2000:]}")
    return json.loads(done.stdout)


def _key(latex, displayed):
    return hashlib.sha256(f"{int(displayed)}{latex}".encode()).hexdigest()


def _file(app):
    return Path(app.doctreedir) / "formulas.json"


def _read(app):
    try:
        return json.loads(_file(app).read_text(encoding="utf-8"))
    except (FileNotFoundError, ValueError):
        return {}


def _html(visitor, node):
    key = _key(node.astext(), isinstance(node, nodes.math_block))
    return visitor.builder.env.katex_html.get(key, visitor.encode(node.astext()))


def _visit_inline(visitor, node):
    visitor.body.append(_html(visitor, node))
    raise nodes.SkipNode


def _visit_block(visitor, node):
    visitor.body.append(_OPEN)
    visitor.body.append(_html(visitor, node))
    visitor.body.append("</div>\n")
    raise nodes.SkipNode
