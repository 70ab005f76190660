"""The telnet filter of a serial line. From docs/protocol.md, sections Telnet and RFC 2217. Not modelled: the limit
of held replies."""

IAC, DONT, DO, WONT, WILL, SB, IP, SE = 255, 254, 253, 252, 251, 250, 244, 240
BINARY, GO_AHEAD, TIMING_MARK, COM_PORT = 0, 3, 6, 44
ACCEPTED = (BINARY, GO_AHEAD, COM_PORT)
LONGEST_SUBNEGOTIATION = 512
# For each request to turn an option on or off: the client's or our side, whether on, and the two answers.
REQUESTS = {WILL: ("client", True, DO, DONT), WONT: ("client", False, DO, DONT),
            DO: ("server", True, WILL, WONT), DONT: ("server", False, WILL, WONT)}
MODEM_STATE = b"\x6b\xb0"


class ComPort:
    """The settings of a client; `ask` handles the requests that have an answer."""

    # The name of each setting: the values that it may have, the first one at the beginning.
    CONTROLS = {0: (1, 2, 3, 17, 19), 4: (6, 5), 7: (8, 9), 10: (11, 12), 13: (14, 15, 16, 18)}

    def __init__(self):
        self.values = {1: (9600).to_bytes(4, "big"), 2: b"\x07", 3: b"\x03", 4: b"\x02"}
        self.controls = {ask: values[0] for ask, values in self.CONTROLS.items()}

    def ask(self, code, value):
        if code in (2, 3, 4) and len(value) == 1:
            return self._set(code, value, {2: range(5, 9), 3: range(1, 6), 4: range(1, 4)}[code])
        if code == 1 and len(value) == 4:
            return self._set(code, value, None)
        if code == 5 and len(value) == 1:
            return bytes([105, self._control(value[0])])
        if code in (10, 11, 12) and len(value) == 1:
            return bytes([code + 100]) + value
        if code == 7 and not value:
            return MODEM_STATE
        return b"\x64xr3" if code == 0 and not value else None

    def _set(self, code, value, allowed):
        if not any(value):
            value = self.values[code]
        elif allowed is None or value[0] in allowed:
            self.values[code] = value
        return bytes([code + 100]) + value

    def _control(self, value):
        for ask, values in self.CONTROLS.items():
            if value == ask:
                return self.controls[ask]
            if value in values:
                self.controls[ask] = value
        return value


class Telnet:
    def __init__(self):
        self.is_telnet = False
        self.command = b""  # a command that has begun
        self.on = {"client": set(), "server": set()}
        self.com_port = ComPort()
        self.is_suspended = False
        self.held = b""

    def feed(self, byte):
        """Returns the bytes for the client, and those for the robot."""
        if not self.command and byte != IAC:
            return b"", bytes([byte])
        self.command += bytes([byte])
        return self._continue(byte)

    def reply(self, reply):
        """The bytes for the client, now, when the robot replies."""
        if self.is_suspended:
            self.held += reply
            return b""
        return reply.replace(b"\xff", b"\xff\xff") if self.is_telnet else reply

    def _continue(self, byte):
        if len(self.command) == 1:
            return b"", b""
        second = self.command[1]
        if second < SE:
            return self._end(b"", bytes([byte]))
        if second == IAC:
            return self._end(b"", b"\xff")
        if second == SB:
            return self._subnegotiation(byte) if len(self.command) > 2 else self._begin_subnegotiation()
        if second in REQUESTS and len(self.command) < 3:
            return b"", b""
        self.is_telnet = self.is_telnet or second in REQUESTS or second == IP
        return self._end(self._option(second, byte) if second in REQUESTS else b"")

    def _begin_subnegotiation(self):
        self.content, self.length, self.is_after_iac = b"", 0, False
        return b"", b""

    def _subnegotiation(self, byte):
        """Within one, each byte and each command counts as one byte of the length."""
        if byte == IAC and not self.is_after_iac:
            self.is_after_iac = True
            return b"", b""
        is_command, self.is_after_iac = self.is_after_iac, False
        if is_command and byte == SE:
            self.is_telnet = True
            return self._end(self._request(self.content))
        if not is_command or byte == IAC:
            self.content += bytes([byte])
        self.length += 1
        return self._end() if self.length > LONGEST_SUBNEGOTIATION else (b"", b"")

    def _end(self, for_client=b"", for_robot=b""):
        self.command = b""
        return for_client, for_robot

    def _has_com_port(self):
        return any(COM_PORT in side for side in self.on.values())

    def _option(self, request, option):
        side, wants_on, yes, no = REQUESTS[request]
        if request == DO and option == TIMING_MARK:
            return bytes([IAC, WILL, option])
        if wants_on == (option in self.on[side]):
            return b""
        if not wants_on:
            self.on[side].remove(option)
            answer = bytes([IAC, no, option])
            return answer if self._has_com_port() else answer + self._resume()
        if option not in ACCEPTED:
            return bytes([IAC, no, option])
        self.on[side].add(option)
        answer = bytes([IAC, yes, option])
        return answer + self._wrap(MODEM_STATE) if request == WILL and option == COM_PORT else answer

    def _request(self, content):
        if len(content) < 2 or content[0] != COM_PORT or not self._has_com_port():
            return b""
        code, value = content[1], content[2:]
        if code == 8 and not value:
            self.is_suspended = True
        if code == 9 and not value:
            return self._resume()
        if code == 12 and value in (b"\x01", b"\x03"):
            self.held = b""
        answer = self.com_port.ask(code, value)
        return b"" if answer is None else self._wrap(answer)

    def _resume(self):
        held, self.held, self.is_suspended = self.held, b"", False
        return self.reply(held)

    @staticmethod
    def _wrap(answer):
        return bytes([IAC, SB, COM_PORT]) + answer.replace(b"\xff", b"\xff\xff") + bytes([IAC, SE])
