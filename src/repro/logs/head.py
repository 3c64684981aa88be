"""What a log of this project says of itself, without its messages."""

import json
import os
import zlib
from pathlib import Path
from typing import Any, NamedTuple

from mcap.opcode import Opcode
from mcap.records import Attachment, Metadata

from repro.logs.content import READ, stream_of
from repro.logs.format import CRC, MAGIC, PARAMETERS, PROVENANCE, RECORD_HEAD, LogError


class Head(NamedTuple):
    """What this project's logs say of themselves before their first message."""

    provenance: dict[str, str]  # empty if it is not there
    parameters: dict[str, Any]


def read_head(path: str | Path) -> Head:
    """Read the records before the first schema; the messages stay unread and unchecked.

    Raises LogError in one line if the file is not a log, or if the CRC of its parameters is wrong.
    """
    found = Head({}, {})
    try:
        with Path(path).open("rb") as stream:
            if stream.read(len(MAGIC)) != MAGIC:
                raise ValueError("no MCAP magic")
            left = os.fstat(stream.fileno()).st_size
            while True:
                opcode, length = RECORD_HEAD.unpack(stream.read(RECORD_HEAD.size))
                if opcode not in (Opcode.HEADER, Opcode.METADATA, Opcode.ATTACHMENT):
                    return found
                body = stream.read(min(length, left))
                if opcode == Opcode.HEADER:
                    continue
                record = READ[opcode](stream_of(body, 0, length))
                if isinstance(record, Metadata) and record.name == PROVENANCE:
                    found = found._replace(provenance=record.metadata)
                elif isinstance(record, Attachment) and record.name == PARAMETERS:
                    if CRC.unpack_from(body, length - CRC.size)[0] != zlib.crc32(body[: -CRC.size]):
                        raise ValueError(f"CRC of {PARAMETERS}")
                    found = found._replace(parameters=json.loads(record.data))
    except OSError as error:
        raise LogError(f"{path}: the log cannot be read: {error.strerror}") from None
    except Exception as error:  # as of Content
        raise LogError(
            f"{path}: the log is truncated or changed ({type(error).__name__}: {error}): "
            "generate it again"
        ) from None
