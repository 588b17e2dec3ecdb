"""Player: drawing in the browser, in JavaScript without dependencies or a build step. Read
in this order:

- ``page.js``: HTML elements; ``theme.js``: colours of background and text
- ``plane.js``: layers, camera; ``drawing.js``, ``panels.js``: drawing of layers and time plots
- ``picture.js``: canvas and status line; wheel, drag and touch; ``player.css``
- ``live_feed.js``: frames over a channel; ``film.js``, ``film_player.js``: a film
- ``script_bundle``: joins the files
"""
