"""Spanning tree of a pose graph, and the drift between two nodes along its edges.

The tree takes a robust edge only where no other edge connects two parts of the graph.
"""

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order, minimum_spanning_tree

UNKNOWN = 1e6  # variance of a component that was not measured [m², rad²]


class SpanningTree:
    """Spanning tree of the edges of a graph; its root is the world frame, node −1, stored last.

    poses (n, 3); fixed (f,): numbers of the fixed nodes; pairs (m, 2), information (m, 3, 3),
    robust (m,): edges. ``needed`` (m,) is the mask of the robust edges in the tree.
    """

    def __init__(self, poses, fixed, pairs, information, robust):
        m, size = len(pairs), len(poses) + 1
        ends = np.vstack([pairs % size, np.column_stack([0 * fixed + size - 1, fixed])])
        noise = np.zeros((len(ends), 3, 3))
        noise[:m] = covariances(information)
        cost = np.trace(noise, axis1=1, axis2=2) + 1e-12
        cost[:m][robust] += 1e3 * UNKNOWN
        best = np.argsort(cost, kind="stable")
        keys, first = np.unique(np.sort(ends[best], axis=1) @ [size, 1], return_index=True)
        best = best[first]  # of parallel edges
        links = coo_array((cost[best], np.divmod(keys, size)), shape=(size, size))
        tree = minimum_spanning_tree(links.tocsr())
        order, self._parent = breadth_first_order(tree, size - 1, directed=False)
        self._order, self._parent[size - 1] = order[1:], size - 1
        steps = np.sort(np.column_stack([self._order, self._parent[self._order]]), axis=1)
        edge = best[np.searchsorted(keys, steps @ [size, 1])]
        self.needed = np.isin(np.arange(m), edge) & robust
        self._frames = adjoint(np.vstack([poses, np.zeros(3)]))
        A = self._frames[ends[edge, 1]]
        self._add_up(A @ noise[edge] @ A.transpose(0, 2, 1))

    def _add_up(self, steps):
        """Add up the covariances of the steps from the root to each node, in the world frame."""
        self._sums, self._depth = np.zeros((len(self._parent), 3, 3)), np.zeros_like(self._parent)
        for k, step in zip(self._order.tolist(), steps, strict=True):
            parent = self._parent[k]
            self._sums[k] = self._sums[parent] + step
            self._depth[k] = self._depth[parent] + 1

    def drift(self, pairs):
        """Return covariances (c, 3, 3) of the pose of j relative to i, in j's frame, of node pairs
        (c, 2)."""
        i, j = pairs.T % len(self._parent)
        common = self._common_ancestors(i, j)
        between = self._sums[i] + self._sums[j] - 2 * self._sums[common]
        B = np.linalg.inv(self._frames[j])
        return B @ between @ B.transpose(0, 2, 1)

    def _common_ancestors(self, i, j):
        """Return the last common ancestor of each pair of nodes, by doubling the steps."""
        above = [self._parent]  # ancestors 1, 2, 4, … steps away
        while 2 ** len(above) <= self._depth.max():
            above.append(above[-1][above[-1]])
        i, j = np.where(self._depth[i] > self._depth[j], [j, i], [i, j])  # j is the deeper one
        for k, ancestor in enumerate(above):
            j = np.where((self._depth[j] - self._depth[i]) >> k & 1, ancestor[j], j)
        for ancestor in above[::-1]:
            apart = ancestor[i] != ancestor[j]
            i, j = np.where(apart, [ancestor[i], ancestor[j]], [i, j])
        return np.where(i == j, i, self._parent[i])


def covariances(information):
    """Invert information matrices (m, 3, 3); a component that was not measured gets UNKNOWN."""
    return np.linalg.inv(information + np.eye(3) / UNKNOWN)


def adjoint(x):
    """Adjoint matrices (n, 3, 3) of poses: from an increment in the pose's frame to the world's."""
    A = np.zeros((len(x), 3, 3))
    A[:, :2, :2] = np.stack(
        [np.cos(x[:, 2]), -np.sin(x[:, 2]), np.sin(x[:, 2]), np.cos(x[:, 2])], 1
    ).reshape(-1, 2, 2)
    A[:, 0, 2], A[:, 1, 2], A[:, 2, 2] = x[:, 1], -x[:, 0], 1
    return A
