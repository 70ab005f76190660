"""A TCP proxy, like the port mapping of a container or a tunnel. It can delay the bytes to the server, as a
network does; bytes from the server are not delayed."""

import collections
import contextlib
import selectors
import socket
import threading
import time

from support import LOCALHOST


class Proxy:
    """A context manager that forwards all connections to `port`, on its own `self.port`. `delay_s` is the
    delay of bytes to the server."""

    def __init__(self, port, delay_s=0.0):
        self.target, self.delay_s = port, delay_s
        self._late = collections.deque()  # (time, socket, bytes) to send, in order; b"" closes for writing
        self._selector = selectors.DefaultSelector()
        self._listener = socket.create_server((LOCALHOST, 0))
        self.port = self._listener.getsockname()[1]
        self._sockets = [self._listener]
        self._selector.register(self._listener, selectors.EVENT_READ, self._accept)
        self._waker, self._woken = socket.socketpair()
        self._selector.register(self._woken, selectors.EVENT_READ, None)

    def __enter__(self):
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._waker.close()
        self._thread.join()
        for sock in [*self._sockets, self._woken]:
            sock.close()

    def redirect(self, port):
        """Forwards new connections to another port, and closes the others: a browser may have opened one that it
        has not used yet."""
        self.target = port
        for sock in self._sockets[1:]:
            with contextlib.suppress(OSError):
                sock.shutdown(socket.SHUT_RDWR)

    def _run(self):
        while True:
            left = max(0.0, self._late[0][0] - time.monotonic()) if self._late else None
            for key, _ in self._selector.select(left):
                if key.data is None:
                    return
                key.data()
            while self._late and self._late[0][0] <= time.monotonic():
                _, sock, data = self._late.popleft()
                self._put(sock, data)

    def _accept(self):
        client, _ = self._listener.accept()
        server = socket.create_connection((LOCALHOST, self.target))
        for sock, other, delay_s in (client, server, self.delay_s), (server, client, 0.0):
            sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            self._sockets.append(sock)
            self._selector.register(sock, selectors.EVENT_READ,
                                    lambda way=(sock, other, delay_s): self._forward(*way))

    def _forward(self, source, target, delay_s):
        try:
            data = source.recv(65536)
        except ConnectionError:  # reset; a broken pipe, if the other side closed before it reset the connection
            data = b""
        if not data:
            self._selector.unregister(source)
        if delay_s:
            self._late.append((time.monotonic() + delay_s, target, data))
        else:
            self._put(target, data)

    @staticmethod
    def _put(sock, data):
        try:
            if data:
                sock.sendall(data)
            else:
                sock.shutdown(socket.SHUT_WR)
        except OSError:
            pass  # the other side has closed
