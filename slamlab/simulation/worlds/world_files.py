"""World files: text with four numbers per wall and three per circle; # starts a comment."""

from pathlib import Path

import numpy as np

from slamlab.simulation.worlds.world import World

HEADER = "# x1 y1 x2 y2 [m]: a wall; x y radius [m]: a circle\n"
MAX_SIZE = 50_000_000  # of a file [bytes]; a million walls take 40 MB


class WorldFileError(ValueError):
    """A world file cannot be read or parsed; the message contains the file and line."""


def load(path):
    """Load a World that is named after its file. Raises WorldFileError."""
    path = Path(path)
    return _parse_lines(_read_lines(path), str(path), path.stem)


def parse(text, name="world"):
    """Parse a World from text; error messages contain ``name``. Raises WorldFileError."""
    return _parse_lines(text.splitlines(), name, name)


def text_of(world):
    """Return the text of a World, from which :func:`parse` restores the World."""
    rows = [*world.walls.tolist(), *world.circles.tolist()]
    return HEADER + "".join(" ".join(f"{value!r}" for value in row) + "\n" for row in rows)


def save(world, path):
    """Save a World as text, from which :func:`load` restores the World."""
    Path(path).write_text(text_of(world), encoding="utf-8")


def _parse_lines(lines, where, name):
    rows = {4: [], 3: []}
    for number, line in enumerate(lines, 1):
        words = line.split("#", 1)[0].replace(",", " ").split()
        if not words:
            continue
        if len(words) not in rows:
            raise WorldFileError(
                f"{where}:{number}: the line has {len(words)} numbers. A wall has four "
                "numbers (x1 y1 x2 y2), and a circle has three (x y radius)"
            )
        row = _parse_numbers(words, where, number)
        if len(row) == 4 and row[:2] == row[2:]:
            raise WorldFileError(
                f"{where}:{number}: the wall has no length because start and end are equal"
            )
        if len(row) == 3 and row[2] <= 0:
            raise WorldFileError(f"{where}:{number}: the radius of a circle must be positive")
        rows[len(row)].append(row)
    if not any(rows.values()):
        raise WorldFileError(f"{where} contains neither a wall nor a circle")
    return World(rows[4], rows[3], name)


def _read_lines(path):
    try:
        size = path.stat().st_size
        if size > MAX_SIZE:
            raise WorldFileError(f"{path} has {size >> 20} MB; a world file must be smaller")
        return path.read_text(encoding="utf-8").splitlines()
    except OSError as error:
        raise WorldFileError(f"{path}: {error.strerror}") from None
    except UnicodeDecodeError:
        raise WorldFileError(f"{path} is not a text file") from None


def _parse_numbers(words, where, number):
    row = []
    for word in words:
        try:
            row.append(float(word))
        except ValueError:
            raise WorldFileError(f"{where}:{number}: {word!r} is not a number") from None
    if not np.isfinite(row).all():
        raise WorldFileError(f"{where}:{number}: a number is not finite")
    return row
