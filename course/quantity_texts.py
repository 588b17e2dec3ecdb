"""Texts about a quantity that a mistake hits (:mod:`course.quantities`), for students."""

import ast
import re

ORDINALS = ("first", "second", "third", "fourth", "fifth")


def question(hit, questions) -> str:
    """Return the question of the first quantity that has one, or ""."""
    for each in hit:
        name = each.partition(".")[2]
        for key in (each, name, *name.split(", "), re.split(r"[\[. ]", name)[0]):
            if key in questions:
                return questions[key]
    return ""


def place(hit, visible) -> str:
    """Describe the only quantity that was hit in words that a student knows, or return "".

    Parameters
    ----------
    hit : tuple of str, from :func:`changed`
    visible : set of str, names in the student's notebook
    """
    if len(hit) != 1:
        return ""
    function, _, name = hit[0].partition(".")
    if name.startswith("result"):
        number = name.partition(" ")[2]
        which = f"the {ORDINALS[int(number) - 1]} value" if number else "the value"
        return f"{which} that `{function}` returns"
    known = set(re.findall(r"[^\W\d]\w*", name)) <= visible
    return f"the computation of `{name}`" if known else ""


def visible_names(cells) -> set[str]:
    """Return the names that a student sees: in formulas and code of the text, and in signatures."""
    found = set()
    for cell in cells:
        if cell.type == "markdown":
            for code, formula in re.findall(r"`([^`]+)`|\$\$?([^$]+)\$", cell.text):
                found |= set(re.findall(r"[^\W\d]\w*", code or formula))
        elif not cell.check:
            for node in ast.walk(ast.parse(re.sub(r"^[%!].*", "", cell.text, flags=re.M))):
                if isinstance(node, ast.FunctionDef):
                    text = ast.get_docstring(node) or ""
                    found |= {argument.arg for argument in node.args.args}
                    found |= set(re.findall(r"[^\W\d]\w*(?=,? [:(])", text))
    return found
