"""The exercises: what each task asks, how answers are driven, and the laws they are judged by.

Read in this order:

- ``task``: Task, Law, Diagnosis; ``verdict``: what was found; ``report``: how it is said
- ``exercise``: Exercise, the tasks of one notebook; ``catalogue``: all exercises by number
- ``tasks``: inputs and laws, ``exNN_topic`` a task, ``exNN`` an exercise (the judge's side)
- ``drives``: how a student's functions are called (the worker's side, which holds no answers)
"""
