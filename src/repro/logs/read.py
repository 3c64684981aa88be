"""Reading a log into arrays at once, with every check that a wrong number would slip through."""

import io
import json
import struct
import zlib
from pathlib import Path

import numpy as np
from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.records import Attachment, Channel, Chunk, Footer, Metadata, Schema
from mcap.stream_reader import MAGIC_SIZE, get_chunk_data_stream
from mcap.writer import MCAP0_MAGIC

from repro.logs.format import (
    CDR_LITTLE_ENDIAN,
    CRC,
    ENCODING,
    FOOTER_HEAD,
    PARAMETERS,
    PROVENANCE,
    RECORD_HEAD,
    Log,
    LogError,
    payload_dtype,
    record_dtype,
    schema_text,
)

CHANNEL_ID = struct.Struct("<H")


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
    content = _Content(path)
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
    topics = fields if fields is not None else content.own_fields()
    trials, values = None, {}
    for topic, names in topics.items():
        found, values[topic] = content.topic(topic, names)
        if trials is not None and not np.array_equal(found, trials):
            raise LogError(f"{path}: topic {topic}: other trials than the topics before it")
        trials = found
    return Log(
        study=content.provenance["study"],
        point=content.provenance["point"],
        seed=int(content.provenance["root_seed"]),
        parameters=content.parameters,
        trials=trials,
        fields=dict(topics),
        values=values,
    )


class _Content:
    """The records of a log, its messages as runs of equal size."""

    def __init__(self, path: str | Path):
        self.path = path
        self.schemas: dict[int, Schema] = {}
        self.channels: dict[str, Channel] = {}
        self.runs: dict[int, list[np.ndarray]] = {}  # raw records by channel, (messages, bytes)
        self.provenance: dict[str, str] | None = None
        self.parameters: dict = {}
        self._closed: set[Opcode] = set()
        try:
            data = Path(path).read_bytes()
        except OSError as error:
            raise LogError(f"{path}: the log cannot be read: {error.strerror}") from None
        try:
            self._read(data)
        # Changed bytes can raise anything in a parser; all of it means the same here.
        except Exception as error:
            known = ", ".join(self.channels) or "none"
            raise LogError(
                f"{path}: topics that were begun ({known}): the log is truncated or changed "
                f"({type(error).__name__}: {error}): generate it again"
            ) from None
        if self.provenance is None:
            raise LogError(f"{path}: metadata '{PROVENANCE}' is missing: not a log of this project")

    def _read(self, data: bytes) -> None:
        if data[:MAGIC_SIZE] != MCAP0_MAGIC or data[-MAGIC_SIZE:] != MCAP0_MAGIC:
            raise ValueError("no MCAP magic at both ends")
        self._walk(data, MAGIC_SIZE, len(data) - MAGIC_SIZE)
        if self._closed != {Opcode.DATA_END, Opcode.FOOTER}:
            raise ValueError("no end of the data section, or no footer")

    def _walk(self, data: bytes, position: int, stop: int) -> None:
        """Take in the records of a file or of a chunk; messages in runs of one channel and size."""
        while position < stop:
            opcode, length = RECORD_HEAD.unpack_from(data, position)
            body, end = position + RECORD_HEAD.size, position + RECORD_HEAD.size + length
            if end > stop:
                raise ValueError("a record reaches past the end")
            if opcode == Opcode.MESSAGE:
                run = _equal_records(data, position, end, stop)
                (channel,) = CHANNEL_ID.unpack_from(data, body)
                self.runs.setdefault(channel, []).append(run)
                end = position + run.size
            elif opcode == Opcode.DATA_END:
                (crc,) = CRC.unpack_from(data, body)
                if crc not in (0, zlib.crc32(memoryview(data)[:position])):
                    raise ValueError("CRC of the data section")
                self._closed.add(Opcode.DATA_END)
            elif opcode == Opcode.FOOTER:
                _check_summary(data, Footer.read(_stream(data, body, end)), end - CRC.size)
                self._closed.add(Opcode.FOOTER)
            elif opcode in _READ:
                self._take(_READ[opcode](_stream(data, body, end)))
            position = end

    def _take(self, record) -> None:
        match record:
            case Chunk():
                stream, length = get_chunk_data_stream(record, validate_crc=True)
                self._walk(stream.read(length), 0, length)
            case Schema():
                self.schemas[record.id] = record
            case Channel():
                self.channels[record.topic] = record
            case Metadata(name=name) if name == PROVENANCE:
                self.provenance = record.metadata
            case Attachment(name=name) if name == PARAMETERS:
                self.parameters = json.loads(record.data)

    def own_fields(self) -> dict[str, tuple[str, ...]]:
        """Topics and fields as the log's own schemas give them."""
        fields = {}
        for topic, channel in self.channels.items():
            lines = self.schemas[channel.schema_id].data.decode().split("\n")
            names = [line.split()[1] for line in lines if line.startswith("float64 ")]
            fields[topic] = tuple(names)
        return fields

    def topic(self, topic: str, fields: tuple[str, ...]) -> tuple[np.ndarray, np.ndarray]:
        """Trials (ascending) and values (trials, messages a trial, fields) of a topic."""
        where = f"{self.path}: topic {topic}"
        channel = self.channels.get(topic)
        if channel is None or channel.id not in self.runs:
            raise LogError(
                f"{where}: missing; the log has {', '.join(self.channels) or 'no topic'}"
            )
        schema = self.schemas.get(channel.schema_id)
        if channel.message_encoding == "json":
            trial, step, values = self._from_json(where, channel.id, fields)
        elif channel.message_encoding != ENCODING or schema is None:
            raise LogError(f"{where}: encoding '{channel.message_encoding}': cdr or json is read")
        elif schema.data != schema_text(fields):
            raise LogError(
                f"{where}: wrong schema '{schema.name}': wanted are the fields "
                f"trial, step, {', '.join(fields)}"
            )
        else:
            trial, step, values = self._from_cdr(where, channel.id, len(fields))
        return _arrange(where, trial, step, values)

    def _from_cdr(self, where: str, channel: int, fields: int):
        dtype = record_dtype(fields)
        runs = self.runs[channel]
        if any(run.shape[1] != dtype.itemsize for run in runs):
            raise LogError(f"{where}: messages of another size than their schema says")
        table = np.concatenate(runs) if len(runs) > 1 else runs[0]
        payload = np.ascontiguousarray(table).view(dtype)[:, 0]["payload"]
        if not (payload["cdr"] == CDR_LITTLE_ENDIAN).all():
            raise LogError(f"{where}: messages are not little-endian cdr")
        return payload["trial"], payload["step"], payload["values"]

    def _from_json(self, where: str, channel: int, fields: tuple[str, ...]):
        head = record_dtype(0).itemsize - payload_dtype(0).itemsize
        rows = [json.loads(record[head:].tobytes()) for run in self.runs[channel] for record in run]
        try:
            table = np.array([[row[name] for name in ("trial", "step", *fields)] for row in rows])
        except (KeyError, TypeError) as error:
            raise LogError(f"{where}: a message lacks the field {error}") from None
        return table[:, 0].astype(int), table[:, 1].astype(int), table[:, 2:].astype(float)


_READ = {  # what is taken from a log; the indexes serve players, not this reader
    Opcode.CHUNK: Chunk.read,
    Opcode.SCHEMA: Schema.read,
    Opcode.CHANNEL: Channel.read,
    Opcode.METADATA: Metadata.read,
    Opcode.ATTACHMENT: Attachment.read,
}


def _stream(data: bytes, start: int, end: int) -> ReadDataStream:
    return ReadDataStream(io.BytesIO(data[start:end]))


def _equal_records(data: bytes, start: int, end: int, stop: int) -> np.ndarray:
    """The run of records from `start` with the opcode, length and channel of the first."""
    size = end - start
    head = np.frombuffer(data, np.uint8, RECORD_HEAD.size + CHANNEL_ID.size, start)
    whole = (stop - start) // size
    table = np.frombuffer(data, np.uint8, whole * size, start).reshape(whole, size)
    same = (table[:, : len(head)] == head).all(axis=1)
    return table if same.all() else table[: int(same.argmin())]


def _check_summary(data: bytes, footer: Footer, end: int) -> None:
    """Check the CRC from the summary's start to the CRC itself, the last field of the footer."""
    start = footer.summary_start or end - FOOTER_HEAD
    if footer.summary_crc not in (0, zlib.crc32(memoryview(data)[start:end])):
        raise ValueError("CRC of the summary section")


def _arrange(where: str, trial: np.ndarray, step: np.ndarray, values: np.ndarray):
    """Messages in the order of trial and step, complete and without repetition."""
    numbers, counts = np.unique(trial, return_counts=True)
    steps = int(counts.max())
    expected_trial = np.repeat(numbers, steps)
    expected_step = np.tile(np.arange(steps), len(numbers))
    if len(trial) != len(expected_trial):
        short = numbers[counts < steps][0]
        raise LogError(f"{where}: trial {short} has fewer than {steps} messages")
    if not (np.array_equal(trial, expected_trial) and np.array_equal(step, expected_step)):
        order = np.lexsort((step, trial))
        trial, step, values = trial[order], step[order], values[order]
        if not np.array_equal(step, expected_step):
            wrong = trial[step != expected_step][0]
            raise LogError(f"{where}: trial {wrong} has a missing or repeated step")
    return numbers.astype(int), np.ascontiguousarray(values).reshape(len(numbers), steps, -1)
