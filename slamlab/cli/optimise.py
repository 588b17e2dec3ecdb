"""``slamlab optimise FILE``: optimise a pose graph in a .g2o or TORO file."""

import csv
import sys
import tempfile
import warnings
from pathlib import Path

from slamlab.cli.common import FAILED, refuse
from slamlab.cli.parsers import add_command
from slamlab.files import SourceError

ENTRIES = {"xx": (0, 0), "xy": (0, 1), "xt": (0, 2), "yy": (1, 1), "yt": (1, 2), "tt": (2, 2)}
SHOWN = 10  # rejected loops in the output


def add_parser(subparsers):
    parser = add_command(
        subparsers,
        "optimise",
        "Optimise a pose graph in a .g2o or TORO file.",
        "manhattan.g2o --out optimised.g2o",
        "intel.g2o --robust --picture intel.png",
    )
    add = parser.add_argument
    add("file", metavar="FILE", help="Pose graph, name of a published one, or - for stdin")
    add("--robust", action="store_true", help="Reject loops that contradict the other edges")
    add("--out", metavar="FILE", help="Write the graph without the rejected loops (.g2o)")
    add("--covariances", metavar="FILE", help="Write the covariance of each node (.csv)")
    add("--picture", metavar="FILE", help="Draw the graph before and after (.png)")
    parser.set_defaults(run=run)


def run(arguments) -> int:
    # imported late: a help text should come at once
    from slamlab.posegraph.optimisation import NO_KERNEL

    try:
        graph = _load(arguments.file, arguments.robust)
        start, before = graph.poses.copy(), graph.optimise(0, kernel=NO_KERNEL).chi2
        if not arguments.robust:
            graph.initialise()
        print(f"{len(graph)} nodes, {len(graph.edges)} edges; χ² before: {before:.6g}")
        found = graph.optimise()
        rejected = [edge for k, edge in enumerate(graph.edges) if k in graph.dropped]
        graph.edges = [edge for k, edge in enumerate(graph.edges) if k not in graph.dropped]
        graph.dropped = set()
        _report(found, graph.optimise(0, kernel=NO_KERNEL).chi2, rejected, arguments.robust)
        _write(arguments, graph, start, rejected)
    except (OSError, ValueError) as error:
        return refuse("optimise", error)
    return 0 if found.converged else FAILED


def _load(name, robust):
    """Load the graph of a file, a published recording or stdin; print the warnings to stderr."""
    from slamlab.posegraph import g2o
    from slamlab.sources.public_datasets import resolve

    if name == "-":
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "stdin")
            path.write_bytes(sys.stdin.buffer.read())
            try:
                return _load(str(path), robust)
            except SourceError as error:
                raise SourceError(str(error).replace(str(path), "stdin")) from None
    with warnings.catch_warnings(record=True) as notes:
        warnings.simplefilter("always")
        graph = g2o.load(resolve(name), robust_loops=robust)
    for note in notes:
        print(f"slamlab optimise: {note.message}", file=sys.stderr)
    return graph


def _report(found, chi2, rejected, robust):
    state = "converged" if found.converged else "not converged"
    print(f"χ² after optimisation: {chi2:.6g} ({state}, iterations: {found.iterations})")
    if robust:
        pairs = ", ".join(f"{edge.i}-{edge.j}" for edge in rejected[:SHOWN]) or "none"
        print(f"rejected loops ({len(rejected)}): {pairs}{' …' * (len(rejected) > SHOWN)}")
    if found.ambiguous:
        less, away = found.runner_up
        print(
            f"ambiguous: another solution, {away:.2f} m away, is nearly as likely "
            f"(−2 log of the ratio: {less:.1f}); only further measurements can decide"
        )


def _write(arguments, graph, start, rejected):
    from slamlab.posegraph import g2o
    from slamlab.views import png

    if arguments.out:
        g2o.save(graph, arguments.out)
    if arguments.covariances:
        with open(arguments.covariances, "w", newline="", encoding="utf-8") as file:
            table = csv.writer(file)
            table.writerow(["node", *ENTRIES])
            for node, P in enumerate(graph.covariances().tolist()):
                table.writerow([node, *(P[i][j] for i, j in ENTRIES.values())])
    if arguments.picture:
        Path(arguments.picture).write_bytes(png(_picture(graph, start, rejected)))


def _picture(graph, start, rejected):
    """Return a figure of the trajectory and the loops, before and after."""
    import numpy as np

    from slamlab.layers import Points, Poses, Segments
    from slamlab.views import COLOURS, draw, legend_below, panels

    route = [k for k in range(len(graph)) if k not in graph.landmarks]
    far = [edge for edge in graph.edges if edge.i >= 0 and abs(edge.i - edge.j) > 1]
    loops = [edge for edge in far if edge.j not in graph.landmarks]
    titles = "before optimisation", "after optimisation"
    fig, all_axes = panels(titles, size=(11, 5.5))
    for ax, poses in zip(all_axes, (start, graph.poses), strict=True):
        kinds = ("loops", loops, "limit"), ("rejected loops", rejected, "naive")
        for name, edges, colour in kinds:
            pairs = np.array([(edge.i, edge.j) for edge in edges], dtype=int).reshape(-1, 2)
            if len(pairs):
                layer = Segments(name, poses[pairs, :2].reshape(-1, 4))
                draw(ax, layer, label=name, color=COLOURS[colour], linewidth=1)
        track = Poses("trajectory", poses[route])
        draw(ax, track, label="trajectory", color=COLOURS["corrected"], linewidth=1)
        if graph.landmarks:
            found = Points("landmarks", poses[sorted(graph.landmarks), :2])
            draw(ax, found, label="landmarks", color=COLOURS["landmark"])
    legend_below(fig)
    return fig
