"""Pose-graph files in g2o format, ``.g2o`` text (Kümmerle et al. 2011): load and save.

``VERTEX_SE2 id x y θ``, ``EDGE_SE2 i j x y θ`` with the upper triangle of the information row by
row (6 numbers), ``FIX id …``; metres and radians. The information is that of the residual, as in
``PoseGraph``. Which edge is robust the format cannot say.
"""

from pathlib import Path

import numpy as np

from slamlab.files.errors import SourceError
from slamlab.files.text_files import lines, read_bytes, reason
from slamlab.posegraph.pose_graph import PoseGraph

UPPER_TRIANGLE = np.triu_indices(3)  # of an information matrix, row by row
FIELD_COUNTS = {"VERTEX_SE2": 4, "EDGE_SE2": 11}  # numbers on a line, behind the keyword


def save(graph, path):
    """Save a pose graph to a .g2o file; numbers come back exactly as they are.

    Parameters
    ----------
    graph : PoseGraph
    path : str or Path

    Raises
    ------
    SourceError : the file cannot be written
    """
    rows = [("VERTEX_SE2", i, *pose) for i, pose in enumerate(graph.poses.tolist())]
    rows += [("FIX", i) for i in sorted(graph.fixed)]
    for edge in graph.edges:
        upper = edge.information[UPPER_TRIANGLE].tolist()
        rows.append(("EDGE_SE2", edge.i, edge.j, *edge.measured.tolist(), *upper))
    text = "".join(" ".join(map(str, row)) + "\n" for row in rows)
    try:
        Path(path).write_text(text, encoding="ascii")
    except OSError as error:
        raise SourceError(f"{path} cannot be written: {reason(error)}") from None


def load(path, robust_loops=False):
    """Load a pose graph from a .g2o file, plain or gzip.

    Poses are numbered 0, 1, 2 … in the order of their ids. Without a ``FIX`` the first is fixed.

    Parameters
    ----------
    path : str or Path
    robust_loops : bool, whether edges between poses that do not follow one another are robust

    Returns
    -------
    PoseGraph

    Raises
    ------
    SourceError : the file cannot be read, or what is wrong in which line
    """
    content, torn = read_bytes(path)
    if torn:
        raise SourceError(f"{path} is truncated: its gzip data end too early")
    rows = {"VERTEX_SE2": [], "EDGE_SE2": [], "FIX": []}
    for number, (line, _) in enumerate(lines(content), 1):
        word, *numbers = line.decode("utf-8", "replace").partition("#")[0].split() or [""]
        if word:
            where = f"{path}, line {number}"
            if word not in rows:
                known = ", ".join(rows)
                raise SourceError(f"{where}: {word} is none of {known}, a pose graph in the plane")
            rows[word].append((where, _parse_numbers(word, numbers, where)))
    return _build_graph(path, rows, robust_loops)


def _build_graph(path, rows, robust_loops):
    """Build the PoseGraph from rows by their keyword; each row says where it stands."""
    if not rows["VERTEX_SE2"]:
        raise SourceError(f"{path} holds no VERTEX_SE2: a pose graph in the plane has some")
    graph, index = PoseGraph(), {}
    for where, (name, *pose) in sorted(rows["VERTEX_SE2"], key=lambda row: row[1][0]):
        if name in index:
            raise SourceError(f"{where}: duplicate vertex {name:g}")
        index[name] = graph.add_pose(pose)

    def numbered(where, names):
        missing = [name for name in names if name not in index]
        if missing:
            raise SourceError(f"{where}: there is no vertex {missing[0]:g}")
        return [index[name] for name in names]

    for where, (first, second, *numbers) in rows["EDGE_SE2"]:
        i, j = numbered(where, (first, second))
        information = np.empty((3, 3))
        information[UPPER_TRIANGLE] = information.T[UPPER_TRIANGLE] = numbers[3:]
        try:
            graph.add_edge(i, j, numbers[:3], information, robust_loops and abs(i - j) != 1)
        except ValueError as error:
            raise SourceError(f"{where}: {error}") from None
    fixed = [i for where, names in rows["FIX"] for i in numbered(where, names)]
    graph.fixed = set(fixed) or {0}
    return graph


def _parse_numbers(word, numbers, where):
    """Parse the numbers of a line: finite, and as many as its keyword takes."""
    try:
        values = [float(number) for number in numbers]
    except ValueError:
        raise SourceError(f"{where}: a word instead of a number") from None
    if not np.isfinite(values).all():
        raise SourceError(f"{where}: its numbers are not all finite")
    if len(values) != FIELD_COUNTS.get(word, len(values)):
        raise SourceError(f"{where}: {word} has {FIELD_COUNTS[word]} numbers, not {len(values)}")
    return values
