"""Measurement logs as MCAP. No other package knows the format.

One file holds one (study, point, shard): topics of named scalar float64 fields, each message with
its trial and step, encoded as cdr with a ros2msg schema; trials lie end to end on the log clock.
Logs recorded elsewhere are read by `repro.logs.user_log`, which the ordinary run does not import.
"""

from repro.logs.format import Log, LogError, selected
from repro.logs.read import logged_origin, read_log, read_parameters
from repro.logs.write import write_log

__all__ = [
    "Log",
    "LogError",
    "logged_origin",
    "read_log",
    "read_parameters",
    "selected",
    "write_log",
]
