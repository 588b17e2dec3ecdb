"""Live view of SLAM in a notebook: any source and estimator run, paused, stepped, reset, driven.

Visualisation and teleoperation only: shown are layers (:mod:`slamlab.layers`); nothing in here
computes a pose or a map. Read in this order:

- ``live_view``: live; ``stepper``: source and estimator step by step; ``run_loop``: the event loop
- ``reading_thread``: readings awaited in a thread; ``run_scene``: what is shown of a run
- ``thinning``: of large clouds a point a cell; ``frame_packing``: layers as bytes of a frame
- ``back_pressure``: frame rate and flow control; its screens ``canvas`` (browser), ``raster``
- ``controls``, ``drive_commands``, ``drive_control``: buttons, keyboard driving, typed commands
- ``split_maps``, ``cell_views``: maps side by side, views by cell
- ``canvas.js``, ``jupyter_theme.js``, ``jupyter.css``: the widget in the browser, which draws by
  :mod:`slamlab.views.player`
"""

from slamlab.views.live.live_view import live
from slamlab.views.live.split_maps import apart

__all__ = ["apart", "live"]
