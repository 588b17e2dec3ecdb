"""Page of a film: one HTML file with the film and its player."""

import base64
import html
from pathlib import Path
from string import Template

from slamlab.live.films.film_reader import check_header
from slamlab.live.player.script_bundle import FILM, script, styles

HERE = Path(__file__).parent
MARK = '<meta name="generator" content="slamlab film">'  # identifies a page made by page()


def page(path):
    """Create the page of a film; the page plays without a server.

    Raises
    ------
    SourceError : the file cannot be read
    FilmError : it is not a film

    path : str or Path. Returns HTML.
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
