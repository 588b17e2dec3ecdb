"""A world edited in the notebook: by its rows, and by dragging what they stand for."""

from slamlab.views.editor.show import edit_world
from slamlab.views.editor.state import WorldEditor

__all__ = ["WorldEditor", "edit_world"]
