"""Compiled loops, and what they share: elementary functions, random numbers, resampling.

A kernel is a module-level function under `compiled.kernel`, or under `compiled.scalar` if it works
on scalars within other kernels' loops. It gives the same bytes on every machine, and for that uses
- + - * / and np.sqrt, comparisons, integers and bits; never ** or another function of NumPy's or
  the C library's: `elementary` has exp, log, sine and cosine, arctan2, normal probabilities;
- its own loops; never @, np.dot or np.linalg, whose sums BLAS orders as it likes; a sum in several
  parts for speed says which;
- random numbers from `random`, functions of a key and a counter;
- arrays that are handed to it: it allocates none.
Models differ by data, numbers and arrays, or have kernels of their own that Python chooses from:
closures and functions as arguments would be compiled anew in every process. A loop over particles
is vectorised if it does one thing, without branches, gathers or sums; it is worth being short.
Callers in plain NumPy have the elementary functions in `arrays`.
"""
