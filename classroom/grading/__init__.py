"""Autograding of submitted notebooks. The judge runs no student code; the sandboxed worker has no
answers. Read in this order:

- ``submissions``, ``notebooks``: find and parse submissions; ``preflight``: warnings in advance
- ``judge``, ``task_judging``: grade one submission; ``batch``, ``judge_pool``, ``dask_cluster``:
  grade many in parallel; ``result_storage``, ``records``: store the results
- ``worker_pool``, ``zygote``, ``forked_workers``, ``spawned_workers``, ``worker_client``,
  ``worker``, ``wire_protocol``: fork server, sandboxed processes, serialisation between them
- ``staging``, ``import_closure``, ``syntax``, ``hidden_packages``, ``checks_stub``: files that a
  worker may import; ``sandbox`` (``bubblewrap``, ``landlock``, ``seccomp``), ``quotas``,
  ``tree_removal``, ``isolation``: isolation levels; ``escape_attempts``: a self-test
- ``gradebook``, ``gradebook_rows``, ``database``, ``ledger``, ``gradebook_migration``, ``marks``,
  ``remarks``, ``late_policy``, ``toml_files``: attempts, overrides, comments, late penalty
- ``stored_answers``, ``course_digests``, ``rejudging``, ``rejudge_report``: rejudge attempts
- ``feedback``, ``page_templates``, ``redaction``, ``local_times``, ``class_report``,
  ``suspicious_code``, ``similarity``, ``grade_tables``, ``nbgrader_gradebook``: pages, exports
- ``term``: course file, roster, Moodle and Canvas; ``lti``: roster and grades of an LMS
"""
