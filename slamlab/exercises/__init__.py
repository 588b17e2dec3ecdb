"""The exercises: what each task asks, how answers are driven, and the laws they are judged by.

Read in this order:

- ``law``: Law, Diagnosis; ``task``: Task, Probe, their judging; ``outputs``: what may be judged
- ``run_task``: a task run and told; ``verdict``: what was found; ``report``: how it is said
- ``time_limit``: the timeout of what students wrote, and what it printed
- ``cases``: the smallest input on which a law fails; ``case_text``: how it is shown;
  ``reading``: its arrays in the function's own terms
- ``fingerprints``: mistakes recognised by what they compute; ``families``: those without a name;
  ``clues``: where and how an answer is wrong that is not recognised
- ``exercise``: Exercise, the tasks of one notebook; ``catalogue``: all exercises by number
- ``tasks``: inputs and laws, ``exNN_topic`` a task, ``exNN`` an exercise (the judge's side)
- ``drives``: how a student's functions are called (the worker's side, which holds no answers)
"""
