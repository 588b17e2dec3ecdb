"""World editor (map editor) in a notebook: walls and circles by their numbers or by dragging.

Read in this order:

- ``edit_history``: the world being edited, with undo; ``board``: the drawing that is dragged
- ``editor_view``: both in a notebook
"""

from slamlab.views.editor.edit_history import WorldEditor
from slamlab.views.editor.editor_view import edit_world

__all__ = ["WorldEditor", "edit_world"]
