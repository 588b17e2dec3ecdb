"""World editor (map editor) in a notebook: walls and circles, typed or dragged. Read in this order:
``edit_history``: the world, with undo; ``world_canvas``: the drawing; ``editor_view``: both.
"""

from slamlab.live.editor.edit_history import WorldEditor
from slamlab.live.editor.editor_view import edit_world

__all__ = ["WorldEditor", "edit_world"]
