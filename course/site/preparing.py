"""Prepare the pages of the site: a folder of notebooks and Markdown for Sphinx."""

import os
import re
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import nbformat

from course import literature
from course.lecturer_cells import without_notes
from course.site import formula_index, front_page_film, public_names, rendering
from course.site.notebook_pages import page, without_links
from course.site.rendered_outputs import films_alone
from course.source import KINDS, ROOT, file_name, kind_folder, sources
from slamlab.live.player import script_bundle

HERE = Path(__file__).parent
GUIDES = (
    *("lessons", "your_flat", "library", "command_line", "live", "robots"),
    *("data", "server", "lecturing", "topics", "grading", "contest", "architecture", "terms"),
)
FOLDERS = {"lessons": "notebooks", "exercises": "exercises", "appendices": "notebooks"}
# a link to a file of the project that is no page of the site
_INTO_PROJECT = re.compile(r"(?<!!)\[([^\]]+)\]\(\.\./(?!notebooks/|exercises/)[^)]*\)")


def prepare(folder, cache, lessons_rendered=None, whole=True):
    """Write all pages into a folder; keep unchanged files and delete obsolete files.

    Parameters
    ----------
    folder : Path
    cache : Path, earlier renderings
    lessons_rendered : collection of str or None, numbers of the lessons whose films and sliders are
        rendered; None for all
    whole : bool, False for the lessons alone, as the students' pack has them

    Returns
    -------
    list of str, lessons that could not be rendered, with the reason; they keep their still pictures
    """
    with ThreadPoolExecutor(1) as beside:  # it takes as long as the films of a lesson
        film = beside.submit(front_page_film.files, cache)
        moving, failed = _moving(cache, lessons_rendered, whole)
    files = {"index.md": _start("index" if whole else "pack")} | film.result()
    files |= {f"_static/{path.name}": path.read_bytes() for path in (HERE / "static").iterdir()}
    player = script_bundle.script(script_bundle.FILM, HERE / "static" / "films_on_page.js")
    files["_static/films_on_page.js"] = player.encode()
    files["_static/player.css"] = script_bundle.styles().encode()
    files |= _notebooks("lessons", moving, whole) | _notebooks("appendices", {}, whole)
    if whole:
        files |= _notebooks("exercises", {}, whole) | _guides() | _modules()
        files["formulas.md"] = formula_index.page()
        files["literature.md"] = literature.page(_lessons_shown())
    _synchronise(folder, files)
    return failed


def lessons():
    """Map the number of each lesson to the name of its notebook without suffix.

    Returns
    -------
    dict
    """
    paths = sources(folder="lessons")
    return {path.stem[:2]: Path(file_name(path)).stem for path in paths}


def _start(page_name):
    """Return the first page, with the lists of all other pages."""
    names = {kind: [] for kind in KINDS}
    for path in sources():
        kind = kind_folder(path).name
        names[kind].append(f"{FOLDERS[kind]}/{Path(file_name(path)).stem}")
    names["guides"] = [f"guides/{name}" for name in GUIDES]
    text = (HERE / "pages" / f"{page_name}.md").read_text(encoding="utf-8")
    text = text.replace("{{film}}", front_page_film.PLACE)
    for kind, listed in names.items():
        text = text.replace(f"{{{{{kind}}}}}", "\n".join(listed))
    return text


def _moving(cache, wanted, whole):
    """Return the renderings of each notebook by its stem, and the error messages of failures."""
    names = [stem for number, stem in lessons().items() if wanted is None or number in wanted]
    if not whole:  # pictures of sliders would double the pack
        names = [name for name in names if _has_film(name)]

    def render(name):
        try:
            return rendering.rendered(ROOT / "notebooks" / f"{name}.ipynb", cache)
        except rendering.RenderingError as error:
            return str(error)

    with ThreadPoolExecutor(os.cpu_count()) as threads:  # each waits for a process
        found = dict(zip(names, threads.map(render, names), strict=True))
    failed = [each for each in found.values() if isinstance(each, str)]
    return {name: each for name, each in found.items() if not isinstance(each, str)}, failed


def _has_film(name):
    return "live.watch(" in (ROOT / "notebooks" / f"{name}.ipynb").read_text(encoding="utf-8")


def _notebooks(kind, moving, whole):
    """Return the pages of all lessons, or of all exercises without solutions."""
    files, known = {}, lessons()
    for path in sources():
        if kind_folder(path).name == kind:
            name = f"{FOLDERS[kind]}/{file_name(path)}"
            notebook = nbformat.read(ROOT / name, as_version=4)
            rendered, made = moving.get(Path(name).stem, ({}, None))
            if not whole:
                rendered = films_alone(rendered)
            shown = page(notebook, known, rendered, made.name if made else "")
            if rendered:
                for file in made.iterdir():
                    if file.suffix in (".webp", ".js") if whole else file.suffix == ".js":
                        files[f"_static/rendered/{made.name}/{file.name}"] = file.read_bytes()
            if whole:
                files[f"_static/{name}"] = without_notes((ROOT / name).read_bytes())
            else:
                without_links(shown)
            shown.cells[0].source += "\n\n" + _ways_to_run(name, whole)
            files[name] = nbformat.writes(shown)
    return files


def _lessons_shown():
    """Return each lesson's title, the name of its page, and the notebook that the site shows."""
    found, known = [], lessons()
    for stem in known.values():
        name = f"notebooks/{stem}.ipynb"
        shown = page(nbformat.read(ROOT / name, as_version=4), known)
        found.append((re.match(r"# (.+)", shown.cells[0].source)[1], name, shown))
    return found


def _ways_to_run(name, whole):
    """Return the line that links a page to its notebook."""
    lab = f'<a href="http://localhost:8888/lab/tree/{name}">'
    if not whole:
        return f"This is `{name}`. {lab}Open it in your JupyterLab</a> (started by `python lab.py`)"
    return (
        f'<a href="../_static/{name}" download>Download this notebook</a> · '
        f"{lab}Open it in your JupyterLab</a> (started by `make lab`)"
    )


def _guides():
    """Return the guides as pages; links to files that are not pages become plain text."""
    files = {}
    for name in GUIDES:
        text = (ROOT / "docs" / f"{name}.md").read_text(encoding="utf-8")
        files[f"guides/{name}.md"] = _INTO_PROJECT.sub(r"\1", text)
        for picture in re.findall(r"\]\((\w+\.(?:png|svg))\)", text):
            files[f"guides/{picture}"] = (ROOT / "docs" / picture).read_bytes()
    return files


def _modules():
    """Return a page for each component of the library, with its public names."""
    files = {}
    for component, modules in public_names.by_component().items():
        parts = [f"# slamlab.{component}\n"]
        for module, names in modules.items():
            directive = f".. automodule:: {module}\n   :members: {', '.join(names)}\n"
            parts.append(f"```{{eval-rst}}\n{directive}```\n")
        files[f"api/{component}.md"] = "\n".join(parts)
    listed = "\n".join(public_names.by_component())
    files["api/index.md"] = (
        "# The library\n\nThese pages document the public names of `slamlab`, by component in the order of the "
        "data flow, with equations, shapes, units and errors. [The guide to the "
        f"library](../guides/library.md) has examples.\n\n```{{toctree}}\n:maxdepth: 1\n\n{listed}\n```\n"
    )
    return files


def _synchronise(folder, files):
    for name, content in files.items():
        path = folder / name
        data = content if isinstance(content, bytes) else content.encode()
        if not path.exists() or path.read_bytes() != data:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
    for path in folder.rglob("*"):
        name = path.relative_to(folder).as_posix()
        if path.is_file() and name not in files and not name.startswith("_static/katex/"):
            path.unlink()
