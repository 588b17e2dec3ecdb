"""Loading and saving of planar pose graphs in formats of g2o (Kümmerle et al. 2011) and TORO.

A vertex is ``VERTEX_SE2 id x y θ`` (a pose) or ``VERTEX_XY id x y`` (a landmark). An edge is
``EDGE_SE2 i j x y θ`` or ``EDGE_SE2_XY i j x y``, followed by the upper triangle of its residual's
information matrix, row by row. Priors have one vertex. ``FIX id …`` fixes vertices.
"""

import warnings
from pathlib import Path

import numpy as np

from slamlab.files import SourceError, reason
from slamlab.posegraph import gauge
from slamlab.posegraph.g2o_parser import read_rows
from slamlab.posegraph.graph_builder import UPPER_TRIANGLES, Assembly
from slamlab.posegraph.pose_graph import WORLD

MAX_TURN = 7.0  # of an edge; a larger turn may be in degrees [rad]


def save(graph, path):
    """Save a pose graph to a .g2o file, with all digits. Raises SourceError."""
    rows = []
    for i, pose in enumerate(graph.poses.tolist()):
        point = i in graph.landmarks
        rows.append(("VERTEX_XY", i, *pose[:2]) if point else ("VERTEX_SE2", i, *pose))
    rows += [("FIX", i) for i in sorted(graph.fixed) if i < len(graph)]
    for edge in graph.edges:
        size = 3 if edge.j not in graph.landmarks else 2
        if edge.i == WORLD:
            word, ids = "EDGE_PRIOR_XY" if size == 2 else "EDGE_PRIOR_SE2", (edge.j,)
            if size == 3 and not (edge.measured[2] or edge.information[2].any()):
                word, size = "EDGE_PRIOR_SE2_XY", 2
        else:
            word, ids = "EDGE_SE2" if size == 3 else "EDGE_SE2_XY", (edge.i, edge.j)
        upper = edge.information[UPPER_TRIANGLES[size]].tolist()
        rows.append((word, *ids, *edge.measured[:size].tolist(), *upper))
    text = "".join(" ".join(map(str, row)) + "\n" for row in rows)
    try:
        Path(path).write_text(text, encoding="ascii")
    except OSError as error:
        raise SourceError(f"{path} cannot be written: {reason(error)}") from None


def load(path, robust_loops=False):
    """Load a PoseGraph from a .g2o or TORO file, plain or compressed.

    Nodes are numbered in the order of their ids. If the file has no vertices, the poses are
    initialised from the edges. A component without ``FIX`` or prior is fixed at its first node.
    With robust_loops, edges between poses that are not consecutive are robust. SourceError names
    the line with the error; ``warnings`` report ignored lines and unusual values.
    """
    rows, fixed, left_out = read_rows(path)
    assembly = Assembly(path, rows)
    graph = assembly.graph(fixed, robust_loops)
    notes = []
    if left_out:
        text = ", ".join(f"{count} of {word}" for word, count in left_out.items())
        notes.append(f"ignored lines without constraints: {text}")
    between = assembly.pairs[:, 0] != WORLD
    parts = gauge.parts(assembly.pairs[between], len(graph))
    if len(parts) > 1:
        some = [f"{len(nodes)} from vertex {assembly.ids[nodes[0]]}" for nodes in parts[:5]]
        text = ", ".join(some + ["…"] * (len(parts) > 5))
        notes.append(
            f"{len(parts)} components are not connected ({text}); each without FIX or "
            "prior is fixed at its first vertex"
        )
    turn = np.abs(assembly.measured[between, 2]).max(initial=0)
    if turn > MAX_TURN:
        notes.append(f"an edge has a turn of {turn:g} rad: if it is in degrees, convert it")
    for note in notes:
        warnings.warn(f"{path}: {note}", stacklevel=2)
    gauge.fix(graph, parts)
    return graph
