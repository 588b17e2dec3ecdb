"""``python -m course.architecture``: the picture of the package's rooms, from the code's imports.

A room is a package or module right below ``slamlab``. It stands above all that it imports; an arrow
that follows from others is left out. The words are those of ``help(slamlab)``. Graphviz draws.
"""

import hashlib
import re
import shutil
import subprocess
import sys
import textwrap
from functools import cache

import slamlab
from course.source import ROOT
from slamlab.grading.import_closure import imported

PICTURE = ROOT / "docs" / "architecture.svg"
COLOURS = {"slam": "#dbe9f6", "course": "#fdebd3"}
HEAD = """digraph slamlab {
  graph [ranksep=0.45, nodesep=0.22, fontname="Helvetica", bgcolor="white"]
  node [shape=box, style="rounded,filled", fontname="Helvetica", fontsize=11, margin="0.09,0.05"]
  edge [color="#6b6b6b", arrowsize=0.6]
"""


def told():
    """What ``help(slamlab)`` says of the rooms.

    Returns
    -------
    dict, room to (its words, "slam" or "course")
    """
    slam, _, course = slamlab.__doc__.partition("The course's own machinery")
    return {
        name: (words.replace("``", ""), kind)
        for kind, text in (("slam", slam), ("course", course))
        for name, words in re.findall(r"^(\w+) {2,}(\S.*)$", text, re.MULTILINE)
    }


def dotted(path):
    """The dotted name of the module or package that a file holds."""
    path = path.parent if path.name == "__init__.py" else path.with_suffix("")
    return ".".join(path.relative_to(ROOT).parts)


def modules():
    """Every room's modules.

    Returns
    -------
    dict, room to list of (dotted name, Path)
    """
    found = {}
    for path in sorted((ROOT / "slamlab").rglob("*.py")):
        _, *room = dotted(path).split(".")[:2]
        if room and not room[0].startswith("_"):
            found.setdefault(room[0], []).append((dotted(path), path))
    return found


@cache
def uses():
    """Which rooms each room imports, imports inside functions included: dict of room to set."""
    rooms = modules()
    return {
        room: {
            target.split(".")[1]
            for name, path in of_room
            for target in imported(path, name)
            if target.startswith("slamlab.") and target.split(".")[1] in rooms.keys() - {room}
        }
        for room, of_room in rooms.items()
    }


@cache
def below(room):
    """All rooms that a room stands on: a set.

    Raises
    ------
    RecursionError : rooms import each other in a circle
    """
    return frozenset(uses()[room]).union(*map(below, uses()[room]))


def arrows():
    """The imports that follow from no others: list of (upper room, lower room)."""
    return [
        (room, used)
        for room in sorted(uses())
        for used in sorted(uses()[room])
        if not any(used in below(other) for other in uses()[room])
    ]


def graph():
    """The picture in Graphviz' language."""
    lines = [HEAD]
    for room, (words, kind) in told().items():
        text = "<br/>".join(textwrap.wrap(words, 28))
        label = f'<<b><font point-size="14">{room}</font></b><br/>{text}>'
        lines.append(f'  {room} [label={label}, fillcolor="{COLOURS[kind]}"]\n')
    lines += [f"  {upper} -> {lower}\n" for upper, lower in arrows()]
    return "".join([*lines, "}\n"])


def mark():
    """The line in the picture that tells of which imports and words of the help it was made."""
    return f"<!-- imports {hashlib.sha256(graph().encode()).hexdigest()[:16]} -->"


def main():
    """Draw."""
    if not shutil.which("dot"):
        sys.exit("Graphviz draws this picture: install it (its command is called dot)")
    drawn = subprocess.run(["dot", "-Tsvg"], input=graph(), capture_output=True, text=True)
    if drawn.returncode:
        sys.exit(drawn.stderr)
    title = "<title>Rooms of slamlab; each stands above those it imports</title>"
    text = drawn.stdout.replace("<title>slamlab</title>", title)
    PICTURE.write_text(f"{text.rstrip()}\n{mark()}\n", encoding="utf-8")
    print(f"{PICTURE.relative_to(ROOT)}: {len(told())} rooms, {len(arrows())} arrows")


if __name__ == "__main__":
    main()
