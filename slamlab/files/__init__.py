"""Input files: text that may be compressed or truncated, published recordings by name.

Read in this order:

- ``errors``: SourceError, raised wherever something from outside cannot be read
- ``text_files``: read bytes and lines of plain or gzip files, whole or truncated
- ``published_recordings``: where the public data sets lie on this machine
"""
