"""Films: recordings of the frames of a live view, as files and web pages.

- ``film_file``: the file format, encoding; ``quantising``: numbers as 16-bit integers
- ``film_reader``: decoding; ``film_recorder``: recording; ``film_page``: a page that plays a film
"""

from slamlab.live.films.film_page import page
from slamlab.live.films.film_reader import Film, FilmError, load
from slamlab.live.films.film_recorder import FilmRecorder

__all__ = ["Film", "FilmError", "FilmRecorder", "load", "page"]
