"""JavaScript and styles of the widgets: shared files and each widget's own, joined to one."""

from pathlib import Path

# a widget's script is one piece; for readers it is several
SHARED = ("page.js", "plane.js", "panels.js", "drawing.js")


def script(path):
    """JavaScript module of a widget, with the shared files in front.

    Parameters
    ----------
    path : Path of the piece that exports the widget

    Returns
    -------
    str
    """
    pieces = [*map(Path(__file__).with_name, SHARED), path]
    return "\n".join(piece.read_text(encoding="utf-8") for piece in pieces)


def styles(*paths):
    """Styles of a widget, with the shared ones in front.

    Parameters
    ----------
    paths : Path of each style sheet of the widget's own

    Returns
    -------
    str
    """
    sheets = [Path(__file__).with_name("widgets.css"), *paths]
    return "\n".join(sheet.read_text(encoding="utf-8") for sheet in sheets)
