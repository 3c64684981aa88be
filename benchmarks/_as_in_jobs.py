"""Importing this first starts a benchmark again with the settings that the workflow gives jobs."""

import os
import sys

SETTINGS = {
    "OPENBLAS_NUM_THREADS": "1",
    "MALLOC_TRIM_THRESHOLD_": "268435456",
    "MALLOC_MMAP_THRESHOLD_": "268435456",
}
if any(os.environ.get(name) != SETTINGS[name] for name in SETTINGS):
    os.execve(sys.executable, [sys.executable, *sys.argv], os.environ | SETTINGS)
