"""Interactive figures: sliders and other controls redraw a plot."""

import html
import traceback
from math import ceil, log10

from slamlab.extras import needs
from slamlab.views.figure_display import bundle
from slamlab.views.notebook_output import grouped, show_bundle, show_controls


def explore(draw, alt, play=None, **controls):
    """Show a figure with sliders, dropdowns and check boxes that redraw it (interactive figure).

    A running animation stops. An error after the first drawing is shown in place of the figure.
    Raises ValueError if the type of a control is unsupported, or ``play`` does not name a slider.

    Parameters
    ----------
    draw : (values of the controls by name) -> Figure
    alt : str, or (values by name) -> str, description of the figure
    play : str or None, name of a slider that gets a play button
    controls : by name of draw's argument: ``(low, high, initial)`` for a slider, of integers when
        all are int; a list for a dropdown, whose first entry is initial; a bool for a check box;
        or a widget of ipywidgets
    """
    with needs("notebook"):
        import ipywidgets

        from slamlab.views import play_button  # not needed by a worker or a script
    play_button.stop()
    widgets = {name: _control(name, given) for name, given in controls.items()}
    buttons = []
    if play is not None:
        if play not in widgets:
            raise ValueError(
                f"play: there is no control {play!r}. The controls are {', '.join(widgets)}"
            )
        buttons.append(play_button.Player(widgets[play]).button)

    def drawn():
        values = {name: widget.value for name, widget in widgets.items()}
        return bundle(draw(**values), alt(**values) if callable(alt) else alt)

    def changed(_):
        try:
            shown = drawn()
        except Exception:
            # a callback has no cell that could show the error
            play_button.stop()
            shown = _error_bundle(traceback.format_exc(limit=-2))
        figure.update(shown, raw=True)

    first = drawn()
    for widget in widgets.values():
        widget.observe(changed, "value")
    show_controls(ipywidgets.VBox([*widgets.values(), *buttons]))
    figure = show_bundle(first)


def _control(name, given):
    with needs("notebook"):
        import ipywidgets
    if isinstance(given, ipywidgets.ValueWidget):
        if given.has_trait("continuous_update"):
            # one drawing when the control is released, so that drawings do not queue up
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
        # enough decimals to distinguish two steps
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
        f"{name}: expected (low, high, initial), a list, a bool or a widget, got {given!r}"
    )


def _error_bundle(text):
    return {"text/html": f"<pre>{html.escape(text)}</pre>", "text/plain": text}
