"""Configuration of a JupyterHub on one machine: see docs/server.md.

The variable SLAM_HUB is the hub's public address; the hub listens at the address SLAM_HUB_BIND."""

import os
import sys
from pathlib import Path

c = get_config()  # noqa: F821
here = Path(__file__).resolve().parent
programs = Path(sys.executable).parent

c.JupyterHub.bind_url = os.environ.get("SLAM_HUB_BIND", "http://127.0.0.1:8000/")
c.JupyterHub.public_url = os.environ.get("SLAM_HUB", c.JupyterHub.bind_url)
c.ConfigurableHTTPProxy.command = [
    str(here / "proxy" / "node_modules" / ".bin" / "configurable-http-proxy")
]
c.Authenticator.allow_all = True  # that is, everybody with an account of this machine

c.Spawner.cmd = [sys.executable, "-m", "classroom.hub.student_server"]
c.Spawner.default_url = "/lab/tree/slam-course/notebooks/00_start_here.ipynb"
c.Spawner.http_timeout = 300  # [s]; the servers of a whole class start at once
c.Spawner.environment = {
    "PATH": f"{programs}:/usr/local/bin:/usr/bin:/bin",
    "OPENBLAS_NUM_THREADS": "1",  # the course's matrices are small
}
