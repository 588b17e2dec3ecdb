"""Outputs of a cell on a page of the site: films and sliders instead of still pictures."""

import html
import json
import re

import nbformat

FILMED = "This page shows a film; in the notebook, the view runs live."
STILL = "This page shows a still picture; in the notebook, the figure has controls."
STATIC = "../_static/rendered/"  # from a page of a notebook


def with_moving(cell, rendered, folder):
    """Replace a cell's stored pictures with renderings; without scripts, the pictures remain.

    Parameters
    ----------
    cell : NotebookNode, changed
    rendered : list of dict, see :class:`course.site.moving_pictures.Renderer`
    folder : str, name of the folder of its files
    """
    pictures = [output for output in cell.outputs if "<img" in _html(output)]
    for what, output in zip(rendered, pictures[-len(rendered) :], strict=False):
        output.data["text/html"] = _moving(what, _html(output), folder)
    if "film" in rendered[0]:  # one picture represents the films of all sources
        kept = [each for each in rendered[1:] if "film" in each]
        cell.outputs += [_shown(_moving(each, "", folder)) for each in kept]
        add_note(cell, FILMED)


def films_alone(rendered):
    """Return the renderings of a lesson's live views, without those of the sliders.

    Parameters
    ----------
    rendered : dict, by a cell's id list of dict, see :class:`course.site.moving_pictures.Renderer`

    Returns
    -------
    dict
    """
    return {id: each for id, each in rendered.items() if all("film" in what for what in each)}


def add_note(cell, words):
    """Add a note below a cell's outputs that describes the difference from the notebook.

    Parameters
    ----------
    cell : NotebookNode, changed
    words : str
    """
    cell.outputs.append(_shown(f'<p class="slamlab-note">{words}</p>'))


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
