"""World editor view: a text area and a canvas, synchronised."""

import html

import numpy as np

from slamlab.extras import needs
from slamlab.live.editor.edit_history import WorldEditor
from slamlab.live.run_loop import error_line
from slamlab.views.figure_display import bundle, show_beside_still
from slamlab.views.sliders import explore

with needs("notebook"):
    import ipywidgets


def edit_world(world, alt, scan=None, dragging=True):
    """Show a world editor in the notebook: the user drags ends of walls or changes numbers. Returns
    a WorldEditor whose ``world`` follows the edits.

    Parameters
    ----------
    world : World
    alt : str, description of the first figure
    scan : (World) -> (n, 2) points to draw [m], or None
    dragging : bool; False for a text area without the canvas
    """
    editor = WorldEditor(world, scan)
    layout = ipywidgets.Layout(width="21em", height="26em")
    rows = ipywidgets.Textarea(editor.text, layout=layout, continuous_update=False)
    rows.tooltip = html.escape("x1 y1 x2 y2: a wall; x y radius: a circle [m]")
    canvas = _make_canvas(editor, alt) if dragging else None
    if canvas is None:

        def redraw(rows):
            editor.edit_text(rows)
            return editor.figure()

        explore(redraw, alt, rows=rows)
        return editor
    still = bundle(editor.figure(), alt)
    show_beside_still(_connect(editor, canvas, rows), still)
    return editor


def _make_canvas(editor, alt):
    try:
        from slamlab.live.editor.world_canvas import WorldCanvas
    except ImportError:  # without anywidget
        return None
    return WorldCanvas(alt=alt, world=_world(editor), scan=_scan(editor))


def _world(editor):
    walls, circles = editor.world.walls.tolist(), editor.world.circles.tolist()
    return {"walls": walls, "circles": circles, "edit": 0}


def _scan(editor):
    return np.asarray(editor.scan_points(), dtype="<f4").tobytes()


def _connect(editor, canvas, rows):
    """Create a box with a canvas, text rows that are synchronised with it, and an undo button."""
    undo = ipywidgets.Button(
        description="↶ undo", tooltip="Undo the last change (Ctrl+Z in the drawing)"
    )
    message, following = ipywidgets.HTML(), []

    def follow(moved=False):
        following.append(True)  # changes made here are not the reader's
        try:
            if not moved:
                canvas.world = _world(editor)
            if not editor.error:
                rows.value = editor.text
            message.value = _warning(f"Not drawn: {editor.error}") if editor.error else ""
            canvas.scan = _scan(editor)
        except Exception as error:
            # a callback has no cell that could show the error
            message.value = _warning(error_line(error))
        finally:
            following.pop()

    def moved(change):
        if following:
            return
        new = change["new"]
        try:
            editor.move(new["walls"], new["circles"], new.get("edit"))
        except (ValueError, KeyError):
            follow()  # the browser shows the valid world again
        else:
            follow(moved=True)

    def text_changed(change):
        if not following:
            editor.edit_text(change["new"])
            follow()

    def undo_edit(*_):
        editor.undo()
        follow()

    canvas.observe(moved, "world")
    rows.observe(text_changed, "value")
    undo.on_click(undo_edit)
    canvas.on_msg(lambda _, content, __: undo_edit() if content == {"kind": "undo"} else None)
    beside = ipywidgets.VBox([rows, undo, message], layout={"width": "22em"})
    return ipywidgets.HBox([canvas, beside], layout={"flex_flow": "row wrap"})


def _warning(text):
    # the colour of the page's theme
    return f'<span style="color:var(--jp-error-color1, #b83a00)">{html.escape(text)}</span>'
