"""The course on a JupyterHub: a student's server, phones, collecting, returning.

- ``student_server``: ``python -m classroom.hub.student_server`` starts a student's Jupyter server
- ``phones``: server extension through which phones reach the user's audience server
- ``user_folders``: safe reading and writing of files in the homes of students
- ``exchange``: collecting submissions and returning feedback
- ``jupyterhub_config``: configuration of a hub on one machine; ``proxy``: its HTTP proxy
"""
