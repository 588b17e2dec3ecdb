"""Interactive figure: sliders and other controls that redraw a plot (explore)."""

import html
import traceback
from math import ceil, log10

import ipywidgets

from slamlab.displays import grouped, show_bundle, show_controls
from slamlab.views import play_button
from slamlab.views.showing import bundle


def explore(draw, alt, play=None, **controls):
    """Interactive figure: show a plot with sliders, choices and tick boxes that redraw it.

    The first view is drawn at once, so that a mistake in ``draw`` surfaces as any other. The figure
    is a display of its own below the controls: a notebook that is saved keeps the view last shown.
    A later mistake is shown in place of the figure. Calling this stops whatever plays, so that a
    cell can be run again.

    Parameters
    ----------
    draw : (values of the controls by name) -> Figure
    alt : str, or (values by name) -> str, what the figure shows
    play : str or None, name of a slider that gets a button which moves it from where it stands to
        its end, a step a picture
    controls : by name of draw's argument, in order: a widget of ipywidgets, or
        ``(low, high, first)`` for a slider, whole-numbered when all three are int;
        a list for a choice, its first entry first; a bool for a tick box

    Raises
    ------
    ValueError : when a control is none of these, or ``play`` names no slider
    """
    play_button.stop()
    widgets = {name: _control(name, given) for name, given in controls.items()}
    buttons = []
    if play is not None:
        if play not in widgets:
            raise ValueError(f"play: no control is called {play!r}, only {', '.join(widgets)}")
        buttons.append(play_button.Player(widgets[play]).button)

    def drawn():
        values = {name: widget.value for name, widget in widgets.items()}
        return bundle(draw(**values), alt(**values) if callable(alt) else alt)

    def changed(_):
        try:
            shown = drawn()
        except Exception:
            # a callback has no cell to fail in
            play_button.stop()
            shown = _trouble(traceback.format_exc(limit=-2))
        figure.update(shown, raw=True)

    first = drawn()
    for widget in widgets.values():
        widget.observe(changed, "value")
    show_controls(ipywidgets.VBox([*widgets.values(), *buttons]))
    figure = show_bundle(first)


def _control(name, given):
    if isinstance(given, ipywidgets.ValueWidget):
        if given.has_trait("continuous_update"):
            # one drawing per let-go: nothing piles up behind a slow one
            given.continuous_update = False
        given.style = {"description_width": "initial"}
        return given
    label = name.replace("_", " ")
    layout = {"width": "28em", "max_width": "100%"}
    style = {"description_width": "initial"}
    if isinstance(given, bool):
        return ipywidgets.Checkbox(given, description=label, indent=False)
    if isinstance(given, list) and given:
        choices = [(grouped(each), each) for each in given]
        return ipywidgets.Dropdown(options=choices, description=label, layout=layout, style=style)
    if isinstance(given, tuple) and len(given) == 3 and given[0] <= given[2] <= given[1]:
        whole = all(isinstance(bound, int) for bound in given)
        slider = ipywidgets.IntSlider if whole else ipywidgets.FloatSlider
        low, high, first = given
        step = 1 if whole else (high - low) / 100
        # as many decimals as tell one step from the next
        decimals = max(2, ceil(-log10(step))) if step else 2
        return slider(
            min=low,
            max=high,
            value=first,
            step=step,
            readout_format="d" if whole else f".{decimals}f",
            description=label,
            layout=layout,
            style=style,
            continuous_update=False,
        )
    raise ValueError(
        f"{name}: expected (low, high, first), a list, a bool or a widget, got {given!r}"
    )


def _trouble(text):
    return {"text/html": f"<pre>{html.escape(text)}</pre>", "text/plain": text}
