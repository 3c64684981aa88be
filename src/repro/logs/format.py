"""Layout of the messages and of the records around them, for writer and reader."""

import struct
from typing import Any, NamedTuple

import numpy as np

from repro.errors import ReproError

# As in mcap.writer, whose import would take a quarter of the start of a filter's job.
MAGIC = b"\x89MCAP0\r\n"
PROFILE = "ros2"
ENCODING = "cdr"
SCHEMA_ENCODING = "ros2msg"
CDR_LITTLE_ENDIAN = 0x00000100  # the encapsulation header 00 01 00 00 as a little-endian number
PROVENANCE = "provenance"  # Metadata record: study, point, seed, trials
PARAMETERS = "parameters.json"  # Attachment: the resolved parameters of the point
RECORD_HEAD = struct.Struct("<BQ")  # opcode and length of a record
CRC = struct.Struct("<I")
FOOTER_HEAD = RECORD_HEAD.size + 16  # bytes of a footer before its CRC


class LogError(ReproError):
    """A log that is damaged, or not the expected one."""


class Log(NamedTuple):
    """A log in memory: values of a topic are (trials, messages a trial, fields)."""

    study: str
    point: str
    seed: int
    parameters: Any  # a PointParameters of the study's type
    trials: np.ndarray  # numbers of the trials, ascending
    fields: dict[str, tuple[str, ...]]  # of each topic
    values: dict[str, np.ndarray]

    @property
    def steps(self) -> int:
        """Messages that a trial has in the topics of every step."""
        return max(values.shape[1] for values in self.values.values())

    def field(self, topic: str, name: str) -> np.ndarray:
        """One field of a topic, (trials, messages a trial)."""
        return self.values[topic][:, :, self.fields[topic].index(name)]


def selected(log: Log, fields: dict[str, tuple[str, ...]]) -> Log:
    """The log with these topics and fields alone."""
    values = {}
    for topic, names in fields.items():
        places = [log.fields[topic].index(name) for name in names]
        whole = names == log.fields[topic]
        values[topic] = log.values[topic] if whole else log.values[topic][:, :, places]
    return log._replace(fields=fields, values=values)


def schema_name(study: str, topic: str) -> str:
    """Name of the message type of a topic: repro_msgs/msg/<StudyTopic>."""
    words = f"{study}_{topic}".replace("/", "_").split("_")
    camel = "".join(word.capitalize() for word in words)
    return f"repro_msgs/msg/{camel}"


def schema_text(fields: tuple[str, ...]) -> bytes:
    """ros2msg definition: trial and step, then one float64 a field."""
    return "".join(
        ["uint32 trial\n", "uint32 step\n", *(f"float64 {field}\n" for field in fields)]
    ).encode()


def payload_dtype(fields: int) -> np.dtype:
    """A cdr-encoded message: encapsulation header, trial, step, values (aligned as they are)."""
    return np.dtype(
        [("cdr", "<u4"), ("trial", "<u4"), ("step", "<u4"), ("values", "<f8", (fields,))]
    )


def record_dtype(fields: int) -> np.dtype:
    """A whole MCAP Message record (opcode 0x05) around such a message."""
    return np.dtype(
        [
            ("opcode", "u1"),
            ("length", "<u8"),
            ("channel", "<u2"),
            ("sequence", "<u4"),
            ("log_time", "<u8"),
            ("publish_time", "<u8"),
            ("payload", payload_dtype(fields)),
        ]
    )


def record_head_dtype(size: int) -> np.dtype:
    """What tells the records of one channel, of this size, from others."""
    # The length's highest byte is left to the channel's entry, so that two numbers are enough.
    heads = {"opcode_and_length": ("<u8", 0), "channel": ("<u4", RECORD_HEAD.size - 2)}
    formats, offsets = zip(*heads.values(), strict=True)
    return np.dtype(
        {"names": list(heads), "formats": formats, "offsets": offsets, "itemsize": size}
    )


def index_dtype() -> np.dtype:
    """An entry of a MessageIndex record."""
    return np.dtype([("log_time", "<u8"), ("offset", "<u8")])
