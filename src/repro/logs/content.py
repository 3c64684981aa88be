"""The content of an MCAP file, checked: records, and messages in runs of equal size."""

import io
import json
import struct
import zlib
from pathlib import Path
from typing import Any, NoReturn

import numpy as np
import zstandard
from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.records import Attachment, Channel, Chunk, Footer, McapRecord, Metadata, Schema

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
    record_head_dtype,
)

CHANNEL_ID = struct.Struct("<H")
CHUNK_HEAD = struct.Struct("<QQQII")  # times, uncompressed size, CRC, length of compression
CHUNK_LENGTH = struct.Struct("<Q")  # of its messages, compressed
MESSAGE_HEAD = record_dtype(0).itemsize - payload_dtype(0).itemsize  # bytes before a payload
LOG_TIME = RECORD_HEAD.size + 6  # its offset in a message record, after channel and sequence
AHEAD = 16  # times as many messages are looked at as are known to be alike
NAMED = 20  # topics of a log that a message names


class MissingError(LogError):
    """A topic or a field that the log does not have."""


class Content:
    """The records of a log, its messages as runs of equal size."""

    def __init__(self, path: str | Path, largest: int | None = None, most: int | None = None):
        """`largest` bounds the bytes of the file, and of its chunks when decompressed.

        `most` bounds the number of its messages, on all topics.
        """
        self.path = path
        self._largest, self._decompressed = largest, 0
        self._most, self._messages = most, 0
        self._same_topic: dict[str, set[int]] = {}  # numbers of the channels of a topic
        self.schemas: dict[int, Schema] = {}
        self.channels: dict[str, Channel] = {}
        self.runs: dict[int, list[np.ndarray]] = {}  # raw records by channel, (messages, bytes)
        self.provenance: dict[str, str] | None = None
        self.parameters: dict = {}
        self._closed: set[Opcode] = set()
        self._zstd = zstandard.ZstdDecompressor()
        try:
            self._check_size(Path(path).stat().st_size)
            data = Path(path).read_bytes()
        except OSError as error:
            raise LogError(f"{path}: the log cannot be read: {error.strerror}") from None
        try:
            self._read(data)
        except LogError:
            raise
        # Changed bytes can raise anything in the parser; it always means the same.
        except Exception as error:
            raise LogError(
                f"{path}: the log is truncated or changed ({type(error).__name__}: {error}; "
                f"topics up to there: {self._topics()}): generate it again"
            ) from None

    def _read(self, data: bytes) -> None:
        if not (data.startswith(MAGIC) and data.endswith(MAGIC)):
            raise ValueError("no MCAP magic at both ends")
        self._walk(data, len(MAGIC), len(data) - len(MAGIC))
        if self._closed != {Opcode.DATA_END, Opcode.FOOTER}:
            raise ValueError("no end of the data section, or no footer")

    def _walk(self, data: bytes, position: int, stop: int) -> None:
        """Read the records of a file or chunk; messages in runs of one channel and size."""
        while position < stop:
            opcode, length = RECORD_HEAD.unpack_from(data, position)
            body, end = position + RECORD_HEAD.size, position + RECORD_HEAD.size + length
            if end > stop:
                raise ValueError("a record reaches past the end")
            if opcode == Opcode.MESSAGE:
                run = _equal_records(data, position, end, stop)
                (channel,) = CHANNEL_ID.unpack_from(data, body)
                self.runs.setdefault(channel, []).append(run)
                self._count(len(run))
                end = position + run.size
            elif opcode == Opcode.DATA_END:
                (crc,) = CRC.unpack_from(data, body)
                if crc not in (0, zlib.crc32(memoryview(data)[:position])):
                    raise ValueError("CRC of the data section")
                self._closed.add(Opcode.DATA_END)
            elif opcode == Opcode.FOOTER:
                _check_summary(data, Footer.read(stream_of(data, body, end)), end - CRC.size)
                self._closed.add(Opcode.FOOTER)
            elif opcode == Opcode.CHUNK:
                self._walk_chunk(_chunk(memoryview(data)[body:end]))
            elif opcode in READ:
                self._keep(READ[opcode](stream_of(data, body, end)))
            position = end

    def _walk_chunk(self, chunk: Chunk) -> None:
        self._decompressed += max(chunk.uncompressed_size, len(chunk.data))
        self._check_size(self._decompressed)
        data = _decompressed(chunk, self._zstd)
        self._walk(data, 0, len(data))

    def _keep(self, record: McapRecord) -> None:
        match record:
            case Schema():
                if self.schemas.setdefault(record.id, record) != record:
                    raise ValueError(f"two schemas have the number {record.id}")
            case Channel():
                if record.id in self._same_topic.get(record.topic, ()):
                    return  # repeated, as in the summary
                if any(record.id in numbers for numbers in self._same_topic.values()):
                    raise ValueError(f"two topics have the channel {record.id}")
                self._same_topic.setdefault(record.topic, set()).add(record.id)
                self.channels[record.topic] = record
            case Metadata(name=name) if name == PROVENANCE:
                self.provenance = record.metadata
            case Attachment(name=name) if name == PARAMETERS:
                self.parameters = json.loads(record.data)

    def _check_size(self, size: int) -> None:
        if self._largest is not None and size > self._largest:
            self._refuse(
                f"{size / 2**20:.0f} MB of records, at most {self._largest / 2**20:.0f} MB"
            )

    def _count(self, messages: int) -> None:
        self._messages += messages
        if self._most is not None and self._messages > self._most:
            self._refuse(f"at most {self._most} messages")

    def _refuse(self, bound: str) -> NoReturn:
        raise LogError(
            f"{self.path}: too large: {bound} are read; record only the topics of the study"
        )

    def _topics(self) -> str:
        """The topics of the log, or the first of them."""
        names = sorted(self.channels)
        more = f" and {len(names) - NAMED} more" if len(names) > NAMED else ""
        return (", ".join(names[:NAMED]) or "none") + more

    def has(self, topic: str) -> bool:
        """Whether the topic has messages."""
        return any(number in self.runs for number in self._same_topic.get(topic, ()))

    def channel(self, topic: str) -> tuple[Channel, Schema | None]:
        """Channel and schema of a topic; LogError if it has no messages, or several channels."""
        if not self.has(topic):
            raise MissingError(
                f"{self.path}: topic {topic}: missing; topics of the log: {self._topics()}"
            )
        numbers = self._same_topic[topic]
        if len(numbers) > 1:
            raise LogError(
                f"{self.path}: topic {topic}: it has {len(numbers)} channels; record it from one "
                "publisher, or merge them"
            )
        channel = self.channels[topic]
        return channel, self.schemas.get(channel.schema_id)

    def messages(self, channel: int) -> tuple[list[bytes], np.ndarray]:
        """Payloads of a channel's messages, of any sizes, and their log times in ns."""
        runs = self.runs[channel]
        payloads = [row.tobytes() for run in runs for row in run[:, MESSAGE_HEAD:]]
        return payloads, np.concatenate([_log_times(run) for run in runs])


def json_object(where: str, payload: bytes) -> dict[str, Any]:
    """A message decoded from JSON."""
    try:
        row = json.loads(payload)
    except ValueError as error:
        raise LogError(f"{where}: a message is not JSON: {error}") from None
    except RecursionError:
        raise LogError(f"{where}: a message is nested too deeply") from None
    if not isinstance(row, dict):
        raise LogError(f"{where}: a message is not a JSON object")
    return row


def _log_times(records: np.ndarray) -> np.ndarray:
    """Log times of message records given as bytes, in ns."""
    return np.ascontiguousarray(records[:, LOG_TIME : LOG_TIME + 8]).view("<u8")[:, 0]


def _chunk(body: memoryview) -> Chunk:
    """A chunk record; unlike mcap's own function it does not copy the bytes of the messages."""
    start, end, size, crc, name = CHUNK_HEAD.unpack_from(body)
    compression = bytes(body[CHUNK_HEAD.size : CHUNK_HEAD.size + name]).decode()
    (length,) = CHUNK_LENGTH.unpack_from(body, CHUNK_HEAD.size + name)
    begin = CHUNK_HEAD.size + name + CHUNK_LENGTH.size
    if begin + length > len(body):
        raise ValueError("the messages of a chunk reach past its end")
    data: Any = body[begin : begin + length]  # a view, where Chunk has bytes
    return Chunk(compression, data, end, start, crc, size)


def _decompressed(chunk: Chunk, zstd: zstandard.ZstdDecompressor) -> bytes:
    """The records of a chunk, which must be of the size and CRC that it states.

    Never more bytes than that, unlike mcap's own function: a small file may hold gigabytes.
    """
    size = chunk.uncompressed_size
    if chunk.compression == "zstd":
        if zstandard.frame_content_size(chunk.data) not in (-1, size):
            raise ValueError("a chunk of another size than it states")
        data = zstd.decompress(chunk.data, max_output_size=size) if size else b""
    elif chunk.compression == "lz4":
        from lz4.frame import LZ4FrameDecompressor  # of foreign logs only

        data = LZ4FrameDecompressor().decompress(chunk.data, max_length=size + 1)
    else:
        data = chunk.data
    if len(data) != size:
        raise ValueError("a chunk of another size than it states")
    if chunk.uncompressed_crc and chunk.uncompressed_crc != zlib.crc32(data):
        raise ValueError("CRC of a chunk")
    return data


READ = {  # the records that are read; the indexes are for players
    Opcode.SCHEMA: Schema.read,
    Opcode.CHANNEL: Channel.read,
    Opcode.METADATA: Metadata.read,
    Opcode.ATTACHMENT: Attachment.read,
}


def stream_of(data: bytes, start: int, end: int) -> ReadDataStream:
    """What the functions of `READ` take."""
    return ReadDataStream(io.BytesIO(data[start:end]))


def _equal_records(data: bytes, start: int, end: int, stop: int) -> np.ndarray:
    """The run of records from `start` with the opcode, length and channel of the first."""
    size = end - start
    fitting = (stop - start) // size
    table = np.frombuffer(data, np.uint8, fitting * size, start).reshape(fitting, size)
    heads = np.frombuffer(data, record_head_dtype(size), fitting, start)
    opcode_and_length, channel = heads["opcode_and_length"], heads["channel"]
    ahead = 1
    while ahead < fitting:  # farther and farther: messages of mixed sizes cost linear time
        some = slice(ahead, AHEAD * ahead)
        same = (opcode_and_length[some] == opcode_and_length[0]) & (channel[some] == channel[0])
        if not same.all():
            return table[: ahead + int(same.argmin())]
        ahead *= AHEAD
    return table


def _check_summary(data: bytes, footer: Footer, end: int) -> None:
    """Check the CRC from the summary's start to the CRC itself, the last field of the footer."""
    start = footer.summary_start or end - FOOTER_HEAD
    if footer.summary_crc not in (0, zlib.crc32(memoryview(data)[start:end])):
        raise ValueError("CRC of the summary section")
