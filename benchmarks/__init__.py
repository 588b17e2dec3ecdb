"""Benchmarks: speed and accuracy against peers and limits (``python -m benchmarks.NAME``)."""

import os

# CPU time adds up over threads: every method gets one
for _variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_variable, "1")
