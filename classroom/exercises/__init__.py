"""Tasks of the exercises: inputs, calls of a student's functions, laws that judge the outputs.

Read in this order: ``correctness_laws`` (property-based tests), ``references`` (right functions in
place of wrong ones), ``task``, ``outputs`` (validated), ``verdict``, ``verdict_text``,
``run_task``, ``time_limit``; ``failing_cases`` (shrinking to the
smallest one), ``failing_case_text``, ``case_presentation``; ``fingerprints`` (they choose the
hint), ``mistake_families``, ``unrecognised_mistakes``; ``exercise``, ``catalogue``;
``function_calls`` (the worker's side)."""
