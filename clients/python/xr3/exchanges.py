"""Exchanges on serial lines, from the monitor's messages of the channel `line`: what a client sent,
and the reply to it, decoded.
"""

from dataclasses import dataclass, field
from typing import Dict, Iterable, List

from xr3.monitor import Message

WIDTH = 24  # characters of the bytes that are shown


@dataclass
class Exchange:
    """Bytes of a client, and the meaning of the replies, one for each of `times` equal inquiries."""

    tick: int
    line: int
    text: str
    meaning: str
    replies: List[str] = field(default_factory=list)
    times: int = 1

    @property
    def is_begun(self) -> bool:
        """Whether the rest of a command is still to come, so that nothing has had an effect."""
        return not self.meaning and not self.replies

    def repeats(self, before: "Exchange") -> bool:
        """Whether both are the same inquiry on one line."""
        is_inquiry = bool(self.replies and before.replies)
        return is_inquiry and (self.line, self.text) == (before.line, before.text)

    def __str__(self) -> str:
        text = self.text if len(self.text) <= WIDTH else self.text[:WIDTH - 1] + "…"
        text += f" {self.times} times" if self.times > 1 else ""
        replies = " … ".join(dict.fromkeys([*self.replies[:1], *self.replies[-1:]]))
        meaning = ": ".join(filter(None, [self.meaning, replies]))
        return f"{self.tick:>8} ms  line {self.line}  {text:<{WIDTH}}  {meaning}".rstrip()


def exchanges(messages: Iterable[Message]) -> List[Exchange]:
    """The exchanges of these messages, in their order; equal inquiries in succession are one."""
    found: List[Exchange] = []
    for each in _paired(messages):
        if found and each.repeats(found[-1]):
            found[-1].times += 1
            found[-1].replies += each.replies
        else:
            found.append(each)
    return found


def _paired(messages: Iterable[Message]) -> List[Exchange]:
    """The bytes of clients with the replies that follow them on their line. A command that arrives
    in parts is one exchange."""
    found: List[Exchange] = []
    last: Dict[int, Exchange] = {}
    for message in messages:
        line = message["line"]
        meaning = "; ".join(part["message"] for part in message["parsed"])
        before = last.get(line)
        if message["dir"] == "in" and before and before.is_begun:
            before.text, before.meaning = before.text + message["text"], meaning
        elif message["dir"] == "in":
            last[line] = Exchange(message["tick"], line, message["text"], meaning)
            found.append(last[line])
        elif before and meaning:
            before.replies.append(meaning)
    return found
