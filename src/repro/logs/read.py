"""Reading a log of this project into arrays, with every check against a wrong number."""

from collections.abc import Iterable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from repro import plugins
from repro.logs.content import Content, json_object
from repro.logs.format import (
    CDR_LITTLE_ENDIAN,
    ENCODING,
    PARAMETERS,
    PROVENANCE,
    Log,
    LogError,
    record_dtype,
    schema_text,
)
from repro.logs.head import read_head
from repro.logs.topics import Topic, arrange, read_topics
from repro.origin import check_origin
from repro.parameters.values import PointParameters


def read_log(
    path: str | Path,
    fields: Mapping[str, tuple[str, ...]] | None = None,
    study: str | None = None,
    point: str | None = None,
    origin: str | None = None,
) -> Log:
    """Read a log and check it against the expected topics, study, point and origin, where given.

    What its study leaves out of logs is added. Raises LogError with one line that names the file,
    the topic and the cause: truncated or changed bytes (every CRC of the format is checked), a
    missing topic, another schema, missing or repeated steps, another study.
    """
    content = Content(path)
    provenance = _checked(path, content.provenance, study, point, origin)
    topics = fields if fields is not None else own_fields(content)
    scenario = plugins.study(provenance["study"])
    once, between = scenario.constant_topics, scenario.topics_between_steps
    trials, values = read_topics(content, topics, _topic, once, between)
    log = Log(
        study=provenance["study"],
        point=provenance["point"],
        seed=root_seed(content),
        parameters=_parameters(path, provenance["study"], content.parameters),
        trials=trials,
        fields=dict(topics),
        values=values,
    )
    left_out = log.fields == scenario.stored(log.parameters) != scenario.topics(log.parameters)
    return scenario.complete(log) if left_out else log


def read_parameters(path: str | Path, origin: str | None = None) -> PointParameters:
    """The parameters that a log was simulated with, of its study's type; reads no message.

    Raises LogError, or ReproError if the log is not of the `origin`, where given.
    """
    head = read_head(path)
    provenance = _checked(path, head.provenance, origin=origin)
    return _parameters(path, provenance["study"], head.parameters)


def logged_origin(path: str | Path) -> str:
    """Where a log says that it comes from; nothing if it does not say. Reads no message."""
    with suppress(LogError):
        return read_head(path).provenance.get("origin", "")
    return ""


def _checked(
    path: str | Path,
    provenance: Mapping[str, str] | None,
    study: str | None = None,
    point: str | None = None,
    origin: str | None = None,
) -> Mapping[str, str]:
    """What a log says of its own, if it is of the expected study, point and origin."""
    if not provenance:
        raise LogError(f"{path}: metadata '{PROVENANCE}' is missing: not a log of this project")
    for key, expected in (("study", study), ("point", point)):
        if key not in provenance:
            raise LogError(f"{path}: metadata '{PROVENANCE}': its '{key}' is missing")
        if expected is not None and provenance[key] != expected:
            raise LogError(
                f"{path}: metadata '{PROVENANCE}': the log is of {key} "
                f"'{provenance[key]}', expected is '{expected}'"
            )
    if origin is not None:
        check_origin(str(path), provenance.get("origin", ""), origin)
    return provenance


def root_seed(content: Content) -> int:
    """The root seed that a log of this project was simulated with."""
    text = (content.provenance or {}).get("root_seed", "")
    if not text.isascii() or not text.isdigit() or len(text) > 100:
        raise LogError(f"{content.path}: metadata '{PROVENANCE}': its root_seed is not an integer")
    return int(text)


def _parameters(path: str | Path, study: str, plain: dict[str, Any]) -> PointParameters:
    """The parameters that a log was simulated with, as its study types them."""
    return plugins.study(study).Parameters.checked(plain, f"{path}: {PARAMETERS}")


def own_fields(content: Content) -> dict[str, tuple[str, ...]]:
    """Topics and fields as the log's own schemas give them."""
    fields = {}
    for topic in content.channels:
        _, schema = content.channel(topic)
        try:
            lines = schema.data.decode().split("\n") if schema else []
        except UnicodeDecodeError:
            raise LogError(f"{content.path}: topic {topic}: its schema is not UTF-8") from None
        fields[topic] = tuple(line.split()[1] for line in lines if line.startswith("float64 "))
    return fields


def _topic(content: Content, topic: str, fields: tuple[str, ...]) -> Topic:
    """Trials (ascending) and values (trials, messages a trial, fields) of a topic."""
    where = f"{content.path}: topic {topic}"
    channel, schema = content.channel(topic)
    if channel.message_encoding == "json":
        return arrange(where, *_from_json(content, where, channel.id, fields))
    if channel.message_encoding != ENCODING or schema is None:
        raise LogError(f"{where}: encoding '{channel.message_encoding}': it must be cdr or json")
    if schema.data != schema_text(fields):
        raise LogError(
            f"{where}: wrong schema '{schema.name}': the expected fields are "
            f"trial, step, {', '.join(fields)}"
        )
    return arrange(where, *_from_cdr(content.runs[channel.id], where, len(fields)))


# Trial and step of each message, (messages,), and its values, (messages, fields).
Messages = tuple[np.ndarray, np.ndarray, np.ndarray]


def _from_cdr(runs: Iterable[np.ndarray], where: str, fields: int) -> Messages:
    """From runs of records as bytes, (messages, size)."""
    dtype, payloads = record_dtype(fields), []
    for run in runs:
        if run.shape[1] != dtype.itemsize:
            raise LogError(f"{where}: messages of another size than their schema says")
        payloads.append(run.view(dtype)[:, 0]["payload"])
        if not (payloads[-1]["cdr"] == CDR_LITTLE_ENDIAN).all():
            raise LogError(f"{where}: messages are not little-endian cdr")
    trial, step, values = (
        np.concatenate([payload[name] for payload in payloads])
        for name in ("trial", "step", "values")
    )
    return trial, step, values


def _from_json(content: Content, where: str, channel: int, fields: tuple[str, ...]) -> Messages:
    payloads, _ = content.messages(channel)
    rows = [json_object(where, payload) for payload in payloads]
    try:
        table = np.array(
            [[row[name] for name in ("trial", "step", *fields)] for row in rows], float
        )
    except KeyError as error:
        raise LogError(f"{where}: a message lacks the field {error}") from None
    except (TypeError, ValueError, OverflowError):
        raise LogError(f"{where}: a field is not a number") from None
    return table[:, 0], table[:, 1], table[:, 2:]
