"""The drawing in a browser: a small JavaScript library without dependencies, and without a build.

Its files are joined to one script (``library``). Read in this order:

- ``page.js``: HTML elements; ``theme.js``: colours of paper and letters, which who draws hands in
- ``plane.js``: layers that frames bring, and the camera; ``drawing.js``, ``panels.js``: one drawing
- ``picture.js``: canvas and status line on a page; wheel, drag and touch; ``player.css``
- feeds: ``live_feed.js``, a SLAM that runs, over a widget's comm or any other channel of messages;
  ``film.js``, a recording of frames, and ``film_player.js``: play, pause, scrub
"""
