"""Map YAML of the ROS map_server: reading and checking, as MapSettings."""

from difflib import get_close_matches
from math import isfinite
from typing import NamedTuple

import yaml

from slamlab.files import InputFile, SourceError
from slamlab.gridmap.occupancy_grid import FREE, OCCUPIED

MODES = "trinary", "scale", "raw"
BOOLEANS = {"0": False, "false": False, "no": False, "off": False, "n": False}
BOOLEANS |= {"1": True, "true": True, "yes": True, "on": True, "y": True}
MAX_SIZE = 1 << 16  # of a file [bytes]
ERRORS = yaml.YAMLError, RecursionError, ValueError, OverflowError  # what PyYAML raises


class MapSettings(NamedTuple):
    """Settings of a map; those that have a default are optional keys of the YAML file."""

    image: str
    resolution: float
    origin: list
    negate: bool = False
    occupied_thresh: float = OCCUPIED
    free_thresh: float = FREE
    mode: str = "trinary"


def read_settings(path):
    """Read the YAML file of a map. Raises a SourceError that names line and key."""
    nodes = _nodes(path)
    found = {key: _READERS[key](_Field(path, key, nodes[key])) for key in _READERS if key in nodes}
    missing = [key for key in ("image", "resolution", "origin") if key not in found]
    if missing:
        raise SourceError(f"{path} is not the YAML file of a map: the key {missing[0]} is missing")
    settings = MapSettings(**found)
    if settings.free_thresh > settings.occupied_thresh:
        raise SourceError(
            f"{path}: free_thresh {settings.free_thresh:g} must not be above occupied_thresh "
            f"{settings.occupied_thresh:g}"
        )
    if settings.mode == "raw" and settings.negate:
        raise SourceError(
            f"{path}: negate with mode raw differs between ROS 1 and ROS 2: negate the image, and "
            "write negate: 0"
        )
    return settings


def _nodes(path):
    """Return the top-level keys of a YAML file, and their nodes, which store line numbers."""
    content = InputFile(path).head()
    text = content.decode("utf-8", "replace").replace("\t", " ")
    where, root = path, None
    try:
        root = yaml.compose(text, Loader=yaml.SafeLoader) if len(text) <= MAX_SIZE else None
    except ERRORS as error:
        mark = getattr(error, "problem_mark", None)
        where = f"{path}, line {mark.line + 1}" if mark else path
    if not isinstance(root, yaml.MappingNode):
        raise SourceError(
            f"{where}: this is not the YAML file of a map (lines of key, colon and value); give "
            "the YAML file of the map, not its image"
        )
    found = {}
    for key, value in root.value:
        name, where = key.value, f"{path}, line {key.start_mark.line + 1}"
        if not isinstance(name, str):
            continue
        if name in found:
            raise SourceError(f"{where}: the key {name:.40} is repeated: remove one")
        near = name not in _READERS and get_close_matches(name[:40], _READERS, 1, 0.8)
        if near:
            raise SourceError(f"{where}: unknown key {name:.40}; did you mean {near[0]}?")
        found[name] = value
    return found


class _Field(NamedTuple):
    """The value of a key, with the path of the key for error messages."""

    path: object
    key: str
    node: yaml.Node

    def error(self, what):
        line = self.node.start_mark.line + 1
        return SourceError(f"{self.path}, line {line}: {self.key} {what}")

    def text(self):
        if not isinstance(self.node, yaml.ScalarNode) or not self.node.value:
            raise self.error("must be a single value")
        return self.node.value

    def number(self):
        text = self.text()
        try:
            number = float(text.replace("_", "?"))
        except ValueError:
            number = float("nan")
        if not isfinite(number):
            raise self.error(f"must be a finite number, not {text[:40]!r}")
        return number

    def share(self):
        number = self.number()
        if not 0 <= number <= 1:
            raise self.error(f"must be between 0 and 1, not {number:g} (not a percentage)")
        return number

    def origin(self):
        if not isinstance(self.node, yaml.SequenceNode) or len(self.node.value) != 3:
            raise self.error("must be a list of x, y and yaw, such as [0, 0, 0]")
        return [self._replace(node=node).number() for node in self.node.value]

    def choice(self, choices):
        text = self.text()
        if text not in choices:
            raise self.error(f"must be one of {', '.join(choices)}, not {text[:40]!r}")
        return text

    def boolean(self):
        text = self.text().lower()
        if text not in BOOLEANS:
            raise self.error(f"must be 0 or 1, not {text[:40]!r}")
        return BOOLEANS[text]


_READERS = {
    "image": _Field.text,
    "resolution": _Field.number,
    "origin": _Field.origin,
    "negate": _Field.boolean,
    "occupied_thresh": _Field.share,
    "free_thresh": _Field.share,
    "mode": lambda field: field.choice(MODES),
}
