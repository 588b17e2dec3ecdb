"""Question cells: a source contains the whole question, but its notebook contains only the id, so
that the code does not reveal answers.

Questions of a lesson are stored in ``course/questions/NN.json``, those of an exercise in
``questions.json`` in its folder. ``classroom.checks.ask`` reads them there.
"""

import ast
import json

from classroom.checks.question_widgets import wording

POSITIONAL = ("id", "text", "choices", "right")


def asked(code):
    """Parse the question of a code cell.

    Parameters
    ----------
    code : str

    Returns
    -------
    dict, the arguments of :func:`classroom.checks.ask`, with the id; None without a question

    Raises
    ------
    ValueError : a part is computed, which a file cannot store
    """
    call = _call(code)
    if call is None:
        return None
    question = dict(zip(POSITIONAL, map(ast.literal_eval, call.args), strict=False))
    return question | {each.arg: ast.literal_eval(each.value) for each in call.keywords}


def asks(code):
    """Return whether a code cell asks a question.

    Parameters
    ----------
    code : str

    Returns
    -------
    bool
    """
    return _call(code) is not None


def short(code):
    """Return a cell's code reduced to the question's id, and to the unit, which phones need.

    Parameters
    ----------
    code : str

    Returns
    -------
    str
    """
    question = asked(code)
    if question is None:
        return code
    call, lines = _call(code), code.split("\n")
    unit = f', unit="{question["unit"]}"' if question.get("unit") else ""
    lines[call.lineno - 1 : call.end_lineno] = [f'ask("{question["id"]}"{unit})']
    return "\n".join(lines)


def file(source, root):
    """Return the file in which a source's questions are stored.

    Parameters
    ----------
    source : Source
    root : Path, the project's folder

    Returns
    -------
    Path
    """
    if source.kind == "exercise":
        return source.path.with_name("questions.json")
    return root / "course" / "questions" / f"{source.prefix}.json"


def text(source):
    """Return the stored form of a source's questions.

    Parameters
    ----------
    source : Source

    Returns
    -------
    str, JSON; "" without questions
    """
    found = [each for cell in source.cells if cell.type == "code" and (each := asked(cell.text))]
    stored = {question.pop("id"): question for question in found}
    for question in stored.values():
        if "wrong" in question:
            question["wrong"] = list(question["wrong"].items())
    return json.dumps(stored, ensure_ascii=False, indent=1) + "\n" if stored else ""


def reword(notebook, source):
    """Update the wording of questions in place in a notebook whose outputs were carried over.

    A question's wording is not code, so the notebook is not run again when the wording changes.

    Parameters
    ----------
    notebook : NotebookNode, with outputs
    source : Source
    """
    code = [cell.text for cell in source.cells if cell.type == "code"]
    words = {
        each["id"]: wording(each["text"], each.get("choices")) for each in map(asked, code) if each
    }
    for cell in notebook.cells:
        if cell.cell_type == "code" and (question := asked(cell.source)):
            shown = next(
                each.data for each in cell.outputs if "text/markdown" in each.get("data", {})
            )
            shown["text/markdown"] = shown["text/plain"] = words[question["id"]]


def _call(code):
    """Find the call of ``ask`` at the top level of a cell's code, or return None."""
    try:
        body = ast.parse(code).body
    except SyntaxError:
        return None
    calls = [each.value for each in body if isinstance(each, ast.Expr)]
    named = [each for each in calls if isinstance(each, ast.Call)]
    found = [each for each in named if isinstance(each.func, ast.Name) and each.func.id == "ask"]
    return found[0] if found else None
