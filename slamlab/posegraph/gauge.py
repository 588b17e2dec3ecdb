"""Gauge freedom of a pose graph: fixed nodes and priors of each connected component."""

import numpy as np

from slamlab.posegraph.pose_graph import WORLD, components


def parts(pairs, count):
    """Return the components of nodes connected by edges (m, 2): ordered arrays of numbers."""
    group = components(pairs, count)[:-1]
    order = np.argsort(group, kind="stable")
    found = np.split(order, np.flatnonzero(np.diff(group[order])) + 1) if len(group) else []
    return sorted(found, key=lambda nodes: nodes[0])


def fix(graph, parts):
    """Fix the gauge of each component that is not fixed yet, at its first node.

    If only the position or only the heading of a component is fixed, the component gets a prior on
    the other one, at the guess of its first pose. This prior adds no cost at the optimum.
    """
    positions, headings = _fixed(graph)
    for nodes in parts:
        nodes = nodes.tolist()
        points = sum(node in positions for node in nodes)
        heading = any(node in headings for node in nodes)
        pose = next((node for node in nodes if node not in graph.landmarks), None)
        if not points and not heading:
            graph.fixed.add(nodes[0])
        elif pose is not None and not (points > 1 or (points and heading)):
            rest = np.diag([0.0, 0.0, 1.0] if points else [1.0, 1.0, 0.0])
            graph.add_prior(pose, graph.poses[pose], rest)


def _fixed(graph):
    """Return the nodes with a fixed or prior position, and those with a fixed or prior heading."""
    positions = set(graph.fixed)
    headings = graph.fixed - graph.landmarks
    for edge in graph.edges:
        if edge.i == WORLD:
            known = np.diag(edge.information) > 0
            positions |= {edge.j} if known[:2].any() else set()
            headings |= {edge.j} if known[2] else set()
    return positions, headings
