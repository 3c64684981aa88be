"""Logs recorded elsewhere: any MCAP with a study's topics and fields, as JSON or as ROS 2 cdr."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from mcap.records import Schema
from mcap_ros2.decoder import DecoderFactory

from repro.logs.content import Content, Topic, arrange, json_object, read_topics
from repro.logs.format import ENCODING, SCHEMA_ENCODING, Log, LogError
from repro.parameters.values import PointParameters

COUNTERS = ("trial", "step")
PLAIN_CDR = (0, 1)  # encapsulation kinds: big-endian, little-endian


def read_user_log(
    path: str | Path,
    fields: Mapping[str, tuple[str, ...]],
    study: str,
    point: str,
    parameters: PointParameters,
) -> Log:
    """Read the topics and scalar fields of a study; the log may have any others besides.

    Messages without the fields trial and step are the steps of trial 0 in the order of log time.
    /truth may be missing. Raises LogError in one line.
    """
    content = Content(path)
    present = {t: names for t, names in fields.items() if t != "/truth" or t in content.channels}
    trials, values = read_topics(content, present, _topic)
    return Log(study, point, 0, parameters, trials, present, values)


def _topic(content: Content, topic: str, names: tuple[str, ...]) -> Topic:
    """Trials (ascending) and values (trials, messages a trial, fields) of a topic."""
    where = f"{content.path}: topic {topic}"
    channel, schema = content.channel(topic)
    decode = _decoder(where, channel.message_encoding, schema)
    payloads, times = content.messages(channel.id)
    rows = [decode(payload) for payload in payloads]
    values = np.stack([_column(where, rows, name) for name in names], axis=-1)
    if any(counter not in row for row in rows for counter in COUNTERS):
        order = np.argsort(times, kind="stable")
        return arrange(where, np.zeros(len(order), int), np.arange(len(order)), values[order])
    trial, step = (_column(where, rows, counter) for counter in COUNTERS)
    return arrange(where, trial, step, values)


def _column(where: str, rows: list[dict[str, Any]], name: str) -> np.ndarray:
    """One field of every message, (messages,)."""
    column = [row.get(name) for row in rows]
    if None in column and any(name not in row for row in rows):
        raise LogError(f"{where}: the field '{name}' is missing")
    if not all(isinstance(value, int | float) for value in column):
        raise LogError(f"{where}: the field '{name}' is not a number")
    try:
        return np.array(column, dtype=float)
    except OverflowError:
        raise LogError(f"{where}: the field '{name}' has a number that is too large") from None


def _decoder(where: str, encoding: str, schema: Schema | None) -> Callable[[bytes], dict[str, Any]]:
    """The function that makes the fields of a message out of its bytes."""
    if encoding == "json":
        return lambda payload: json_object(where, payload)
    if encoding != ENCODING or schema is None or schema.encoding != SCHEMA_ENCODING:
        raise LogError(
            f"{where}: encoding '{encoding}': it must be json, or cdr with a ros2msg schema"
        )
    try:
        decode_cdr = DecoderFactory().decoder_for(encoding, schema)
    # Its parser has no error of its own: a bad schema can raise anything.
    except Exception as error:
        raise LogError(f"{where}: its schema is not ros2msg: {_named(error)}") from None
    assert decode_cdr is not None  # the encodings are checked above

    def decode(payload: bytes) -> dict[str, Any]:
        if len(payload) < 2 or payload[1] not in PLAIN_CDR:
            raise LogError(f"{where}: a message is not plain cdr")
        try:
            message = decode_cdr(payload)
            return {name: getattr(message, name) for name in message.__slots__}
        except Exception as error:  # as of a schema
            raise LogError(f"{where}: a message does not fit its schema: {_named(error)}") from None

    return decode


def _named(error: Exception) -> str:
    return f"{type(error).__name__}: {error}"
