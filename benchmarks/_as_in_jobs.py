"""Importing this first starts a benchmark again with the settings that the workflow gives jobs.

JAX gets one thread, too: CPU time is compared.
"""

import os
import sys

SETTINGS = {
    "OPENBLAS_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
    "MALLOC_TRIM_THRESHOLD_": "268435456",
    "MALLOC_MMAP_THRESHOLD_": "268435456",
    "JAX_PLATFORMS": "cpu",
    "XLA_FLAGS": "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1",
}
if any(os.environ.get(name) != SETTINGS[name] for name in SETTINGS):
    os.execve(sys.executable, [sys.executable, *sys.argv], os.environ | SETTINGS)
