"""Page of a film: one HTML file that holds the film and what plays it, and asks nobody for more."""

import base64
import html
from pathlib import Path
from string import Template

from slamlab.films.film_reader import check_header
from slamlab.views.player.library import FILM, script, styles

HERE = Path(__file__).parent
MARK = '<meta name="generator" content="slamlab film">'  # by which a page of ours is told


def page(path):
    """Make the page of a film; it plays from a file as well as from a server.

    Parameters
    ----------
    path : str or Path, of a film (:func:`slamlab.films.load` finds whether it is whole)

    Returns
    -------
    str, HTML

    Raises
    ------
    SourceError : it cannot be read
    FilmError : it is none
    """
    header = check_header(path)
    template = Template((HERE / "film_page.html").read_text(encoding="utf-8"))
    return template.substitute(
        mark=MARK,
        title=html.escape(str(header["title"])),
        alt=html.escape(str(header["alt"])),
        styles=styles(HERE / "film_page.css"),
        film=base64.b64encode(Path(path).read_bytes()).decode(),
        script=script(FILM, HERE / "film_page.js"),
    )
