"""Prepare the pages of the site: a folder of notebooks and Markdown that Sphinx can set."""

import re
from pathlib import Path

import nbformat

from course.site import formula_index
from course.site.pages_of_notebooks import page
from course.source import KINDS, ROOT, file_name, sources

HERE = Path(__file__).parent
GUIDES = ("live", "robots", "lecturing", "grading", "architecture")
FOLDERS = {"lessons": "notebooks", "exercises": "exercises"}
_INTO_PROJECT = re.compile(r"(?<!!)\[([^\]]+)\]\(\.\./[^)]*\)")  # a link to a file of the project


def prepare(folder):
    """Write all pages into a folder; what is as it was stays untouched, what is gone goes.

    Parameters
    ----------
    folder : Path
    """
    files = {"index.md": _start()}
    files |= {f"_static/{path.name}": path.read_bytes() for path in (HERE / "static").iterdir()}
    for kind in KINDS:
        files |= _notebooks(kind)
    files |= _guides()
    files["formulas.md"] = formula_index.page()
    files |= _modules()
    _synchronise(folder, files)


def lessons():
    """Number of a lesson to the name of its notebook without suffix.

    Returns
    -------
    dict
    """
    paths = [path for path in sources() if path.parent.name == "lessons"]
    return {path.stem[:2]: Path(file_name(path)).stem for path in paths}


def _start():
    """The first page, with the lists of all others."""
    names = {kind: [] for kind in KINDS}
    for path in sources():
        kind = path.parent.name
        names[kind].append(f"{FOLDERS[kind]}/{Path(file_name(path)).stem}")
    names["guides"] = [f"guides/{name}" for name in GUIDES]
    text = (HERE / "pages" / "index.md").read_text(encoding="utf-8")
    for kind, listed in names.items():
        text = text.replace(f"{{{{{kind}}}}}", "\n".join(listed))
    return text


def _notebooks(kind):
    """The pages of all lessons, or of all exercises as they are handed out."""
    files, known = {}, lessons()
    for path in sources():
        if path.parent.name == kind:
            name = f"{FOLDERS[kind]}/{file_name(path)}"
            notebook = nbformat.read(ROOT / name, as_version=4)
            shown = page(notebook, known)
            shown.cells[0].source += "\n\n" + _ways_to_run(name)
            files[name] = nbformat.writes(shown)
            files[f"_static/{name}"] = (ROOT / name).read_bytes()
    return files


def _ways_to_run(name):
    """The line that leads from a page to the notebook itself."""
    lab = f"http://localhost:8888/lab/tree/{name}"
    return (
        f'<a href="../_static/{name}" download>Download this notebook</a> · '
        f'<a href="{lab}">open it in your JupyterLab</a>, where `make lab` runs'
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
        "   :members:\n```\n"
        for room in rooms
    }
    listed = "\n".join(rooms)
    files["api/index.md"] = (
        "# The package\n\nEvery room of `slamlab`, with what it offers at its door. Equations, shapes, "
        f"units and errors stand with each function.\n\n```{{toctree}}\n:maxdepth: 1\n\n{listed}\n```\n"
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
