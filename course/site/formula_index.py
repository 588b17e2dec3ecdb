"""Index of formulas: each numbered equation with its lesson, code and tests."""

import ast
import re
from functools import cache

from course.equations import DISPLAY, TAG
from course.site import public_names
from course.source import ROOT, file_name, sources

_NAMED = re.compile(r"[Ee]quations? ((?:\(\d\d\.\d+\)(?:, | and )?)+)")
_NUMBER = re.compile(r"\((\d\d\.\d+)\)")
_HEAD = """\
# Formula, lesson, code, test

This page lists each numbered formula of the lessons, the functions of the library that compute it, and the tests of
these functions. The pages of public functions give shapes and units.

"""


def page():
    """Return the page as Markdown.

    Returns
    -------
    str
    """
    code, parts = functions(), [_HEAD]
    for path in sources():
        formulas = equations(path) if path.parent.name == "lessons" else []
        if not formulas:
            continue
        title = re.search(r"^# # (.+)", path.read_text(encoding="utf-8"), re.MULTILINE)[1]
        link = f"notebooks/{file_name(path)}"
        parts.append(f"## [{title}]({link})\n")
        parts += [_entry(number, formula, code.get(number, [])) for number, formula in formulas]
    return "\n".join(parts) + "\n"


def equations(path):
    """Return the numbered equations of a lesson, each (number, LaTeX without the number).

    Parameters
    ----------
    path : Path, its source

    Returns
    -------
    list of (str, str)
    """
    text = re.sub(r"^# ?", "", path.read_text(encoding="utf-8"), flags=re.MULTILINE)
    shown = [formula for formula in DISPLAY.findall(text) if TAG.search(formula)]
    return [(TAG.search(formula)[1], TAG.sub("", formula).strip()) for formula in shown]


@cache
def functions():
    """Map the number of an equation to the public names that cite "Equation (NN.k)".

    Returns
    -------
    dict, str to list of str such as "slamlab.models.h"
    """
    found = {}
    for path in sorted((ROOT / "slamlab").rglob("*.py")):
        module = ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.FunctionDef | ast.ClassDef) and not node.name.startswith("_"):
                for named in _NAMED.findall(ast.get_docstring(node) or ""):
                    for number in _NUMBER.findall(named):
                        found.setdefault(number, []).append(f"{module}.{node.name}")
    return found


@cache
def _tests():
    return {
        path.relative_to(ROOT).as_posix(): set(re.findall(r"\w+", path.read_text("utf-8")))
        for path in sorted((ROOT / "tests").rglob("test_*.py"))
    }


def _entry(number, formula, names):
    lines = [f"**({number})**\n\n$$ {formula} $$\n"]
    for name in names:
        module, function = name.rsplit(".", 1)
        component = module.split(".")[1]
        tests = [
            file
            for file, words in _tests().items()
            if {function, module.rsplit(".", 1)[1]} <= words or {function, component} <= words
        ]
        named = ", ".join(f"`{file}`" for file in tests[:3])
        page = public_names.page_of(module, function)
        linked = f"[`{name}`](api/{page}.md)" if page else f"`{name}`"
        lines.append(f"- {linked}" + (f", tested by {named}" if named else ""))
    return "\n".join(lines) + "\n"
