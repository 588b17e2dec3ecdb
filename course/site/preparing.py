"""Prepare the pages of the site: a folder of notebooks and Markdown that Sphinx can set."""

import importlib
import os
import re
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import nbformat

from course.pack import without_notes
from course.site import formula_index, gathered, rendering, start_film
from course.site.moving_outputs import films_alone
from course.site.pages_of_notebooks import page, without_links
from course.source import KINDS, ROOT, file_name, sources
from slamlab.views.player import library

HERE = Path(__file__).parent
GUIDES = ("live", "robots", "lecturing", "grading", "contest", "architecture")
FOLDERS = {"lessons": "notebooks", "exercises": "exercises"}
_INTO_PROJECT = re.compile(r"(?<!!)\[([^\]]+)\]\(\.\./[^)]*\)")  # a link to a file of the project


def prepare(folder, cache, lessons_rendered=None, whole=True):
    """Write all pages into a folder; what is as it was stays untouched, what is gone goes.

    Parameters
    ----------
    folder : Path
    cache : Path, what was rendered before
    lessons_rendered : collection of str or None, numbers of the lessons whose films and sliders are
        wanted; None for all
    whole : bool, False for the lessons alone, as the students' pack has them

    Returns
    -------
    list of str, which lessons could not be rendered, and why: they keep their still pictures
    """
    with ThreadPoolExecutor(1) as beside:  # it takes as long as a lesson's films
        film = beside.submit(start_film.files, cache)
        moving, failed = _moving(cache, lessons_rendered, whole)
    files = {"index.md": _start("index" if whole else "pack")} | film.result()
    files |= {f"_static/{path.name}": path.read_bytes() for path in (HERE / "static").iterdir()}
    player = library.script(library.FILM, HERE / "static" / "films_on_page.js")
    files["_static/films_on_page.js"] = player.encode()
    files["_static/player.css"] = library.styles().encode()
    files |= _notebooks("lessons", moving, whole)
    if whole:
        files |= _notebooks("exercises", {}, whole) | _guides() | _modules()
        files["formulas.md"] = formula_index.page()
        files |= {f"{kind}.md": gathered.page(kind, _lessons_shown()) for kind in gathered.HEADS}
    _synchronise(folder, files)
    return failed


def lessons():
    """Number of a lesson to the name of its notebook without suffix.

    Returns
    -------
    dict
    """
    paths = [path for path in sources() if path.parent.name == "lessons"]
    return {path.stem[:2]: Path(file_name(path)).stem for path in paths}


def _start(page_name):
    """The first page, with the lists of all others."""
    names = {kind: [] for kind in KINDS}
    for path in sources():
        kind = path.parent.name
        names[kind].append(f"{FOLDERS[kind]}/{Path(file_name(path)).stem}")
    names["guides"] = [f"guides/{name}" for name in GUIDES]
    text = (HERE / "pages" / f"{page_name}.md").read_text(encoding="utf-8")
    text = text.replace("{{film}}", start_film.PLACE)
    for kind, listed in names.items():
        text = text.replace(f"{{{{{kind}}}}}", "\n".join(listed))
    return text


def _moving(cache, wanted, whole):
    """What was rendered of each notebook (its stem to told and folder), and what could not be."""
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
    return "views.live(" in (ROOT / "notebooks" / f"{name}.ipynb").read_text(encoding="utf-8")


def _notebooks(kind, moving, whole):
    """The pages of all lessons, or of all exercises as they are handed out."""
    files, known = {}, lessons()
    for path in sources():
        if path.parent.name == kind:
            name = f"{FOLDERS[kind]}/{file_name(path)}"
            notebook = nbformat.read(ROOT / name, as_version=4)
            told, made = moving.get(Path(name).stem, ({}, None))
            if not whole:
                told = films_alone(told)
            shown = page(notebook, known, told, made.name if made else "")
            if told:
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
    """Each lesson's title, the name of its page, and what the site shows of it."""
    found, known = [], lessons()
    for stem in known.values():
        name = f"notebooks/{stem}.ipynb"
        shown = page(nbformat.read(ROOT / name, as_version=4), known)
        found.append((re.match(r"# (.+)", shown.cells[0].source)[1], name, shown))
    return found


def _ways_to_run(name, whole):
    """The line that leads from a page to the notebook itself."""
    lab = f'<a href="http://localhost:8888/lab/tree/{name}">'
    if not whole:
        return f"This is `{name}`: {lab}open it in your JupyterLab</a>, where `python lab.py` runs"
    return (
        f'<a href="../_static/{name}" download>Download this notebook</a> · '
        f"{lab}open it in your JupyterLab</a>, where `make lab` runs"
    )


def _guides():
    """The guides as pages: links among them stay, links into the project's files become names."""
    files = {}
    for name in GUIDES:
        text = (ROOT / "docs" / f"{name}.md").read_text(encoding="utf-8")
        files[f"guides/{name}.md"] = _INTO_PROJECT.sub(r"\1", text)
        for picture in re.findall(r"\]\((\w+\.(?:png|svg))\)", text):
            files[f"guides/{picture}"] = (ROOT / "docs" / picture).read_bytes()
    return files


def _modules():
    """A page for each room of the package, with what it offers at its door."""
    rooms = sorted(
        path.stem if path.suffix else path.name
        for path in (ROOT / "slamlab").iterdir()
        if not path.name.startswith("_")
        and (path.suffix == ".py" or (path / "__init__.py").exists())
    )
    files = {
        f"api/{room}.md": f"# slamlab.{room}\n\n```{{eval-rst}}\n.. automodule:: slamlab.{room}\n"
        f"   :members:\n   :exclude-members: {', '.join(_of_others(room, rooms))}\n```\n"
        for room in rooms
    }
    listed = "\n".join(rooms)
    files["api/index.md"] = (
        "# The package\n\nEvery room of `slamlab`, with what it offers at its door. Equations, shapes, "
        f"units and errors stand with each function.\n\n```{{toctree}}\n:maxdepth: 1\n\n{listed}\n```\n"
    )
    return files


def _of_others(room, rooms):
    """What a room offers that another room does, too: it is described there, once."""
    module = importlib.import_module(f"slamlab.{room}")
    defined = {
        name: getattr(getattr(module, name), "__module__", None) or ""
        for name in getattr(module, "__all__", ())
    }
    return sorted(
        name
        for name, place in defined.items()
        if place.removeprefix("slamlab.") in set(rooms) - {room}
    )


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
