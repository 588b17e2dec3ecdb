"""Live views of SLAM in a notebook and a web page; films; a world editor. Read in this order:

- ``live_view``: ``watch``; ``estimator_run``: an estimator on a source, step by step
- ``run_loop``: event loop of a view
- ``reading_thread``: background reading; ``run_scene``: layers drawn; ``voxel_filter``: clouds
- ``frame_packing``: layers as bytes; ``back_pressure``: flow control
- ``canvas``, ``raster_screen``: screens with and without JavaScript
- ``controls``, ``drive_control``: buttons, keyboard driving, typed commands
- ``shifted_layers``: maps side by side
- ``player``, ``canvas.js``, ``jupyter_theme.js``, ``jupyter.css``: the drawing in the browser
- ``films``: recordings of frames; ``editor``: world editor
- ``web_server``: access control, sessions, limits; ``console``: ``slamlab live``
"""

from slamlab._lazy import exports

__all__ = exports(
    __name__,
    {".live_view": ["watch"], ".shifted_layers": ["shift_layers"], ".editor": ["edit_world"]},
)
