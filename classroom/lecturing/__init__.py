"""Tools that run without a lecturer: rehearsal of a lesson, and a handout of its slides.

Read in this order: ``headless`` (browser and JupyterLab), ``lesson_page``, ``requirements``,
``time_plan``, ``rehearsal``, ``rehearsal_report``, ``handout``."""
