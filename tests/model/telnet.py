"""The telnet filter of a serial line. From docs/protocol.md, section Telnet, and RFC 854."""

IAC, DONT, DO, WONT, WILL, SB, IP, SE = 255, 254, 253, 252, 251, 250, 244, 240
TIMING_MARK = 6
LONGEST_SUBNEGOTIATION = 512


class Telnet:
    def __init__(self):
        self.is_telnet = False
        self.command = b""  # a command that has begun

    def feed(self, byte):
        """Returns the answer to the client, and the bytes for the robot."""
        if not self.command and byte != IAC:
            return b"", bytes([byte])
        self.command += bytes([byte])
        return self._continue(byte)

    def escape(self, reply):
        return reply.replace(b"\xff", b"\xff\xff") if self.is_telnet else reply

    def _continue(self, byte):
        if len(self.command) == 1:
            return b"", b""
        second = self.command[1]
        if second < SE:
            self.command = b""
            return b"", bytes([byte])
        if second == IAC:
            return self._end(b"", b"\xff")
        if second == SB:
            return self._subnegotiation()
        if second in (DO, DONT, WILL, WONT) and len(self.command) < 3:
            return b"", b""
        self.is_telnet = self.is_telnet or second in (DO, DONT, WILL, WONT, IP)
        return self._end(self._answer(second, byte))

    def _subnegotiation(self):
        if self.command.endswith(bytes([IAC, SE])):
            self.is_telnet = True
            return self._end()
        return self._end() if len(self.command) - 2 > LONGEST_SUBNEGOTIATION else (b"", b"")

    def _end(self, answer=b"", bytes_for_robot=b""):
        self.command = b""
        return answer, bytes_for_robot

    @staticmethod
    def _answer(request, option):
        if request == DO:
            return bytes([IAC, WILL if option == TIMING_MARK else WONT, option])
        return bytes([IAC, DONT, option]) if request == WILL else b""
