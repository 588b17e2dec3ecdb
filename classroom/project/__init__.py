"""The final project: a student's own SLAM is run on hidden simulated worlds and scored.

Read in this order: ``floor_plans``, ``routes``, ``furniture_placement``; ``world_parameters``,
``hidden_worlds``, ``world_generation``, ``recorded_logs``; ``estimator_runs`` (within a Budget),
``estimator_worker`` (through a pipe); ``estimate_errors``, ``point_scale``, ``baselines``
(reference points of the scale), ``scores``; ``practice``."""
