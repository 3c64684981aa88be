"""CPU time of every compiled kernel beside its peers: python benchmarks/kernels.py [--short]

One table for each problem; the exit code is 1 where a goal is missed. The peers are FilterPy, JAX,
NumPy and the library `particles`:

    pip install -c constraints.txt -e '.[bench]'
    pip install --no-deps -r benchmarks/requirements-particles.txt
"""

import _as_in_jobs  # noqa: F401  # isort: skip

import sys

import kalman_filters
import particle_filters
from side_by_side import introduce, sizes

if __name__ == "__main__":
    introduce()
    reached = [benchmark.main(*sizes()) for benchmark in (particle_filters, kalman_filters)]
    sys.exit(0 if all(reached) else 1)
