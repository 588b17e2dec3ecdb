"""Diagram of the components of the three packages and their imports (dependency graph).

A component is a module or subpackage directly below ``slamlab``, ``classroom`` or ``course``. The
course's own modules are one component, the builder. A component is drawn above the components that
it imports. Transitive arrows are omitted. One arrow between two packages represents all imports
between them. The descriptions come from the packages' docstrings. ``python -m course.architecture``
draws the diagram.
"""

import hashlib
import importlib
import re
import shutil
import subprocess
import sys
import textwrap
from functools import cache
from itertools import pairwise

from classroom.grading.import_closure import imported
from course.source import ROOT

PICTURE = ROOT / "docs" / "architecture.svg"
PACKAGES = ("slamlab", "classroom", "course")
COLOURS = {"slamlab": "#dbe9f6", "classroom": "#fdebd3", "course": "#e3f1dd"}
BUILDER = "course.builder"
TEXTS = ("course.lessons", "course.questions")  # no modules to import
PROGRAMS = ("notebook.py", "answers.py")  # of an exercise, read as texts
HEAD = """digraph components {
  graph [ranksep=0.4, nodesep=0.2, fontname="Helvetica", fontsize=16, bgcolor="white"]
  graph [compound=true, labeljust=l, color="#b0b0b0"]
  node [shape=box, style="rounded,filled", fontname="Helvetica", fontsize=11, margin="0.09,0.05"]
  edge [color="#6b6b6b", arrowsize=0.6]
"""


@cache
def descriptions():
    """Read the components' descriptions from the packages' docstrings, from the lowest layer up.

    Returns
    -------
    dict, dotted component to its description
    """
    return {
        f"{package}.{name}": words.replace("``", "")
        for package in PACKAGES
        for name, words in re.findall(
            r"^(\w+) {2,}(\S.*)$", importlib.import_module(package).__doc__, re.MULTILINE
        )
        if f"{package}.{name}" not in TEXTS
    }


def dotted(path):
    """Return the dotted name of a file's module or package."""
    path = path.parent if path.name == "__init__.py" else path.with_suffix("")
    return ".".join(path.relative_to(ROOT).parts)


def component_of(name):
    """Return the dotted component of a module, or None for a package's own ``__init__``."""
    package, *rest = name.split(".")
    if package not in PACKAGES or not rest or rest[0].startswith("_"):
        return None
    component = f"{package}.{rest[0]}"
    known = component in (*descriptions(), *TEXTS)
    return component if known or package != "course" else BUILDER


@cache
def modules():
    """List the modules of each component.

    Returns
    -------
    dict, dotted component to list of (dotted name, Path)
    """
    found = {}
    for package in PACKAGES:
        for path in sorted((ROOT / package).rglob("*.py")):
            component = component_of(dotted(path))
            of_exercise = component == "course.exercises" and path.name in PROGRAMS
            is_text = component in TEXTS or of_exercise
            if component and not is_text and path.stem.isidentifier():
                found.setdefault(component, []).append((dotted(path), path))
    return found


@cache
def uses():
    """Return for each component the set of components that it imports, including imports in
    functions."""
    return {
        component: {
            target
            for name, path in of_component
            for target in map(component_of, imported(path, name))
            if target in modules().keys() - {component}
        }
        for component, of_component in modules().items()
    }


@cache
def below(component):
    """Return the set of all components that a component depends on, directly or indirectly.

    Raises
    ------
    RecursionError : there is a cycle of imports
    """
    return frozenset(uses()[component]).union(*map(below, uses()[component]))


def arrows():
    """Return the transitive reduction of the imports: list of (upper component, lower
    component)."""
    return [
        (component, used)
        for component in sorted(uses())
        for used in sorted(uses()[component])
        if not any(used in below(other) for other in uses()[component])
    ]


def graph():
    """Return the diagram in DOT, the language of Graphviz."""
    lines = [HEAD]
    for package in PACKAGES:
        lines.append(f'  subgraph "cluster_{package}" {{ label="{package}"\n')
        for component, words in descriptions().items():
            if component.startswith(f"{package}."):
                text = "<br/>".join(textwrap.wrap(words.replace("&", "&amp;"), 28))
                name = f'<b><font point-size="14">{component.split(".")[1]}</font></b>'
                label = f'<{name}<br/>{text}>, fillcolor="{COLOURS[package]}"'
                lines.append(f'    "{component}" [label={label}]\n')
        lines.append("  }\n")
    inside = {pair for pair in arrows() if pair[0].split(".")[0] == pair[1].split(".")[0]}
    lines += [f'  "{upper}" -> "{lower}"\n' for upper, lower in sorted(inside)]
    for lower, upper in pairwise(PACKAGES):  # lowest component to highest: packages stack
        ends = f'"{_longest(inside, upper)[-1]}" -> "{_longest(inside, lower)[0]}"'
        style = f'ltail="cluster_{upper}", lhead="cluster_{lower}", penwidth=4, arrowsize=1.2'
        lines.append(f"  {ends} [{style}]\n")
    return "".join([*lines, "}\n"])


def _longest(pairs, package, component=None):
    """Return the longest chain of arrows within a package, or starting at a component."""
    begins = {upper for upper, _ in pairs if component is None and upper.startswith(f"{package}.")}
    begins = begins or {lower for upper, lower in pairs if upper == component}
    chains = [_longest(pairs, package, begin) for begin in sorted(begins)]
    return [*([component] if component else []), *max(chains, key=len, default=[])]


def mark():
    """Return the picture's comment line with a hash of the imports and descriptions."""
    return f"<!-- imports {hashlib.sha256(graph().encode()).hexdigest()[:16]} -->"


def main():
    """Draw the diagram."""
    if not shutil.which("dot"):
        sys.exit("Graphviz is missing: install it (command dot) to draw the diagram")
    drawn = subprocess.run(["dot", "-Tsvg"], input=graph(), capture_output=True, text=True)
    if drawn.returncode:
        sys.exit(drawn.stderr)
    title = "<title>Components of the packages; each is above those that it imports</title>"
    text = drawn.stdout.replace("<title>components</title>", title)
    PICTURE.write_text(f"{text.rstrip()}\n{mark()}\n", encoding="utf-8")
    print(f"{PICTURE.relative_to(ROOT)}: {len(descriptions())} components, {len(arrows())} arrows")


if __name__ == "__main__":
    main()
