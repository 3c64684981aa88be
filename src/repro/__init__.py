"""Filtering over unreliable networks: four papers, reproduced from parameters to verdicts.

The Python interface is study, run, estimate and compare (repro.inspect.interface).
"""

from importlib import import_module
from typing import Any

__version__ = "1.0.0"
INTERFACE = ("study", "run", "estimate", "compare")


def __getattr__(name: str) -> Any:
    """The interface on first use: a job that does not use it need not import pandas."""
    if name in INTERFACE:
        return getattr(import_module("repro.inspect.interface"), name)
    raise AttributeError(f"module 'repro' has no attribute '{name}'")
