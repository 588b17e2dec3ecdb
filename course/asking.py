"""Questions: a source asks in full, its notebook by the id, so that no code tells answers.

What is asked is kept in ``slamlab/data/questions/NN.json``, of an exercise in ``exNN.json``, where
``slamlab.checks.ask`` finds it.
"""

import ast
import json

from slamlab.checks.questions import wording

POSITIONAL = ("id", "text", "choices", "right")


def asked(code):
    """What a cell of code asks.

    Parameters
    ----------
    code : str

    Returns
    -------
    dict, the arguments of :func:`slamlab.checks.ask`, with the id; None where nothing is asked

    Raises
    ------
    ValueError : some of it is computed, which a file cannot hold
    """
    call = _call(code)
    if call is None:
        return None
    told = dict(zip(POSITIONAL, map(ast.literal_eval, call.args), strict=False))
    return told | {each.arg: ast.literal_eval(each.value) for each in call.keywords}


def asks(code):
    """Whether a cell of code asks a question.

    Parameters
    ----------
    code : str

    Returns
    -------
    bool
    """
    return _call(code) is not None


def short(code):
    """The code of a cell, which asks by the id alone; the unit stays, for phones need it.

    Parameters
    ----------
    code : str

    Returns
    -------
    str
    """
    told = asked(code)
    if told is None:
        return code
    call, lines = _call(code), code.split("\n")
    unit = f', unit="{told["unit"]}"' if told.get("unit") else ""
    lines[call.lineno - 1 : call.end_lineno] = [f'ask("{told["id"]}"{unit})']
    return "\n".join(lines)


def file(source, root):
    """Where the questions of a source are stored.

    Parameters
    ----------
    source : Source
    root : Path, the project's folder

    Returns
    -------
    Path
    """
    return root / "slamlab" / "data" / "questions" / f"{source.prefix}.json"


def text(source):
    """What is stored of a source's questions.

    Parameters
    ----------
    source : Source

    Returns
    -------
    str, JSON; "" where it asks nothing
    """
    found = [told for cell in source.cells if cell.type == "code" and (told := asked(cell.text))]
    stored = {told.pop("id"): told for told in found}
    for told in stored.values():
        if "wrong" in told:
            told["wrong"] = list(told["wrong"].items())
    return json.dumps(stored, ensure_ascii=False, indent=1) + "\n" if stored else ""


def reword(notebook, source):
    """Put what a source asks today into a notebook whose outputs were carried over, in place.

    A question's words are no code, so that new ones do not run the notebook again.

    Parameters
    ----------
    notebook : NotebookNode, with outputs
    source : Source
    """
    code = [cell.text for cell in source.cells if cell.type == "code"]
    words = {
        told["id"]: wording(told["text"], told.get("choices")) for told in map(asked, code) if told
    }
    for cell in notebook.cells:
        if cell.cell_type == "code" and (told := asked(cell.source)):
            shown = next(
                each.data for each in cell.outputs if "text/markdown" in each.get("data", {})
            )
            shown["text/markdown"] = shown["text/plain"] = words[told["id"]]


def _call(code):
    """The call of ``ask`` at the top level of some code, or None."""
    try:
        body = ast.parse(code).body
    except SyntaxError:
        return None
    calls = [each.value for each in body if isinstance(each, ast.Expr)]
    named = [each for each in calls if isinstance(each, ast.Call)]
    found = [each for each in named if isinstance(each.func, ast.Name) and each.func.id == "ask"]
    return found[0] if found else None
