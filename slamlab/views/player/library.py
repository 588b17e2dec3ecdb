"""The player's files joined: a script and a style sheet, for a widget or a page to begin with."""

import json
from pathlib import Path

from slamlab.views.colours import IN_LEGENDS

HERE = Path(__file__).parent
# what draws is one piece; for readers it is several
DRAWING = ("page.js", "theme.js", "plane.js", "panels.js", "drawing.js", "picture.js")
LIVE = (*DRAWING, "live_feed.js")
FILM = (*DRAWING, "film.js", "film_player.js")


def script(names, *paths):
    """Join JavaScript files of the library, and others after them; what legends say comes first.

    Parameters
    ----------
    names : sequence of str, files of the library: ``DRAWING``, ``LIVE`` or ``FILM``
    paths : Path of each file of the caller's own

    Returns
    -------
    str
    """
    words = f"const IN_LEGENDS = new Map({json.dumps(list(IN_LEGENDS.items()))});\n"
    return words + _joined([*map(HERE.joinpath, names), *paths])


def styles(*paths):
    """Join the library's style sheet and others after it.

    Parameters
    ----------
    paths : Path of each style sheet of the caller's own

    Returns
    -------
    str
    """
    return _joined([HERE / "player.css", *paths])


def _joined(paths):
    return "\n".join(path.read_text(encoding="utf-8") for path in paths)
