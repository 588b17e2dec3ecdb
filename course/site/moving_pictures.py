"""Replace ``views.explore`` with pictures for a slider's values, and ``live.watch`` with films."""

import base64
from math import ceil
from types import SimpleNamespace

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg

from course.site.steady_layout import SteadyLayout
from slamlab.live import films
from slamlab.live.drive_control import velocities
from slamlab.live.estimator_run import EstimatorRun
from slamlab.views import sliders
from slamlab.views.alt_text import describe
from slamlab.views.figure_display import PACKING, render
from slamlab.views.figure_layout import arrange

MOST_VALUES = 11  # of a slider
MOST_OF_SEVERAL = 7  # of each, where there are several
MOST_PLAYED = 25  # of one that is played like a film
MOST_FRAMES = 300  # of a film
MOST_STEPS = 1000


class Renderer:
    """Renderer of a lesson's cells.

    Parameters
    ----------
    folder : Path, for pictures and films

    ``cell`` is the id of the running cell. ``rendered`` lists its renderings by the cell's id, each
    ``{"controls": [...]}`` or ``{"film": file, "alt": text}``.
    """

    def __init__(self, folder):
        self._folder, self.cell, self.rendered = folder, "", {}

    def explore(self, draw, alt, play=None, **controls):
        """Render every value of each control, with the other controls at their first values."""
        widgets = {name: sliders._control(name, given) for name, given in controls.items()}
        first = {name: widget.value for name, widget in widgets.items()}
        rendered, known, layout = [], {}, SteadyLayout()
        usual = MOST_VALUES if len(widgets) == 1 else MOST_OF_SEVERAL
        for name, widget in widgets.items():
            values, words = values_of(widget, MOST_PLAYED if name == play else usual)
            shown = []
            for value in values:
                chosen = first | {name: value}
                key = repr(chosen)
                if key not in known:
                    known[key] = self._picture(draw(**chosen), alt, chosen, len(known), layout)
                shown.append(known[key])
            rendered.append(
                {
                    "name": widget.description or name,
                    "kind": "range" if hasattr(widget, "max") else "choice",
                    "first": values.index(first[name]),
                    "words": words,
                    "pictures": [file for file, _ in shown],
                    "alts": [text for _, text in shown],
                }
            )
        self._add({"controls": rendered})

    def live(
        self, source, estimator, alt, *, script=(), beside=None, extra=None, note=None,
        curves=None, truth=True, colours=None, title="", seed=0, tops=(0.4, 0.6),
        size=(720, 480), steps=20, **_,
    ):  # fmt: skip
        """Record a film of each source that needs no input, with the commands that follow.

        Returns
        -------
        namespace with the ``pair`` of the first source, which later code of a lesson may read
        """
        given, steppers = source if isinstance(source, dict) else {"": source}, []
        for number, (name, each) in enumerate(given.items()):
            stepper = EstimatorRun(each, estimator, beside, extra, note, curves, truth, colours)
            steppers.append(stepper)
            if number and not _plays(each, seed):
                continue
            stepper.reset(seed)
            total = len(stepper.source) or steps
            called = f"{title}: {name}" if name and len(given) > 1 else title or name
            file = self._folder / f"{self._stem()}-{number}.film"
            every = ceil((total + len(script)) / MOST_FRAMES)
            with films.FilmRecorder(file, called or "SLAM", alt, size) as film:
                film.add(stepper.scene())
                while stepper.count < min(total, MOST_STEPS) and stepper.step(10.0):
                    if stepper.count % every == 0 or stepper.count == total:
                        film.add(stepper.scene())
                for command in script:
                    stepper.drive(velocities(command, tops))
                    film.add(stepper.scene())
            stepper.close()
            self._add({"film": shipped(file), "title": called, "alt": alt})
        return SimpleNamespace(pair=steppers[0])

    def _picture(self, fig, alt, chosen, number, layout):
        """Return a figure as a lossless WebP image, and its alternative text."""
        text = alt(**chosen) if callable(alt) else alt
        file = self._folder / f"{self._stem()}-{number}.webp"
        FigureCanvasAgg(fig)  # measures text
        arrange(fig, layout)
        # the notebook's pictures have twice this resolution; so many pictures would be too large
        render(fig).save(file, "WEBP", **PACKING)
        return file.name, f"{describe(fig)} {text.strip()}"

    def _stem(self):
        return f"{self.cell}-{len(self.rendered.get(self.cell, []))}"

    def _add(self, what):
        self.rendered.setdefault(self.cell, []).append(what)


def shipped(file):
    """Convert a film to a script, which a page can load from a file.

    Parameters
    ----------
    file : Path, of the film, which is deleted

    Returns
    -------
    str, name of the script in the same folder
    """
    text = base64.b64encode(file.read_bytes()).decode()
    script = file.with_suffix(".js")
    script.write_text(f'slamlabFilm("{script.name}", "{text}");\n', encoding="utf-8")
    file.unlink()
    return script.name


def values_of(widget, most):
    """Return evenly spaced values of a control, including the first one, and their labels.

    Parameters
    ----------
    widget : ValueWidget
    most : int, how many values a slider may have

    Returns
    -------
    (list, list of str)

    Raises
    ------
    ValueError : the control has no list or range of single values, such as a field for text
    """
    if hasattr(widget, "index") and not isinstance(widget.index, tuple):
        # as ipywidgets reads them: pairs, a mapping, or values alone
        pairs = list(zip(widget._options_labels, widget._options_values, strict=True))
        if hasattr(widget, "continuous_update"):
            pairs = _thinned(pairs, most, lambda pair: pair[1] == widget.value)
        return [value for _, value in pairs], [word for word, _ in pairs]
    if isinstance(widget.value, bool):
        return [False, True], ["no", "yes"]
    if not hasattr(widget, "readout_format") or isinstance(widget.value, tuple):
        raise ValueError(f"a {type(widget).__name__} has no list of values to draw")
    count = round((widget.max - widget.min) / widget.step) + 1 if widget.step else 1
    values = [widget.min + n * widget.step for n in range(count)]
    if hasattr(widget, "base"):  # whose bounds and steps are exponents
        values = [widget.base**value for value in values]
    if isinstance(widget.value, float):
        values = [float(format(value, ".12g")) for value in values]
    nearest = min(values, key=lambda value: abs(value - widget.value))
    values[values.index(nearest)] = widget.value
    values = _thinned(values, most, lambda value: value == widget.value)
    return values, [format(value, widget.readout_format) for value in values]


def _thinned(values, most, is_first):
    kept = {round(at) for at in np.linspace(0, len(values) - 1, min(most, len(values)))}
    kept |= {n for n, value in enumerate(values) if is_first(value)}
    return [values[n] for n in sorted(kept)]


def _plays(make, seed):
    """Whether a source needs no commands, devices or other input."""
    source = make(np.random.default_rng(seed)) if callable(make) else make
    count = len(source)
    if callable(make):
        source.close()
    return count > 1
