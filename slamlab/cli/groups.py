"""Command groups. Another distribution adds a list of :class:`Group` through an entry point."""

from dataclasses import dataclass
from importlib import import_module, metadata

ENTRY_POINTS = "slamlab.commands"


@dataclass(frozen=True)
class Group:
    """A group of commands in the help; each module has ``add_parser(subparsers)``."""

    title: str
    modules: tuple[str, ...]

    def add_parsers(self, subparsers):
        for module in self.modules:
            import_module(module).add_parser(subparsers)


OWN = tuple(
    Group(title, tuple(f"slamlab.cli.{name}" for name in names))
    for title, names in {
        "SLAM": ("run", "live", "film", "convert", "optimise"),
        "Devices": ("emulate", "record", "replay"),
        "Recordings": ("data",),
        "Shell": ("completion",),
    }.items()
)


def all_groups():
    """Return the command groups of the library and of other installed distributions."""
    points = sorted(metadata.entry_points(group=ENTRY_POINTS), key=lambda point: point.name)
    return [*OWN, *(group for point in points for group in point.load())]
