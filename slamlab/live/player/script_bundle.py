"""Script bundle: the player's files joined into one script and one style sheet."""

import json
from pathlib import Path

from slamlab.views.colours import IN_LEGENDS

HERE = Path(__file__).parent
DRAWING = ("page.js", "theme.js", "plane.js", "panels.js", "drawing.js", "picture.js")
LIVE = (*DRAWING, "live_feed.js")
FILM = (*DRAWING, "film.js", "film_player.js")


def script(names, *paths):
    """Join the player's files (``DRAWING``, ``LIVE`` or ``FILM``) and other files into a script."""
    labels = f"const IN_LEGENDS = new Map({json.dumps(list(IN_LEGENDS.items()))});\n"
    return labels + _joined([*map(HERE.joinpath, names), *paths])


def styles(*paths):
    return _joined([HERE / "player.css", *paths])


def _joined(paths):
    return "\n".join(path.read_text(encoding="utf-8") for path in paths)
