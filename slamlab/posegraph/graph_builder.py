"""Builder of a pose graph from the rows of a file: ids, matrices, and initial poses."""

import numpy as np

from slamlab.files import SourceError
from slamlab.posegraph.g2o_parser import TORO
from slamlab.posegraph.pose_graph import WORLD, Edge, PoseGraph, components, smallest_eigenvalues
from slamlab.posegraph.rotation_first import initial_poses, place_landmarks

UPPER_TRIANGLES = {size: np.triu_indices(size) for size in (2, 3)}  # of an information matrix


class Assembly:
    """Builds a graph from a file's Rows and numbers the ids; a SourceError names the line."""

    def __init__(self, path, rows):
        self.path = path
        self.vertices = [some for some in rows if some.kind.role == "vertex"]
        self.others = [some for some in rows if some.kind.role != "vertex"]
        self.given = {some.kind.landmark for some in self.vertices}
        self.ids, self.landmark = self._nodes()
        edges = [self._edges(some) for some in self.others]
        empty = np.empty(0, int), np.empty((0, 2), int), np.empty((0, 3)), np.empty((0, 3, 3))
        columns = [np.concatenate(column) for column in zip(empty, *edges, strict=True)]
        order = np.argsort(columns[0], kind="stable")
        self.pairs, self.measured, self.information = (column[order] for column in columns[1:])

    def _nodes(self):
        """Return the sorted ids of vertices (without them, of edges), and which are landmarks."""
        names = [(some.ids[:, 0], some.kind.landmark) for some in self.vertices]
        for some in self.others:
            ends = zip(some.ids.T[::-1], (some.kind.landmark, False), strict=False)
            names += [(ids, landmark) for ids, landmark in ends if landmark not in self.given]
        if not names:
            raise SourceError(f"{self.path} contains no pose graph: it has no vertex and no edge")
        kinds = np.repeat([landmark for _, landmark in names], [len(ids) for ids, _ in names])
        names = np.concatenate([ids for ids, _ in names])
        ids, first = np.unique(names, return_index=True)
        lines = np.concatenate([np.empty(0, int), *(some.lines for some in self.vertices)])
        again = np.setdiff1d(np.arange(len(lines)), first)
        if len(again):
            k = again[np.argmin(lines[again])]
            raise SourceError(f"{self.path}, line {lines[k]}: duplicate vertex {names[k]}")
        if self.given == {True} and not kinds.all():
            raise SourceError(
                f"{self.path} has VERTEX_XY, but no VERTEX_SE2: give both, or neither"
            )
        return ids, kinds[first]

    def _numbers(self, lines, ids, landmark=None):
        """Return node numbers of some ids. Raises SourceError for a missing id or a wrong kind."""
        found = np.minimum(np.searchsorted(self.ids, ids), len(self.ids) - 1)
        missing = self.ids[found] != ids
        odd = np.full(len(found), landmark is not None) & (self.landmark[found] != landmark)
        if (missing | odd).any():
            k = int(np.argmax(missing | odd))
            where, name = f"{self.path}, line {lines[k]}", ids[k]
            if missing[k]:
                raise SourceError(
                    f"{where}: there is no vertex {name}; add it, or leave out all vertices to "
                    "initialise their poses from the edges"
                )
            kind = "pose" if landmark else "landmark"
            raise SourceError(f"{where}: vertex {name} is a {kind}, which is not allowed here")
        return found

    def graph(self, fixed, robust_loops):
        """Return the graph, in which only the ``fixed`` nodes, (line, id) pairs, are fixed."""
        lines_fixed = [line for line, _ in fixed]
        nodes = self._numbers(lines_fixed, np.array([name for _, name in fixed], dtype=object))
        lines_of = dict(zip(nodes.tolist(), lines_fixed, strict=True))
        rank = np.cumsum(~self.landmark)[self.pairs]  # among the poses
        between = (self.pairs[:, 0] != WORLD) & ~self.landmark[self.pairs[:, 1]]
        robust = robust_loops & between & (np.abs(rank[:, 0] - rank[:, 1]) != 1)
        graph = PoseGraph(self._poses(lines_of, robust))
        graph.landmarks = set(np.flatnonzero(self.landmark).tolist())
        graph.fixed = set(nodes.tolist())
        columns = *self.pairs.T.tolist(), self.measured, self.information, robust.tolist()
        graph.edges = list(map(Edge, *columns))
        return graph

    def _edges(self, some):
        """Return lines, pairs (m, 2), measured (m, 3), information (m, 3, 3) of m edges."""
        kind, lines, size = some.kind, some.lines, some.kind.size
        j = self._numbers(lines, some.ids[:, -1], kind.landmark)
        i = self._numbers(lines, some.ids[:, 0], False) if kind.ids == 2 else np.full(len(j), WORLD)
        measured, information = np.zeros((len(j), 3)), np.zeros((len(j), 3, 3))
        measured[:, :size] = some.numbers[:, :size]
        row, column = UPPER_TRIANGLES[size]
        information[:, row, column] = information[:, column, row] = some.numbers[:, size:]
        least = smallest_eigenvalues(information[:, :size, :size])
        wrong = least <= 0
        if kind.role == "prior":  # components that were not measured may have no information
            wrong = (least < -1e-9) | ~information.any(axis=(1, 2))
        if (wrong | (i == j)).any():
            k = int(np.argmax(wrong | (i == j)))
            where = f"{self.path}, line {lines[k]}: {some.word}"
            if i[k] == j[k]:
                raise SourceError(f"{where} connects vertex {some.ids[k, 0]} to itself")
            remedy = "if a direction was not measured (degenerate), give it a small information"
            if some.word in TORO:
                remedy = (
                    "TORO's order is I11 I12 I22 I33 I13 I23; if yours is row by row, write "
                    "EDGE_SE2"
                )
            raise SourceError(f"{where}: the information is singular or negative; {remedy}")
        return lines, np.column_stack([i, j]), measured, information

    def _poses(self, fixed, robust):
        """Return the poses (n, 3) of the nodes: from the file or, if missing, from the edges."""
        poses = np.zeros((len(self.ids), 3))
        for some in self.vertices:
            at = self._numbers(some.lines, some.ids[:, 0])
            poses[at, : some.kind.size] = some.numbers
        if False not in self.given and not self.landmark.all():
            poses = self._initialised(fixed, robust)
        if True not in self.given:
            place_landmarks(poses, self.pairs, self.measured, self.landmark)
        return poses

    def _initialised(self, fixed, robust):
        """Initialise the poses from the edges, without the ``robust`` ones (m,) if the others
        connect the same poses; each root is a fixed node or has a prior."""
        pairs, measured, information = self.pairs, self.measured, self.information
        priors, joined = pairs[:, 0] == WORLD, ~self.landmark[pairs[:, 1]]
        between = pairs[joined & ~priors]
        group = components(between, len(self.ids))[:-1]
        whole = components(pairs[~priors], len(self.ids))[:-1]
        poses = np.flatnonzero(~self.landmark)
        if len(np.unique(group[poses])) > len(np.unique(whole[poses])):
            raise SourceError(
                f"{self.path} has no VERTEX_SE2, and only landmarks connect some poses: add the "
                "vertices of the poses"
            )
        roots = {group[k]: (k, np.zeros(3)) for k in poses[::-1].tolist()}
        anchored = set(whole[pairs[priors, 1]].tolist())
        for k in np.flatnonzero(priors & joined)[::-1].tolist():
            roots[group[pairs[k, 1]]] = pairs[k, 1], measured[k]
        for node, line in fixed.items():
            if self.landmark[node] or whole[node] in anchored:
                raise SourceError(
                    f"{self.path}, line {line}: FIX needs a pose; add the VERTEX_SE2 lines"
                )
            anchored.add(whole[node])
            roots[group[node]] = node, np.zeros(3)
        used = joined & ~priors
        if (components(pairs[used & ~robust], len(self.ids))[:-1] == group).all():
            used &= ~robust  # a false loop would bend the start
        edges = pairs[used], measured[used], information[used]
        return initial_poses(len(self.ids), *edges, dict(roots.values()))
