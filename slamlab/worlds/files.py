"""World files: load, parse and save worlds as text, four numbers a wall, three a circle.

# x1 y1 x2 y2 [m]: a wall; x y radius [m]: a circle
-2 -1 3 -1
1.3 0.85 0.15
"""

from pathlib import Path

import numpy as np

from slamlab.worlds.world import World

HEADER = "# x1 y1 x2 y2 [m]: a wall; x y radius [m]: a circle\n"
MAX_SIZE = 50_000_000  # of a file [bytes]; a million walls take 40 MB


class WorldFileError(ValueError):
    """A world file that cannot be read or parsed; the text names file and line."""


def load(path):
    """Load a world from a text file; # begins a comment.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    World, named by the file

    Raises
    ------
    WorldFileError : the file cannot be read, or a line is neither wall nor circle
    """
    path = Path(path)
    return _parse_lines(_read_lines(path), str(path), path.stem)


def parse(text, name="world"):
    """Parse a world from text as a file would hold it.

    Parameters
    ----------
    text : str
    name : str, of the world; errors call its lines by it

    Returns
    -------
    World

    Raises
    ------
    WorldFileError : a line is neither wall nor circle
    """
    return _parse_lines(text.splitlines(), name, name)


def text_of(world):
    """Serialise a world as text, so that :func:`parse` gives the same one.

    Parameters
    ----------
    world : World

    Returns
    -------
    str
    """
    rows = [*world.walls.tolist(), *world.circles.tolist()]
    return HEADER + "".join(" ".join(f"{value!r}" for value in row) + "\n" for row in rows)


def save(world, path):
    """Save a world to a text file, so that :func:`load` gives the same one.

    Parameters
    ----------
    world : World
    path : str or Path

    Raises
    ------
    OSError
    """
    Path(path).write_text(text_of(world), encoding="utf-8")


def _parse_lines(lines, where, name):
    rows = {4: [], 3: []}
    for number, line in enumerate(lines, 1):
        words = line.split("#", 1)[0].replace(",", " ").split()
        if not words:
            continue
        if len(words) not in rows:
            raise WorldFileError(
                f"{where}:{number}: {len(words)} numbers; a wall has four (x1 y1 x2 y2), "
                "a circle three (x y radius)"
            )
        row = _parse_numbers(words, where, number)
        if len(row) == 4 and row[:2] == row[2:]:
            raise WorldFileError(f"{where}:{number}: the wall has no length: it starts at its end")
        if len(row) == 3 and row[2] <= 0:
            raise WorldFileError(f"{where}:{number}: a circle needs a radius above zero")
        rows[len(row)].append(row)
    if not any(rows.values()):
        raise WorldFileError(f"{where} holds no wall and no circle")
    return World(rows[4], rows[3], name)


def _read_lines(path):
    try:
        size = path.stat().st_size
        if size > MAX_SIZE:
            raise WorldFileError(f"{path} has {size >> 20} MB: no world is that large")
        return path.read_text(encoding="utf-8").splitlines()
    except OSError as error:
        raise WorldFileError(f"{path}: {error.strerror}") from None
    except UnicodeDecodeError:
        raise WorldFileError(f"{path} is no text file") from None


def _parse_numbers(words, where, number):
    try:
        row = [float(word) for word in words]
    except ValueError:
        bad = next(word for word in words if not _is_number(word))
        raise WorldFileError(f"{where}:{number}: {bad!r} is no number") from None
    if not np.isfinite(row).all():
        raise WorldFileError(f"{where}:{number}: a number is not finite")
    return row


def _is_number(word):
    try:
        float(word)
        return True
    except ValueError:
        return False
