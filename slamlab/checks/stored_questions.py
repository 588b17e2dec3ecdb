"""What lessons and exercises ask, as stored: a notebook asks by id, and no code tells answers."""

import json
from importlib import resources


def stored_question(id):
    """Look up what is asked by an id.

    Parameters
    ----------
    id : str such as "04-leaning", of an exercise "ex04-sign"

    Returns
    -------
    dict, the arguments of :func:`slamlab.checks.ask` but for the id

    Raises
    ------
    ValueError : there is no such question
    """
    notebook = id.split("-")[0]
    file = resources.files("slamlab").joinpath("data", "questions", f"{notebook}.json")
    asked = json.loads(file.read_text(encoding="utf-8")) if file.is_file() else {}
    if id not in asked:
        raise ValueError(f"there is no question {id!r}: its text, and what is right, must be given")
    told = asked[id]
    if "wrong" in told:
        told["wrong"] = dict(told["wrong"])  # pairs, for JSON's keys are no numbers
    return told
