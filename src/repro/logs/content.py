"""The content of an MCAP file, checked: records, and messages in runs of equal size."""

import io
import json
import struct
import zlib
from pathlib import Path

import numpy as np
from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.records import Attachment, Channel, Chunk, Footer, Metadata, Schema
from mcap.stream_reader import get_chunk_data_stream

from repro.logs.format import (
    CRC,
    FOOTER_HEAD,
    MAGIC,
    PARAMETERS,
    PROVENANCE,
    RECORD_HEAD,
    LogError,
    payload_dtype,
    record_dtype,
)

CHANNEL_ID = struct.Struct("<H")
MESSAGE_HEAD = record_dtype(0).itemsize - payload_dtype(0).itemsize  # bytes before a payload
LOG_TIME = record_dtype(0).fields["log_time"][1]  # its offset in a message record


class Content:
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

    def _read(self, data: bytes) -> None:
        if not (data.startswith(MAGIC) and data.endswith(MAGIC)):
            raise ValueError("no MCAP magic at both ends")
        self._walk(data, len(MAGIC), len(data) - len(MAGIC))
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

    def channel(self, topic: str) -> tuple[Channel, Schema | None]:
        """Channel and schema of a topic; LogError if it has no messages."""
        channel = self.channels.get(topic)
        if channel is None or channel.id not in self.runs:
            known = ", ".join(self.channels) or "no topic"
            raise LogError(f"{self.path}: topic {topic}: missing; the log has {known}")
        return channel, self.schemas.get(channel.schema_id)

    def records(self, where: str, channel: int) -> np.ndarray:
        """Message records of a channel as bytes, (messages, size), all of one size."""
        runs = self.runs[channel]
        if any(run.shape[1] != runs[0].shape[1] for run in runs):
            raise LogError(f"{where}: messages of different sizes")
        return np.concatenate(runs) if len(runs) > 1 else runs[0]

    def json_rows(self, where: str, channel: int) -> tuple[list[dict], np.ndarray]:
        """Messages of a channel decoded from JSON, and their log times."""
        records = [record for run in self.runs[channel] for record in run]
        try:
            rows = [json.loads(record[MESSAGE_HEAD:].tobytes()) for record in records]
        except ValueError as error:
            raise LogError(f"{where}: a message is not JSON: {error}") from None
        if not all(isinstance(row, dict) for row in rows):
            raise LogError(f"{where}: a message is not a JSON object")
        return rows, np.array([log_times(record[None])[0] for record in records])


def log_times(records: np.ndarray) -> np.ndarray:
    """Log times of message records given as bytes, in ns."""
    return np.ascontiguousarray(records[:, LOG_TIME : LOG_TIME + 8]).view("<u8")[:, 0]


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


def arrange(where: str, trial: np.ndarray, step: np.ndarray, values: np.ndarray):
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
