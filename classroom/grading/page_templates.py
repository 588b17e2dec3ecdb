"""Templates of HTML pages, which escape the texts that they show."""

from slamlab.extras import needs

with needs("grading", "slam-course"):
    import jinja2


def templates(folder):
    """Return the templates in a folder; an undefined name in a template is an error."""
    return jinja2.Environment(
        loader=jinja2.FileSystemLoader(folder),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
