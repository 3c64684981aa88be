"""The MCAP file around the messages, built from the records of the mcap package.

The package's Writer takes single messages, about 3 microseconds each. Here a log is made of arrays,
so complete chunks are written instead; every record but the messages and their index is encoded by
the package.
"""

import zlib
from typing import BinaryIO

import numpy as np
import zstandard
from mcap.data_stream import RecordBuilder
from mcap.opcode import Opcode
from mcap.records import (
    Attachment,
    AttachmentIndex,
    Channel,
    Chunk,
    ChunkIndex,
    DataEnd,
    Footer,
    Header,
    McapRecord,
    Metadata,
    MetadataIndex,
    Schema,
    Statistics,
    SummaryOffset,
)

from repro.logs.format import CRC, FOOTER_HEAD, MAGIC, RECORD_HEAD, index_dtype

LEVEL = 3  # of zstd, its default: 6 makes logs a tenth smaller, in three times the time


def _bytes(record: McapRecord) -> bytes:
    builder = RecordBuilder()
    record.write(builder)
    return builder.end()


class Container:
    """An MCAP file that is being written; `finish` writes its summary."""

    def __init__(self, stream: BinaryIO, profile: str, library: str):
        self._stream, self._position, self._crc = stream, 0, 0
        self._schemas: list[Schema] = []
        self._channels: list[Channel] = []
        self._chunks: list[ChunkIndex] = []
        self._attachments: list[AttachmentIndex] = []
        self._metadata: list[MetadataIndex] = []
        self._counts: dict[int, int] = {}
        self._times: list[int] = []
        self._compressor = zstandard.ZstdCompressor(LEVEL)
        self._put(MAGIC)
        self._put(_bytes(Header(profile, library)))

    def _put(self, data: bytes) -> tuple[int, int]:
        """Append to the data section; returns offset and length."""
        offset = self._position
        self._stream.write(data)
        self._crc = zlib.crc32(data, self._crc)
        self._position += len(data)
        return offset, len(data)

    def add_metadata(self, name: str, content: dict[str, str]) -> None:
        """Write a Metadata record."""
        offset, length = self._put(_bytes(Metadata(name=name, metadata=content)))
        self._metadata.append(MetadataIndex(offset=offset, length=length, name=name))

    def add_attachment(self, name: str, media_type: str, data: bytes) -> None:
        """Attach bytes under a name, without a clock time, so that equal logs are equal bytes."""
        attachment = Attachment(
            create_time=0, log_time=0, name=name, media_type=media_type, data=data
        )
        offset, length = self._put(_bytes(attachment))
        self._attachments.append(AttachmentIndex(offset, length, 0, 0, len(data), name, media_type))

    def add_channel(self, topic: str, encoding: str, schema: tuple[str, str, bytes]) -> int:
        """Define a topic with its schema (name, encoding, text); returns the channel's number."""
        number = len(self._channels) + 1
        name, schema_encoding, text = schema
        self._schemas.append(Schema(id=number, data=text, encoding=schema_encoding, name=name))
        self._channels.append(
            Channel(
                id=number,
                topic=topic,
                message_encoding=encoding,
                metadata={},
                schema_id=number,
            )
        )
        self._put(_bytes(self._schemas[-1]) + _bytes(self._channels[-1]))
        return number

    def add_chunk(self, records: dict[int, np.ndarray]) -> None:
        """One chunk of message records by channel, structured arrays of `record_dtype`.

        Together, as what the records of a step have in common is then compressed to almost nothing.
        """
        data = b"".join(of_channel.tobytes() for of_channel in records.values())
        times = np.concatenate([of_channel["log_time"] for of_channel in records.values()])
        compressed = self._compressor.compress(data)
        chunk = Chunk(
            compression="zstd",
            data=compressed,
            message_start_time=int(times.min()),
            message_end_time=int(times.max()),
            uncompressed_crc=0,  # none: that of the data section is over these bytes too
            uncompressed_size=len(data),
        )
        offset, length = self._put(_bytes(chunk))
        offsets, begin = {}, 0
        for channel, of_channel in records.items():
            offsets[channel], _ = self._put(_message_index(channel, of_channel, begin))
            begin += of_channel.nbytes
            self._counts[channel] = self._counts.get(channel, 0) + len(of_channel)
        self._chunks.append(
            ChunkIndex(
                message_start_time=chunk.message_start_time,
                message_end_time=chunk.message_end_time,
                chunk_start_offset=offset,
                chunk_length=length,
                message_index_offsets=offsets,
                message_index_length=self._position - offset - length,
                compression=chunk.compression,
                compressed_size=len(compressed),
                uncompressed_size=len(data),
            )
        )
        self._times += [chunk.message_start_time, chunk.message_end_time]

    def finish(self) -> None:
        """Write the end of the data section, the summary, the footer and the closing magic."""
        end = _bytes(DataEnd(self._crc))
        start = self._position + len(end)
        statistics = Statistics(
            attachment_count=len(self._attachments),
            channel_count=len(self._channels),
            channel_message_counts=self._counts,
            chunk_count=len(self._chunks),
            message_count=sum(self._counts.values()),
            metadata_count=len(self._metadata),
            message_start_time=min(self._times, default=0),
            message_end_time=max(self._times, default=0),
            schema_count=len(self._schemas),
        )
        groups = {
            Opcode.SCHEMA: self._schemas,
            Opcode.CHANNEL: self._channels,
            Opcode.STATISTICS: [statistics],
            Opcode.CHUNK_INDEX: self._chunks,
            Opcode.ATTACHMENT_INDEX: self._attachments,
            Opcode.METADATA_INDEX: self._metadata,
        }
        summary, offsets = b"", b""
        for opcode, records in groups.items():
            group = b"".join(_bytes(record) for record in records)
            offsets += _bytes(SummaryOffset(opcode, start + len(summary), len(group)))
            summary += group
        offset_start = start + len(summary)
        summary += offsets
        head = _bytes(Footer(start, offset_start, 0))[:FOOTER_HEAD]
        footer = head + CRC.pack(zlib.crc32(summary + head))
        self._stream.write(end + summary + footer + MAGIC)


def _message_index(channel: int, records: np.ndarray, begin: int) -> bytes:
    """The MessageIndex record of a channel in a chunk: log time and offset of each message."""
    entries = np.empty(len(records), dtype=index_dtype())
    entries["log_time"] = records["log_time"]
    entries["offset"] = begin + np.arange(len(records)) * records.dtype.itemsize
    body = channel.to_bytes(2, "little") + entries.nbytes.to_bytes(4, "little") + entries.tobytes()
    return RECORD_HEAD.pack(Opcode.MESSAGE_INDEX, len(body)) + body
