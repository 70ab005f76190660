"""Lockstep: bytes that were written to one socket before a `step` on another are executed before that step.

Each try writes moves to robot sockets, then at once a step to the monitor's socket, without a barrier.
The answer to the step must show that exactly those bytes were executed, at the tick before the step.
Nothing is pipelined: the next try begins after the check of the answer.
"""

import itertools
import os
import signal
import socket

from support import Server, connect

TICKS = 10  # at 110 counts/s, E and F make their first count in the tenth tick
STEP = b'{"op":"call","id":1,"fn":"step","args":{"ticks":%d,"fields":["joints"]}}\n'


def send_without_pacing(sock):
    """With BBR, the client's system may keep the end of a burst back, so that it does not arrive before the step."""
    sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_CONGESTION, b"reno")


class Lockstep:
    def __init__(self, test):
        self.test = test

    def __enter__(self):
        self.server = Server("--log-level", "off", "--max-lines", 5000)
        self.server.__enter__()
        self.monitor = self.server.monitor()
        self.joints = {joint["label"]: place for place, joint in enumerate(self.monitor.get()["joints"])}
        return self

    def __exit__(self, *problem):
        self.monitor.close()
        self.server.__exit__(*problem)

    def step(self, ticks=TICKS):
        """Makes one step; returns (count, error) of each joint, by label."""
        self.monitor.socket.sendall(STEP % ticks)
        return self.answer()

    def answer(self):
        joints = self.monitor.read(is_whole=False)["value"]["state"]["joints"]
        return {label: (joints[place]["count"], joints[place]["error"])
                for label, place in self.joints.items()}

    def one_line(self, tries):
        """E moves up one count and down one count; at the end of each step the move is done."""
        sock = self.server.line().socket
        for move in itertools.islice(itertools.cycle((b"E+1\r", b"E-1\r")), tries):
            sock.sendall(move)
            self.test.assertEqual((1 if move == b"E+1\r" else 0, 0), self.step()["E"])

    def several_lines(self, tries, lines=4):
        """Each of several lines adds one count to the same error counter; the joint moves by one count in
        each step."""
        socks = [self.server.line().socket for _ in range(lines)]
        label, error = b"F", 0
        for number in range(tries):
            sign = 1 if number % 2 == 0 else -1
            for sock in socks:
                sock.sendall(b"%c%+d\r" % (label[0], sign))
            before = error
            error += sign * lines
            motion = (error > 0) - (error < 0)
            error -= motion
            self.test.assertEqual(error, self.step()["F"][1], f"try {number}: {before} before it")

    def split_moves(self, tries):
        """A move begins with its last byte, which is written separately, right before the step."""
        sock = self.server.line().socket
        for number in range(tries):
            count = 1 - number % 2
            sock.sendall(b"E+" if count else b"E-")
            sock.sendall(b"1")
            self.test.assertEqual((1 - count, 0), self.step(0)["E"])
            sock.sendall(b"\r")
            self.test.assertEqual((count, 0), self.step()["E"])

    def fresh_connections(self, tries):
        """The connection is opened right before the step, so the server has not accepted it yet."""
        for number in range(tries):
            count = 1 - number % 2
            with connect(self.server.robot_port) as sock:
                sock.sendall(b"E+1\r" if count else b"E-1\r")
                self.test.assertEqual((count, 0), self.step()["E"])

    def frozen(self, tries, fresh, before=b""):
        """The worst order: the beginning of a request makes the monitor's socket ready first; then the
        move arrives, on an open line or on a new connection; then the rest of the request. The server is
        stopped meanwhile, so that it finds everything at once. `before` is sent before the move; what does not fit
        into the server's receive buffer arrives while the server reads."""
        old = self.server.line().socket
        old.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 200_000)
        send_without_pacing(old)
        for number in range(tries):
            count = 1 - number % 2
            self.stop_server()
            self.monitor.socket.sendall(STEP[:10])
            sock = connect(self.server.robot_port) if fresh else old
            sock.sendall(before + (b"E+1\r" if count else b"E-1\r"))
            self.monitor.socket.sendall(STEP[10:] % TICKS)
            os.kill(self.server.pid, signal.SIGCONT)
            self.test.assertEqual((count, 0), self.answer()["E"], f"try {number}")
            if fresh:
                sock.close()

    def stop_server(self):
        os.kill(self.server.pid, signal.SIGSTOP)
        os.waitid(os.P_PID, self.server.pid, os.WSTOPPED)

    def bursts(self, tries, size=100_000):
        """A burst of moves by 0 that needs several reads, followed by the move that is checked."""
        sock = self.server.line().socket
        send_without_pacing(sock)
        for number in range(tries):
            count = 1 - number % 2
            sock.sendall(b"F+0\r" * (size // 4) + (b"E+1\r" if count else b"E-1\r"))
            self.test.assertEqual((count, 0), self.step()["E"])
