"""Build the site: pages are prepared in a folder of their own, then set by Sphinx."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

from course.site import preparing
from course.source import ROOT

HERE = Path(__file__).parent
WORK = ROOT / ".site"  # what the next build takes over: formulas, pages that did not change
_LEVEL = 'role="heading" aria-level="2"'


class SiteError(Exception):
    """The site cannot be built; the text says why and what to do."""


def build(out, work=WORK, rendered=None, whole=True):
    """Build the site from what notebooks store; only what moves is run, and kept for the next time.

    Parameters
    ----------
    out : Path, folder to be written; what stood there goes
    work : Path, folder for what the next build takes over: formulas, pages read, films
    rendered : collection of str or None, numbers of the lessons whose films and sliders are wanted
    whole : bool, False for the lessons alone, as the students' pack has them

    Returns
    -------
    list of str, which lessons could not be rendered, and why

    Raises
    ------
    SiteError : no KaTeX, or Sphinx warns of something
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
            *("-b", "html", "-c", str(HERE), "-d", str(place / "doctrees")),
            *("-D", f"katex_modules={modules}", "-D", f"html_static_path={source / '_static'}"),
            *(str(source), str(html)),
        ],
        cwd=ROOT,
    )
    if done.returncode:
        raise SiteError("Sphinx has something to say: see above")
    _mend_lists(html)
    shutil.rmtree(out, ignore_errors=True)
    shutil.copytree(html, out, ignore=shutil.ignore_patterns(".buildinfo*", "objects.inv"))
    (out / ".nojekyll").touch()  # GitHub Pages leaves folders with _ away otherwise
    return failed


def _mend_lists(folder):
    """Mend what screen readers stumble over: captions without a level, lists right within lists."""
    for path in folder.rglob("*.html"):
        text = path.read_text(encoding="utf-8")
        mended = text.replace('class="caption" role="heading"', f'class="caption" {_LEVEL}')
        mended = re.sub(r"</li>\s*<ul>|</ul>(?=\s*(?:<li>|</ul>))", "", mended)
        path.write_text(mended, encoding="utf-8")


def katex_modules(work):
    """The folder of npm's modules with KaTeX in it, as the lock file has it; fetched where missing.

    Parameters
    ----------
    work : Path

    Returns
    -------
    Path

    Raises
    ------
    SiteError : no Node.js, or KaTeX cannot be fetched
    """
    place, lock = work / "node", (HERE / "package-lock.json").read_text(encoding="utf-8")
    modules = place / "node_modules"
    fetched = place / "package-lock.json"
    if modules.exists() and fetched.exists() and fetched.read_text(encoding="utf-8") == lock:
        return modules
    npm = shutil.which("npm")
    if not npm:
        raise SiteError("formulas are set by KaTeX, which needs Node.js: install nodejs and npm")
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
        raise SiteError(f"KaTeX could not be fetched by npm:\n{done.stderr[-1000:]}")
    return modules


def _ship_katex(modules, folder):
    """Copy what pages need of KaTeX: its style sheet and its fonts in the format of today."""
    dist = modules / "katex" / "dist"
    (folder / "fonts").mkdir(parents=True, exist_ok=True)
    shutil.copy(dist / "katex.min.css", folder)
    for font in (dist / "fonts").glob("*.woff2"):
        shutil.copy(font, folder / "fonts")
