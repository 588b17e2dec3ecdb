"""A cell's outputs on a page of the site: films and sliders in place of still pictures."""

import html
import json
import re

import nbformat

FILMED = "Here this is a film; in the notebook it runs live."
STILL = "Here this stands still; in the notebook it has controls."
STATIC = "../_static/rendered/"  # from a page of a notebook


def with_moving(cell, told, folder):
    """Put what was rendered of a cell in place of its stored picture, which stays where no script runs.

    Parameters
    ----------
    cell : NotebookNode, changed
    told : list of dict, see :class:`course.site.moving_pictures.Renderer`
    folder : str, name of the folder of its files
    """
    pictures = [output for output in cell.outputs if "<img" in _html(output)]
    for what, output in zip(told, pictures[-len(told) :], strict=False):
        output.data["text/html"] = _moving(what, _html(output), folder)
    if "film" in told[0]:  # one picture stands for the films of all sources
        kept = [each for each in told[1:] if "film" in each]
        cell.outputs += [_shown(_moving(each, "", folder)) for each in kept]
        tell(cell, FILMED)


def films_alone(told):
    """What was rendered of a lesson's live views, without its sliders.

    Parameters
    ----------
    told : dict, by a cell's id list of dict, see :class:`course.site.moving_pictures.Renderer`

    Returns
    -------
    dict
    """
    return {id: each for id, each in told.items() if all("film" in what for what in each)}


def tell(cell, words):
    """Say below a cell's outputs what they are on a page, and what they are in the notebook.

    Parameters
    ----------
    cell : NotebookNode, changed
    words : str
    """
    cell.outputs.append(_shown(f'<p class="slamlab-told">{words}</p>'))


def _html(output):
    return output.get("data", {}).get("text/html", "")


def _shown(text):
    return nbformat.v4.new_output("display_data", data={"text/html": text})


def _moving(what, still, folder):
    if "film" in what:
        where = f'data-folder="{STATIC}{folder}/" data-file="{html.escape(what["film"])}"'
        waiting = still or f"<p>Film: {html.escape(what['title'])}</p>"
        return f'<div class="slamlab-film" {where}>{waiting}</div>'
    # a picture's text stands in its own tag, so < need not be escaped twice
    data = json.dumps({"folder": f"{STATIC}{folder}/"} | what).replace("<", "\\u003c")
    picture = re.sub(r"<details>.*</details>", "", still, flags=re.DOTALL)
    script = f'<script type="application/json">{data}</script>'
    return f'<div class="slamlab-sliders">{picture}{script}</div>'
