"""Handout: a lesson's slides as a PDF, including the ink drawn on them.

The browser prints the slides without running any cells."""

from classroom.lecturing.lesson_page import SCREEN, ink_of, open_lesson

# the headings become bookmarks
OPTIONS = {"print_background": True, "prefer_css_page_size": True, "outline": True, "tagged": True}


def write_handout(notebook, out, notes=False, screen=SCREEN):
    """Print a lesson's slides; return (slides, pages of slides) and messages about missing ink.

    notes : whether to print notes below the slides. screen : (width, height) [pixels]. Raises
    Unavailable, LessonError, OSError."""
    with open_lesson(notebook, screen) as page:
        page.start()
        made = page.call("handout.js", "leaves", {"notes": notes})
        page.page.emulate_media(media="screen")
        out.write_bytes(page.page.pdf(**OPTIONS))
    ink, lost = ink_of(notebook).name, made["lost"]
    missing = [] if made["inkRead"] else [f"{ink} could not be read. The handout contains no ink"]
    if lost:
        missing.append(
            f"{ink}: {lost} strokes are not printed, because the content below them is missing"
        )
    return (made["slides"], made["leaves"]), missing
