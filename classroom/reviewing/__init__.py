"""Review of a class's marks in a local web page, with manual changes and their reasons.

Read in this order: ``class_state``; ``class_overview``, ``submission_view``, ``similarity_view``;
``manual_changes``; ``regrade_request_file``, ``regrade_requests``; ``visible_text``;
``review_routes``. The page inserts students' content as text only, never as HTML."""
