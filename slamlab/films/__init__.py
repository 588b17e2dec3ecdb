"""Films: recordings of the frames of a live view, small enough to be sent and put on a page.

Read in this order:

- ``film_file``: the format, and its writing; ``quantising``: numbers as 16-bit integers
- ``film_reader``: reading a film; what is damaged is refused
- ``film_recorder``: a film of scenes, frame by frame
- ``film_page``: a film in an HTML page that plays it, by :mod:`slamlab.views.player`
"""

from slamlab.films.film_page import page
from slamlab.films.film_reader import Film, FilmError, load
from slamlab.films.film_recorder import FilmRecorder

__all__ = ["Film", "FilmError", "FilmRecorder", "load", "page"]
