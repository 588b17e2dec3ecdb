"""Handout: a lesson's slides as a PDF, with what was drawn on them, and with notes if wanted.

The browser prints the deck itself: text stays text, formulas and ink stay lines, figures are the
notebook's own. Nothing is run; what the file holds is shown.
"""

from slamlab.lecturing.shown_lesson import SCREEN, ink_of, shown


def write_handout(notebook, out, notes=False, screen=SCREEN):
    """Print a lesson's slides, each as its last stop shows it.

    Parameters
    ----------
    notebook : Path
    out : Path, of the PDF
    notes : bool, whether the speaker's notes stand below the slides (on upright pages, as
        many on each as fit)
    screen : (width, height) of the slides [pixels]

    Returns
    -------
    (int, list of str) : how many slides are printed; what could not be put on them

    Raises
    ------
    Unavailable : no browser, or no JupyterLab
    ShowError : it cannot be shown
    OSError : the PDF cannot be written
    """
    with shown(notebook, screen) as page:
        page.begin()
        made = page.ask("handout.js", "leaves", {"notes": notes})
        page.page.emulate_media(media="screen")
        out.write_bytes(page.page.pdf(print_background=True, prefer_css_page_size=True))
    ink, lost = ink_of(notebook).name, made["lost"]
    missing = [] if made["inkRead"] else [f"{ink} could not be read: nothing drawn is printed"]
    if lost:
        missing.append(f"{ink}: strokes not printed, as what they were drawn on is gone: {lost}")
    return made["leaves"], missing
