"""HTML pages of the students' pack: lessons and films, for a browser without an installation."""

import tempfile
from pathlib import Path

from course.site import building, site_checks

FOLDER = "pages"  # of the pack
_FIRST = """\
<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta http-equiv="refresh" content="0; url={0}/index.html">
<title>An executable SLAM course</title>
<p><a href="{0}/index.html">The lessons as pages</a></p>
</html>
"""


def pages(work=building.WORK, rendered=None):
    """Build the pages of the pack.

    Parameters
    ----------
    work, rendered : see :func:`course.site.building.build`

    Returns
    -------
    dict, name in the pack to bytes; start at index.html

    Raises
    ------
    course.site.building.SiteError : they cannot be built, or have faults
    """
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / FOLDER
        wrong = building.build(out, work, rendered, whole=False) + site_checks.problems(out)
        if wrong:
            raise building.SiteError("\n".join(wrong))
        files = {
            path.relative_to(folder).as_posix(): path.read_bytes()
            for path in sorted(out.rglob("*"))
            if path.is_file()
        }
    return {"index.html": _FIRST.format(FOLDER).encode()} | files
