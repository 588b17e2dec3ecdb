"""Web console of a live run: ``slamlab live``. Read in this order:

- ``control_panel``: the run, and the commands of pages and the terminal
- ``drive_lock``: one client drives at a time; the lock expires unless renewed (dead man's switch)
- ``live_sources``: opening a source; ``recorded_run``: the estimator's run, recorded as a film
- ``page_screens``: screens of the pages, each with its own frame rate
- ``console_server``: routes, WebSocket, commands from the terminal; ``page``: the browser's files
"""
