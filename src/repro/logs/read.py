"""Reading a log of this project into arrays at once, with every check against a wrong number."""

from pathlib import Path

import numpy as np

from repro import plugins
from repro.logs.content import Content, arrange
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
from repro.parameters.values import PointParameters


def read_log(
    path: str | Path,
    fields: dict[str, tuple[str, ...]] | None = None,
    study: str | None = None,
    point: str | None = None,
) -> Log:
    """Read a log and check it against the topics, study and point that are wanted, where given.

    Raises LogError with one line that names the file, the topic and the cause: truncated or
    changed bytes (every CRC of the format is checked), a missing topic, another schema, missing or
    repeated steps, another study.
    """
    content = Content(path)
    if content.provenance is None:
        raise LogError(f"{path}: metadata '{PROVENANCE}' is missing: not a log of this project")
    if study is not None and content.provenance["study"] != study:
        raise LogError(
            f"{path}: metadata '{PROVENANCE}': the log is of study "
            f"'{content.provenance['study']}', wanted is '{study}': give it a log of that study"
        )
    if point is not None and content.provenance["point"] != point:
        raise LogError(
            f"{path}: metadata '{PROVENANCE}': the log is of point "
            f"'{content.provenance['point']}', wanted is '{point}': give it a log of that point"
        )
    topics = fields if fields is not None else _own_fields(content)
    trials, values = None, {}
    for topic, names in topics.items():
        found, values[topic] = _topic(content, topic, names)
        if trials is not None and not np.array_equal(found, trials):
            raise LogError(f"{path}: topic {topic}: other trials than the topics before it")
        trials = found
    return Log(
        study=content.provenance["study"],
        point=content.provenance["point"],
        seed=int(content.provenance["root_seed"]),
        parameters=_parameters(content),
        trials=trials,
        fields=dict(topics),
        values=values,
    )


def _parameters(content: Content) -> PointParameters:
    """The parameters that the log was simulated with, as its study types them."""
    study = plugins.study(content.provenance["study"])
    return study.Parameters.checked(content.parameters, f"{content.path}: {PARAMETERS}")


def _own_fields(content: Content) -> dict[str, tuple[str, ...]]:
    """Topics and fields as the log's own schemas give them."""
    fields = {}
    for topic, channel in content.channels.items():
        lines = content.schemas[channel.schema_id].data.decode().split("\n")
        fields[topic] = tuple(line.split()[1] for line in lines if line.startswith("float64 "))
    return fields


def _topic(content: Content, topic: str, fields: tuple[str, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Trials (ascending) and values (trials, messages a trial, fields) of a topic."""
    where = f"{content.path}: topic {topic}"
    channel, schema = content.channel(topic)
    if channel.message_encoding == "json":
        return arrange(where, *_from_json(content, where, channel.id, fields))
    if channel.message_encoding != ENCODING or schema is None:
        raise LogError(f"{where}: encoding '{channel.message_encoding}': cdr or json is read")
    if schema.data != schema_text(fields):
        raise LogError(
            f"{where}: wrong schema '{schema.name}': wanted are the fields "
            f"trial, step, {', '.join(fields)}"
        )
    return arrange(where, *_from_cdr(content.records(where, channel.id), where, len(fields)))


def _from_cdr(records: np.ndarray, where: str, fields: int):
    dtype = record_dtype(fields)
    if records.shape[1] != dtype.itemsize:
        raise LogError(f"{where}: messages of another size than their schema says")
    payload = np.ascontiguousarray(records).view(dtype)[:, 0]["payload"]
    if not (payload["cdr"] == CDR_LITTLE_ENDIAN).all():
        raise LogError(f"{where}: messages are not little-endian cdr")
    return payload["trial"], payload["step"], payload["values"]


def _from_json(content: Content, where: str, channel: int, fields: tuple[str, ...]):
    rows, _ = content.json_rows(where, channel)
    try:
        table = np.array(
            [[row[name] for name in ("trial", "step", *fields)] for row in rows], float
        )
    except KeyError as error:
        raise LogError(f"{where}: a message lacks the field {error}") from None
    except (TypeError, ValueError):
        raise LogError(f"{where}: a field is not a number") from None
    return table[:, 0].astype(int), table[:, 1].astype(int), table[:, 2:]
