"""Autograding submissions: the judge runs no student code, the sandboxed worker holds no answer.

Read in this order:

- ``submissions``, ``notebooks``, ``hand_in_times``: what was handed in, and when; ``preflight``:
  warnings about its form
- ``judge``, ``task_judging``: one submission; ``batch``, ``judges``, ``joining``,
  ``dask_cluster``: a folder; ``storing``, ``records``
- ``worker_pool``, ``zygote``, ``forked_workers``, ``fresh_workers``, ``worker_client``, ``worker``,
  ``wire_protocol``: fork server (zygote) and sandboxed processes, serialisation between them
- ``staging``, ``import_closure``, ``syntax``, ``hidden_packages``, ``checks_stub``: what a worker
  holds; ``sandbox`` (``bubblewrap``, ``landlock``, ``seccomp``), ``quotas``, ``tree_removal``,
  ``isolation``; ``probe`` and ``probe_drives``: the self-test
- ``gradebook``, ``gradebook_rows``, ``database``, ``ledger``, ``older_gradebooks``, ``marks``,
  ``remarks``, ``late_policy``, ``toml_files``: attempts, overrides, late policy
- ``evidence``, ``course_digests``, ``rejudging``, ``rejudge_report``: judging again, by another
  version, what is kept of an attempt
- ``feedback``, ``redaction``, ``local_times``, ``class_report``, ``hostile_signs``,
  ``likeness``, ``grade_tables``, ``nbgrader_gradebook``: feedback pages, reports, exports
- ``term``: a course file, a roster, downloads of Moodle and Canvas, releases
- ``lti``: the roster from an LMS, and grades back into it
"""
