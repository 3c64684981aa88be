"""Logs recorded elsewhere: any MCAP with a study's topics, as JSON or as flat cdr messages."""

import re
from pathlib import Path
from typing import Any

import numpy as np

from repro.logs.content import MESSAGE_HEAD, Content, arrange, log_times
from repro.logs.format import CDR_LITTLE_ENDIAN, ENCODING, Log, LogError

# ros2msg types of fixed size, all that a flat message is made of.
TYPES = {
    "bool": "?",
    "byte": "u1",
    "char": "u1",
    "int8": "i1",
    "uint8": "u1",
    "int16": "<i2",
    "uint16": "<u2",
    "int32": "<i4",
    "uint32": "<u4",
    "int64": "<i8",
    "uint64": "<u8",
    "float32": "<f4",
    "float64": "<f8",
}
FIELD = re.compile(r"^\s*(?P<type>[A-Za-z0-9_/]+)\s+(?P<name>[A-Za-z][A-Za-z0-9_]*)\s*(#.*)?$")
COUNTERS = ("trial", "step")


def read_foreign(
    path: str | Path, fields: dict[str, tuple[str, ...]], study: str, point: str, parameters: Any
) -> Log:
    """Read the wanted topics and fields; other topics and fields may stand beside them.

    Messages without the fields trial and step are the steps of trial 0 in the order of log time.
    /truth may be missing. Raises LogError in one line.
    """
    content = Content(path)
    present = {t: names for t, names in fields.items() if t != "/truth" or t in content.channels}
    trials, values = None, {}
    for topic, names in present.items():
        found, values[topic] = _topic(content, topic, names)
        if trials is not None and not np.array_equal(found, trials):
            raise LogError(f"{path}: topic {topic}: other trials than the topics before it")
        trials = found
    return Log(study, point, 0, parameters, trials, present, values)


def _topic(content: Content, topic: str, names: tuple[str, ...]) -> tuple[np.ndarray, np.ndarray]:
    where = f"{content.path}: topic {topic}"
    channel, schema = content.channel(topic)
    if channel.message_encoding == "json":
        rows, time = content.json_rows(where, channel.id)
        known = set.intersection(*(set(row) for row in rows))
        columns = {name: [row[name] for row in rows] for name in known}
    elif channel.message_encoding == ENCODING and schema is not None:
        records = content.records(where, channel.id)
        table, time = _decoded(records, where, schema.data.decode()), log_times(records)
        columns = {name: table[name] for name in table.dtype.names}
    else:
        raise LogError(f"{where}: encoding '{channel.message_encoding}': cdr or json is read")
    missing = [name for name in names if name not in columns]
    if missing:
        raise LogError(f"{where}: the field '{missing[0]}' is missing")
    try:
        values = np.stack([np.asarray(columns[name], dtype=float) for name in names], axis=-1)
        if not set(COUNTERS) <= set(columns):
            order = np.argsort(time, kind="stable")
            return arrange(where, np.zeros(len(order), int), np.arange(len(order)), values[order])
        trial, step = (np.asarray(columns[name], dtype=float).astype(int) for name in COUNTERS)
    except (TypeError, ValueError):
        raise LogError(f"{where}: a field is not a number") from None
    return arrange(where, trial, step, values)


def _decoded(records: np.ndarray, where: str, text: str) -> np.ndarray:
    dtype, head = flat_dtype(where, text), len(CDR_LITTLE_ENDIAN)
    payload = records[:, MESSAGE_HEAD:]
    if payload.shape[1] != head + dtype.itemsize:
        raise LogError(f"{where}: messages of another size than their schema says")
    if not (payload[:, :head] == CDR_LITTLE_ENDIAN).all():
        raise LogError(f"{where}: messages are not little-endian cdr")
    return np.ascontiguousarray(payload[:, head:]).view(dtype)[:, 0]


def flat_dtype(where: str, text: str) -> np.dtype:
    """Layout of a flat cdr message from its ros2msg text; every field is aligned to its size."""
    names, formats, offsets, end = [], [], [], 0
    for line in text.split("===")[0].splitlines():
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        field = FIELD.match(line)
        if field is None or field["type"] not in TYPES:
            raise LogError(f"{where}: '{line.strip()}' is no scalar of fixed size")
        if field["name"] in names:
            raise LogError(f"{where}: the field '{field['name']}' stands twice in its schema")
        size = np.dtype(TYPES[field["type"]]).itemsize
        start = -(-end // size) * size
        names.append(field["name"])
        formats.append(TYPES[field["type"]])
        offsets.append(start)
        end = start + size
    if not names:
        raise LogError(f"{where}: its schema has no field")
    return np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": end})
