"""SLAM live in a page of the browser, without a notebook: ``slamlab live``.

Read in this order:

- ``desk``: the run, and what may be done with it, by a page or the terminal
- ``lease``: one drives at a time, and says so again and again; else the robot stands
- ``live_sources``: what a source is made by; devices keep their ports in processes of their own
- ``filmed_stepper``: the run step by step, dead reckoning beside, filmed
- ``watchers``: pages that look, each at its own pace
- ``serving``: routes, the socket, start and end; ``terminal``: lines that are typed there
- ``page``: what the browser gets
"""
