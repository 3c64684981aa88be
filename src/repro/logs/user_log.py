"""Logs recorded elsewhere: any MCAP with a study's topics and fields, as JSON or as ROS 2 cdr."""

from collections.abc import Callable, Collection, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from mcap.records import Schema
from mcap_ros2.decoder import DecoderFactory

from repro import plugins
from repro.logs.content import Content, MissingError, json_object
from repro.logs.format import ENCODING, PROVENANCE, SCHEMA_ENCODING, Log, LogError, selected
from repro.logs.read import own_fields, read_log, root_seed
from repro.logs.topics import Topic, arrange, read_topics
from repro.parameters.values import PointParameters

COUNTERS = ("trial", "step")
PLAIN_CDR = (0, 1)  # encapsulation kinds: big-endian, little-endian
# Of a log, which bound the time and memory of reading it: about a minute, and two GB.
LARGEST = 2**29  # bytes, decompressed
MOST = 2_000_000  # messages
# Parameters in which a log of the pipeline may differ from what a filter is told.
OF_THE_LOG = {"trials", "steps"}

Row = dict[str, Any]  # a decoded message


def read_user_log(
    path: str | Path,
    fields: Mapping[str, tuple[str, ...]],
    study: str,
    point: str,
    parameters: PointParameters,
    *,
    once: Collection[str] = (),
    reasons: Mapping[str, str] | None = None,
    seed: int = 0,
    changed: Collection[str] = (),
) -> Log:
    """Read the topics and fields of a study; the log may have any others besides.

    Messages without the fields trial and step are the steps of trial 0 in the order of log time.
    /truth may be missing, unless a reason needs it. Topics of `once` have one message a trial.
    `reasons` say, by topic, what it is needed for. A log of this project has its own root seed,
    else it is `seed`; `changed` are parameters in which it may differ. Raises LogError in one line.
    """
    content = Content(path, LARGEST, MOST)
    reasons = reasons or {}
    provenance = content.provenance
    if provenance is not None:
        _check_origin(content, provenance, study, point, parameters, changed)
        seed = root_seed(content)
    scenario = plugins.study(study)
    stored = scenario.stored(parameters)
    if provenance is not None and own_fields(content) == stored != scenario.topics(parameters):
        own = read_log(path)  # which adds what this project's logs leave out
        return selected(own._replace(parameters=parameters), dict(fields))
    present = {
        topic: names
        for topic, names in fields.items()
        if topic != "/truth" or topic in reasons or content.has(topic)
    }

    def with_reason(content: Content, topic: str, names: tuple[str, ...]) -> Topic:
        try:
            return _topic(content, topic, names)
        except MissingError as error:
            raise LogError(f"{error}{reasons.get(topic, '')}") from None

    trials, values = read_topics(content, present, with_reason, once)
    return Log(study, point, seed, parameters, trials, present, values)


def _check_origin(
    content: Content,
    provenance: Mapping[str, str],
    study: str,
    point: str,
    parameters: PointParameters,
    changed: Collection[str],
) -> None:
    """Raise LogError for a log of this project that is of another point, or of other values."""
    for key, expected in (("study", study), ("point", point)):
        if provenance.get(key) != expected:
            raise LogError(
                f"{content.path}: metadata '{PROVENANCE}': the log is of {key} "
                f"'{provenance.get(key)}', expected is '{expected}'"
            )
    own = content.parameters if isinstance(content.parameters, dict) else {}
    plain = parameters.plain()
    for name in sorted((own.keys() & plain.keys()) - OF_THE_LOG - set(changed)):
        if own[name] != plain[name]:
            raise LogError(
                f"{content.path}: it was simulated with another {name} than the point has: give "
                "the value that the filter shall assume with --config parameters=FILE"
            )


def _topic(content: Content, topic: str, names: tuple[str, ...]) -> Topic:
    """Trials (ascending) and values (trials, messages a trial, fields) of a topic."""
    where = f"{content.path}: topic {topic}"
    channel, schema = content.channel(topic)
    decode = _decoder(where, channel.message_encoding, schema)
    payloads, times = content.messages(channel.id)
    table, counters = [], []
    for payload in payloads:
        row = decode(payload)
        table.append([_number(where, row, name) for name in names])
        counters.append([_number(where, row, name) for name in COUNTERS if name in row])
    counted = {len(found) for found in counters}
    if counted == {0}:
        values = np.array(table, dtype=float)[np.argsort(times, kind="stable")]
        trial, step = np.zeros(len(values), int), np.arange(len(values))
    elif counted == {2}:
        values = np.array(table, dtype=float)
        trial, step = np.array(counters, dtype=float).T
    else:
        raise LogError(
            f"{where}: 'trial' without 'step', or 'step' without 'trial': give both in every "
            "message, or neither"
        )
    return arrange(where, trial, step, values)


def _number(where: str, row: Row, name: str) -> float:
    """A field of a message, as a number."""
    value = row[name] if name in row else _nested(where, row, name)
    if not isinstance(value, int | float):
        raise LogError(f"{where}: the field '{name}' is not a number")
    try:
        return float(value)
    except OverflowError:
        raise LogError(f"{where}: the field '{name}' has a number that is too large") from None


def _nested(where: str, row: Row, name: str) -> Any:
    """The one field of this name in the messages inside a message."""
    found, open_ = {}, [("", row)]
    while open_:
        path, members = open_.pop()
        for key, value in members.items():
            inner = _members(value)
            if inner is not None:
                open_.append((f"{path}{key}.", inner))
            elif key == name:
                found[f"{path}{key}"] = value
    if not found:
        raise MissingError(f"{where}: the field '{name}' is missing")
    if len(found) > 1:
        raise LogError(f"{where}: the field '{name}' may be {' or '.join(sorted(found))}: keep one")
    (value,) = found.values()
    return value


def _members(value: Any) -> Row | None:
    """The fields of a message; None of anything else. Arrays are not looked into."""
    if isinstance(value, dict):
        return value
    slots = getattr(value, "__slots__", None)
    return None if slots is None else {name: getattr(value, name) for name in slots}


def _decoder(where: str, encoding: str, schema: Schema | None) -> Callable[[bytes], Row]:
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

    def decode(payload: bytes) -> Row:
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
