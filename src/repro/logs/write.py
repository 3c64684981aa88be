"""Writing a log: equal content gives equal bytes."""

import json
from pathlib import Path

import numpy as np
from mcap.opcode import Opcode

from repro import __version__
from repro.atomic import atomic_write
from repro.logs.container import Container
from repro.logs.format import (
    CDR_LITTLE_ENDIAN,
    ENCODING,
    PARAMETERS,
    PROFILE,
    PROVENANCE,
    RECORD_HEAD,
    SCHEMA_ENCODING,
    Log,
    record_dtype,
    schema_name,
    schema_text,
)

TRIALS_A_BLOCK = 20  # in a chunk, so that a player reads the topics together


def write_log(
    path: str | Path,
    log: Log,
    period: float,
    attachments: dict[str, bytes] | None = None,
    origin: str = "",
) -> None:
    """Write `log`, `period` seconds of log clock a step; the file appears complete or not at all.

    `attachments` are JSON texts by name, beside the parameters; `origin` is what `read_log` can
    ask for.
    """
    with atomic_write(path) as part, part.open("wb") as stream:
        container = Container(stream, PROFILE, f"repro {__version__}")
        container.add_metadata(
            PROVENANCE,
            {
                "study": log.study,
                "point": log.point,
                "root_seed": str(log.seed),
                "first_trial": str(log.trials[0]),
                "trials": str(len(log.trials)),
                "period_s": repr(period),
                "origin": origin,
            },
        )
        parameters = json.dumps(log.parameters.plain(), sort_keys=True, indent=1)
        texts = {PARAMETERS: parameters.encode()} | (attachments or {})
        for name, text in texts.items():
            container.add_attachment(name, "application/json", text)
        _write_messages(container, log, round(period * 1e9))
        container.finish()


def _write_messages(container: Container, log: Log, period_ns: int) -> None:
    channels = {
        topic: container.add_channel(
            topic, ENCODING, (schema_name(log.study, topic), SCHEMA_ENCODING, schema_text(fields))
        )
        for topic, fields in log.fields.items()
    }
    for first in range(0, len(log.trials), TRIALS_A_BLOCK):
        block = slice(first, first + TRIALS_A_BLOCK)
        records = {
            channels[topic]: _records(
                channels[topic], log.trials[block], values[block], log.steps, period_ns
            )
            for topic, values in log.values.items()
        }
        container.add_chunk(records)


def _records(
    channel: int, trials: np.ndarray, values: np.ndarray, steps: int, period_ns: int
) -> np.ndarray:
    """Message records of one topic for a block of trials; trial follows trial on the clock."""
    count, fields = values.shape[1:]
    records = np.empty((len(trials), count), dtype=record_dtype(fields))
    time = (trials[:, None] * steps + np.arange(count)) * period_ns
    records["opcode"] = Opcode.MESSAGE
    records["length"] = records.dtype.itemsize - RECORD_HEAD.size
    records["channel"] = channel
    records["sequence"] = 0  # not used, as in rosbag2: trial and step say more
    records["log_time"] = records["publish_time"] = time
    payload = records["payload"]
    payload["cdr"] = CDR_LITTLE_ENDIAN
    payload["trial"] = trials[:, None]
    payload["step"] = np.arange(count)
    payload["values"] = values
    return records.ravel()
