"""Writing a log: byte for byte a function of its content, through the mcap package."""

import json
import os
from pathlib import Path

import numpy as np
from mcap.writer import CompressionType, Writer

from repro import __version__
from repro.logs.format import (
    CDR_LITTLE_ENDIAN,
    ENCODING,
    PARAMETERS,
    PROFILE,
    PROVENANCE,
    SCHEMA_ENCODING,
    Log,
    payload_dtype,
    schema_name,
    schema_text,
)

CHUNK_BYTES = 1 << 20
TRIALS_A_BLOCK = 50  # topics alternate in blocks of trials, so that a player finds them together


def write_log(path: str | Path, log: Log, period: float) -> None:
    """Write `log` with `period` seconds of log clock a step; the file appears whole or not at all."""
    part = Path(f"{path}.part")
    with part.open("wb") as stream:
        writer = Writer(
            stream,
            chunk_size=CHUNK_BYTES,
            compression=CompressionType.ZSTD,
            enable_data_crcs=True,
        )
        writer.start(profile=PROFILE, library=f"repro {__version__}")
        writer.add_metadata(
            PROVENANCE,
            {
                "study": log.study,
                "point": log.point,
                "root_seed": str(log.seed),
                "first_trial": str(log.trials[0]),
                "trials": str(len(log.trials)),
                "period_s": repr(period),
            },
        )
        writer.add_attachment(
            create_time=0,
            log_time=0,
            name=PARAMETERS,
            media_type="application/json",
            data=json.dumps(log.parameters, sort_keys=True, indent=1).encode(),
        )
        _write_messages(writer, log, round(period * 1e9))
        writer.finish()
    os.replace(part, path)


def _write_messages(writer: Writer, log: Log, period_ns: int) -> None:
    channels = {}
    for topic, fields in log.fields.items():
        schema = writer.register_schema(
            schema_name(log.study, topic), SCHEMA_ENCODING, schema_text(fields)
        )
        channels[topic] = writer.register_channel(topic, ENCODING, schema)
    steps = max(values.shape[1] for values in log.values.values())
    for first in range(0, len(log.trials), TRIALS_A_BLOCK):
        block = slice(first, first + TRIALS_A_BLOCK)
        for topic, values in log.values.items():
            _write_block(writer, channels[topic], log.trials[block], values[block], steps, period_ns)
            writer.flush()  # a chunk holds one topic: the reader takes it as one array


def _write_block(writer, channel, trials, values, steps, period_ns) -> None:
    count, fields = values.shape[1:]
    payload = np.empty((len(trials), count), dtype=payload_dtype(fields))
    payload["cdr"] = CDR_LITTLE_ENDIAN
    payload["trial"] = trials[:, None]
    payload["step"] = np.arange(count)
    payload["values"] = values
    sequence = (trials[:, None] * count + np.arange(count)).ravel().tolist()
    times = ((trials[:, None] * steps + np.arange(count)) * period_ns).ravel().tolist()
    size = payload.dtype.itemsize
    data = payload.tobytes()
    add = writer.add_message
    for i, (number, time) in enumerate(zip(sequence, times, strict=True)):
        add(channel, time, data[i * size : (i + 1) * size], time, number)
