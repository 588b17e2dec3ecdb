"""Local web server: its process has no access to Jupyter's token, files or kernel.

- ``http_server``: access control of every request, limits, start; ``stop_signals``
- ``sessions``: login by token or code, session cookies; ``public_routes``: routes without a login
- ``connection_limits``: bounds on open connections; ``rate_limits``: token buckets
"""
