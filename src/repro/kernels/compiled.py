"""The decorators of compiled kernels.

numba is imported when a kernel is first called: Snakemake reads the parameters of all studies at
every start, and numba would take as long as all of that.
"""

from collections.abc import Callable
from functools import cached_property, update_wrapper
from typing import Any


class Kernel:
    """A function that is compiled when it is first called, or called by another kernel."""

    def __init__(self, function: Callable, **options: Any):
        if function.__closure__:
            raise TypeError(
                f"kernel {function.__qualname__} is a closure; pass what it needs as data"
            )
        self._function, self._options = function, options
        update_wrapper(self, function)

    @cached_property
    def dispatcher(self) -> Any:
        """What numba has made of it."""
        from repro.kernels.machine_code import compiled

        ieee = {"error_model": "numpy", "fastmath": False, "_nrt": False}
        return compiled(self._function, **ieee, **self._options)

    def __call__(self, *arguments: Any) -> Any:
        return self.dispatcher(*arguments)

    @property
    def _numba_type_(self) -> Any:
        """By which numba knows it within another kernel."""
        return self.dispatcher._numba_type_


def kernel(function: Callable) -> Any:
    """Compile a module-level function; its machine code is kept between processes.

    IEEE arithmetic as written: nothing is reordered or contracted, a division by zero is infinite
    or NaN. A kernel allocates nothing, its arrays are handed to it: counting the references to
    slices would cost more than what is done with them. Raises TypeError for a closure, which would
    be compiled anew in every process.
    """
    return Kernel(function)


def scalar(function: Callable) -> Any:
    """A kernel of scalars, put into each loop that calls it, for only so can it be vectorised."""
    return Kernel(function, forceinline=True)
