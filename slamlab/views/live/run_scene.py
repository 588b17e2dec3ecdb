"""Scene of a run: what a live view or a film shows of a source and of what estimates from it."""

from slamlab.layers import Poses
from slamlab.views.live.frame_packing import Scene


def run_scene(source, estimator, beside, count, time):
    """Scene of a run after some readings.

    Parameters
    ----------
    source : Source
    estimator : Estimator
    beside : dict, name to Estimator that takes in the same readings
    count : int, readings taken in
    time : float, of the last one [s]

    Returns
    -------
    Scene
    """
    layers = run_layers(source, estimator, beside, count)
    status = step_line(count, len(source), time, estimator.status)
    return Scene(layers, status, source.robot.radius)


def run_layers(source, estimator, beside, count, truth=True):
    """Layers of a run: the true track where it is known, those of others, then the estimator's.

    Parameters
    ----------
    source, estimator, beside, count : see :func:`run_scene`
    truth : bool, whether the true track is wanted

    Returns
    -------
    list of Layer
    """
    layers = []
    if truth and source.truth is not None:
        layers.append(Poses("truth", source.truth.poses[:count]))
    layers += [Poses(name, each.trajectory().poses) for name, each in beside.items()]
    return layers + estimator.layers()


def step_line(count, whole, time, *more):
    """Status line: how many readings of how many, time, and more.

    Parameters
    ----------
    count : int
    whole : int, 0 where it is not known
    time : float [s]
    more : str each; empty ones are left out

    Returns
    -------
    str
    """
    step = f"step {count}" + (f" of {whole}" if whole > count else "")
    return " · ".join(part for part in (step, f"t = {time:.1f} s", *more) if part)
