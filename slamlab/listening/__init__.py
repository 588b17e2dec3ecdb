"""What listens on the network, behind one guard.

A process of its own listens: without Jupyter's token, files or kernel. Read in this order:

- ``guard``: the guard over every request: host, origin, who asks, how often; the listener
- ``door``: who comes in: a token or a code changed into a cookie; a key; ``entrance``: the routes
  that are open to everybody
- ``crowd``: how many connections may be open, and whose gives way
- ``rates``: how often something may be done
- ``ending``: Ctrl-C, and signals that ask it to go
"""
