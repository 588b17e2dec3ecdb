"""Build the site: prepare the pages in a folder, then run Sphinx on it."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

from course.site import preparing
from course.source import ROOT

HERE = Path(__file__).parent
WORK = ROOT / ".site"  # cache for the next build: formulas, unchanged pages
_MARKUP = {  # what confuses screen readers: headings without a level, landmarks without a name
    'class="caption" role="heading"': 'class="caption" role="heading" aria-level="2"',
    '<aside class="sidebar-drawer"': '<aside aria-label="Pages" class="sidebar-drawer"',
    '<aside class="toc-drawer': '<aside aria-label="On this page" class="toc-drawer',
}


class SiteError(Exception):
    """The site cannot be built; the message states why and what to do."""


def build(out, work=WORK, rendered=None, whole=True):
    """Build the site from the stored notebooks; only films and sliders are rendered and cached.

    Parameters
    ----------
    out : Path, folder to write; its old contents are deleted
    work : Path, cache for the next build: formulas, parsed pages, films
    rendered : collection of str or None, numbers of the lessons whose films and sliders are
        rendered; None for all
    whole : bool, False for the lessons alone, as the students' pack has them

    Returns
    -------
    list of str, lessons that could not be rendered, with the reason

    Raises
    ------
    SiteError : KaTeX is missing, or Sphinx reports a warning
    """
    modules = katex_modules(work)
    place = work / ("site" if whole else "pack")
    source, html = place / "source", place / "html"
    failed = preparing.prepare(source, work / "rendered", rendered, whole)
    _ship_katex(modules, source / "_static" / "katex")
    shutil.rmtree(html, ignore_errors=True)  # pages whose source is gone would stay
    done = subprocess.run(
        [
            *(sys.executable, "-m", "sphinx", "--quiet", "--fail-on-warning", "--keep-going"),
            *("-j", "auto", "-b", "html", "-c", str(HERE), "-d", str(place / "doctrees")),
            *("-D", f"katex_modules={modules}", "-D", f"html_static_path={source / '_static'}"),
            *(str(source), str(html)),
        ],
        cwd=ROOT,
    )
    if done.returncode:
        raise SiteError("Sphinx reported warnings or errors; they are printed above")
    _correct_markup(html)
    shutil.rmtree(out, ignore_errors=True)
    shutil.copytree(html, out, ignore=shutil.ignore_patterns(".buildinfo*", "objects.inv"))
    (out / ".nojekyll").touch()  # GitHub Pages leaves folders with _ away otherwise
    return failed


def _correct_markup(folder):
    """Correct markup that confuses screen readers: see ``_MARKUP``; and nested lists."""
    for path in folder.rglob("*.html"):
        text = path.read_text(encoding="utf-8")
        for found, corrected in _MARKUP.items():
            text = text.replace(found, corrected)
        text = re.sub(r"</li>\s*<ul>|</ul>(?=\s*(?:<li>|</ul>))", "", text)
        path.write_text(text, encoding="utf-8")


def katex_modules(work):
    """Return the folder of npm modules with the locked KaTeX; download it if it is missing.

    Parameters
    ----------
    work : Path

    Returns
    -------
    Path

    Raises
    ------
    SiteError : Node.js is missing, or KaTeX cannot be downloaded
    """
    place, lock = work / "node", (HERE / "package-lock.json").read_text(encoding="utf-8")
    modules = place / "node_modules"
    fetched = place / "package-lock.json"
    if modules.exists() and fetched.exists() and fetched.read_text(encoding="utf-8") == lock:
        return modules
    npm = shutil.which("npm")
    if not npm:
        raise SiteError("KaTeX, which sets the formulas, needs Node.js: install nodejs and npm")
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    for name in ("package.json", "package-lock.json"):
        shutil.copy(HERE / name, place)
    done = subprocess.run(
        [npm, "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--fetch-retries=1"],
        cwd=place,
        capture_output=True,
        text=True,
    )
    if done.returncode:
        shutil.rmtree(place)
        raise SiteError(f"npm could not download KaTeX:\n{done.stderr[-1000:]}")
    return modules


def _ship_katex(modules, folder):
    """Copy the style sheet and fonts (WOFF2) of KaTeX into the folder of the pages."""
    dist = modules / "katex" / "dist"
    (folder / "fonts").mkdir(parents=True, exist_ok=True)
    shutil.copy(dist / "katex.min.css", folder)
    for font in (dist / "fonts").glob("*.woff2"):
        shutil.copy(font, folder / "fonts")
