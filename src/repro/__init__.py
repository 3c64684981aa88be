"""Filtering over unreliable networks: four papers, reproduced from parameters to verdicts."""

__version__ = "1.0.0"
