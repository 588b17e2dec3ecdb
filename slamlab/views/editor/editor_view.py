"""World editor view: a text area beside a canvas, each kept in step with the other."""

import html

import ipywidgets

from slamlab.views.editor.edit_history import WorldEditor
from slamlab.views.showing import bundle, show_beside_still
from slamlab.views.sliders import explore
from slamlab.views.widget_errors import error_line


def edit_world(world, alt, scan=None, dragging=True):
    """Edit a world in the notebook: drag an end of a wall, or change a number and click outside.

    Parameters
    ----------
    world : World
    alt : str, what the first figure shows
    scan : (World) -> (n, 2) points to draw, or None
    dragging : bool; False edits by numbers alone, as where anywidget is missing

    Returns
    -------
    WorldEditor, whose ``world`` follows what is dragged and typed
    """
    editor = WorldEditor(world, scan)
    layout = ipywidgets.Layout(width="21em", height="26em")
    rows = ipywidgets.Textarea(editor.text, layout=layout, continuous_update=False)
    rows.tooltip = html.escape("x1 y1 x2 y2: a wall; x y radius: a circle [m]")
    board = _make_board(editor, alt) if dragging else None
    if board is None:

        def drawn(rows):
            editor.edit_text(rows)
            return editor.figure()

        explore(drawn, alt, rows=rows)
        return editor
    still = bundle(editor.figure(), alt)
    show_beside_still(_connect(editor, board, rows), still)
    return editor


def _make_board(editor, alt):
    """Canvas widget, or None without anywidget: imported late, most notebooks need none."""
    try:
        from slamlab.views.editor.board import Board, points_bytes, world_message
    except ImportError:
        return None
    return Board(
        alt=alt, world=world_message(editor.world), scan=points_bytes(editor.scan_points())
    )


def _connect(editor, board, rows):
    """Drawing, rows and a button to undo, in a box; whichever is used, the others follow."""
    from slamlab.views.editor.board import points_bytes, world_message

    undo = ipywidgets.Button(description="↶ undo", tooltip="the last change; Ctrl+Z in the drawing")
    message, following = ipywidgets.HTML(), []

    def follow(moved=False):
        following.append(True)  # what is set here was not done by the reader
        try:
            if not moved:
                board.world = world_message(editor.world)
            if not editor.error:
                rows.value = editor.text
            message.value = _warning(f"Not drawn: {editor.error}") if editor.error else ""
            board.scan = points_bytes(editor.scan_points())
        except Exception as error:
            # a callback has no cell to fail in
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
            follow()  # the browser is shown what holds
        else:
            follow(moved=True)

    def typed(change):
        if not following:
            editor.edit_text(change["new"])
            follow()

    def undone(*_):
        editor.undo()
        follow()

    board.observe(moved, "world")
    rows.observe(typed, "value")
    undo.on_click(undone)
    board.on_msg(lambda _, content, __: undone() if content == {"kind": "undo"} else None)
    beside = ipywidgets.VBox([rows, undo, message], layout={"width": "22em"})
    return ipywidgets.HBox([board, beside], layout={"flex_flow": "row wrap"})


def _warning(text):
    # the page may be light or dark
    return f'<span style="color:var(--jp-error-color1, #b83a00)">{html.escape(text)}</span>'
