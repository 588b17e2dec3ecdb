"""The editor in a notebook: rows beside a drawing, each follows the other."""

import html

import ipywidgets
from IPython.display import display

from slamlab.views.editor.state import WorldEditor
from slamlab.views.figures import bundle
from slamlab.views.mistakes import sentence
from slamlab.views.widgets import explore


def edit_world(world, alt, scan=None, dragging=True):
    """Show a world and its rows: drag an end of a wall, or change a number and click outside.

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
    board = _board(editor, alt) if dragging else None
    if board is None:

        def drawn(rows):
            editor.type(rows)
            return editor.figure()

        explore(drawn, alt, rows=rows)
        return editor
    data, metadata = bundle(editor.figure(), alt)
    box = _connected(editor, board, rows)
    display((box._repr_mimebundle_() or {}) | data, metadata=metadata, raw=True)
    return editor


def _board(editor, alt):
    """The drawing, or None without anywidget, which is imported late: most notebooks need none."""
    try:
        from slamlab.views.editor.board import Board, bytes_of, rows_of
    except ImportError:
        return None
    return Board(alt=alt, world=rows_of(editor.world), scan=bytes_of(editor.seen()))


def _connected(editor, board, rows):
    """Drawing, rows and a button to undo, in a box; whichever is used, the others follow."""
    from slamlab.views.editor.board import bytes_of, rows_of

    undo = ipywidgets.Button(description="↶ undo", tooltip="the last change; Ctrl+Z in the drawing")
    told, following = ipywidgets.HTML(), []

    def follow(moved=False):
        following.append(True)  # what is set here was not done by the reader
        try:
            if not moved:
                board.world = rows_of(editor.world)
            if not editor.wrong:
                rows.value = editor.text
            told.value = _warning(f"Not drawn: {editor.wrong}") if editor.wrong else ""
            board.scan = bytes_of(editor.seen())
        except Exception as error:
            # a callback has no cell to fail in
            told.value = _warning(sentence(error))
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
            editor.type(change["new"])
            follow()

    def undone(*_):
        editor.undo()
        follow()

    board.observe(moved, "world")
    rows.observe(typed, "value")
    undo.on_click(undone)
    board.on_msg(lambda _, content, __: undone() if content == {"kind": "undo"} else None)
    beside = ipywidgets.VBox([rows, undo, told], layout={"width": "22em"})
    return ipywidgets.HBox([board, beside], layout={"flex_flow": "row wrap"})


def _warning(text):
    return f'<span style="color:#D55E00">{html.escape(text)}</span>'
