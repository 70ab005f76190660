"""Connections: the end of a server with many clients, a server without descriptors, and clients that come and go."""

import contextlib
import socket
import time
import urllib.error
import urllib.request

import websocket
from attack import STOP_S, Attack, Measured, busy_share, stopped
from cells import LARGEST, Cell
from lines import MANY_LINES
from memory import send_greedily
from support import DEADLINE_S, LOCALHOST, XR3, Server
from target import RESET, Target, connect, get, json_line

MANY_PAGES = 1000
CHECKS = 20
CHECK_S = 5  # room for a busy machine; a quiet one takes some ms
FEW_DESCRIPTORS = 64
STRICTLY = 3000
MOST_PLACES = 1100  # more than either port has
OTHER_ADDRESS = "127.0.0.2"
SMALL_BUFFER = 4096


def ask(port, path):
    """(status, body) of an HTTP answer; the status is 0 if there is none."""
    try:
        with urllib.request.urlopen(f"http://{LOCALHOST}:{port}{path}", timeout=DEADLINE_S) as answer:
            return answer.status, answer.read()
    except urllib.error.HTTPError as error:
        with error:
            return error.code, error.read()
    except OSError:
        return 0, b""


def status(port, path):
    return ask(port, path)[0]


def missed_checks(port):
    """The number of health checks without an answer in time. /readyz may answer that no line is free."""
    missed = 0
    for number in range(CHECKS):
        started = time.monotonic()
        code, body = ask(port, ("/healthz", "/readyz")[number % 2])
        is_answered = code == 200 or number % 2 == 1 and b'"not_ready"' in body
        missed += not is_answered or time.monotonic() - started > CHECK_S
    return Measured(missed, f"of {CHECKS}")


# --- SIGTERM.


def stop(name, opener, data, clients=MANY_PAGES):
    """The end of the server with many clients that read nothing."""
    def measure():
        with contextlib.ExitStack() as stack:
            options = stack.enter_context(Cell(LARGEST))
            xr3 = stack.enter_context(Server("--log-level", "warn", *options, clock="real"))
            target = Target(xr3.robot_port, xr3.monitor_port)
            for _ in range(clients):
                send_greedily(stack.enter_context(opener(target)), data)
            return stopped(xr3)
    return Attack(f"stop.{name}", STOP_S, "s", measure)


def line(target):
    return target.line(buffer_bytes=SMALL_BUFFER)


def page(target):
    return target.page(buffer_bytes=SMALL_BUFFER)


def frames(target):
    return websocket.opened(target, buffer_bytes=SMALL_BUFFER)


# --- Few descriptors.


@contextlib.contextmanager
def full_server():
    """A server that may open few files, and clients that hold all of them."""
    command = ("prlimit", f"--nofile={FEW_DESCRIPTORS}:{FEW_DESCRIPTORS}", XR3, "serve")
    with contextlib.ExitStack() as stack:
        xr3 = stack.enter_context(Server(command=command))
        socks = [connect(port) for port in (xr3.robot_port, xr3.monitor_port) for _ in range(2 * FEW_DESCRIPTORS)]
        yield xr3, socks
        for sock in socks:
            sock.close()


def full_cpu():
    with full_server() as (xr3, _):
        status(xr3.monitor_port, "/healthz")
        return Measured(busy_share(xr3))


def full_health():
    with full_server() as (xr3, _):
        return missed_checks(xr3.monitor_port)


def full_recovery():
    """The time from the end of the clients to the first request and inquiry that are served."""
    with full_server() as (xr3, socks):
        status(xr3.monitor_port, "/state")
        for sock in socks:
            sock.close()
        started = time.monotonic()
        while status(xr3.monitor_port, "/state") != 200:
            pass
        while not _is_served(xr3.robot_port):
            pass
        return Measured(time.monotonic() - started)


def _is_served(port):
    with contextlib.suppress(ConnectionError), connect(port) as sock:
        sock.sendall(b"E?")
        return sock.recv(1) == b" "
    return False


# --- Coming and going.


def one_after_the_other(port_of, data, is_good):
    """The number of connections that are refused although each begins after the end of the last one."""
    def measure():
        refused = 0
        with Server("--log-level", "warn", clock="real") as xr3:
            for _ in range(STRICTLY):
                with contextlib.suppress(ConnectionError), connect(getattr(xr3, port_of)) as sock:
                    sock.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, RESET)
                    sock.sendall(data)
                    refused += not is_good(sock.recv(64))
                    continue
                refused += 1
        return Measured(refused, f"of {STRICTLY}")
    return measure


def silent_openings(port_of, is_served):
    """Connections that send nothing and end: the number of those that follow and are not served."""
    def measure():
        refused = 0
        with Server("--log-level", "warn", clock="real") as xr3:
            for number in range(STRICTLY):
                connect(getattr(xr3, port_of)).close()
                if number % 100 == 99:
                    refused += not is_served(xr3)
        return Measured(refused, f"of {STRICTLY // 100}")
    return measure


def crowded_health(data):
    """Health checks that are missed while a client holds as many connections as it can."""
    def measure():
        with contextlib.ExitStack() as stack:
            xr3 = stack.enter_context(Server("--log-level", "warn", clock="real"))
            for _ in range(MOST_PLACES):
                send_greedily(stack.enter_context(connect(xr3.monitor_port)), data)
            return missed_checks(xr3.monitor_port)
    return measure


def other_address(port_of, is_served):
    """Whether a client is refused while one at another address holds as many connections as it can. Both are on this
    machine, which has no limit by default."""
    def measure():
        with contextlib.ExitStack() as stack:
            xr3 = stack.enter_context(Server("--log-level", "warn", "--max-per-address", "30", clock="real"))
            for _ in range(MOST_PLACES):
                with contextlib.suppress(OSError):
                    address = (LOCALHOST, getattr(xr3, port_of))
                    stack.enter_context(socket.create_connection(address, DEADLINE_S, (OTHER_ADDRESS, 0)))
            return Measured(sum(not is_served(xr3) for _ in range(CHECKS)), f"of {CHECKS}")
    return measure


def is_line_served(xr3):
    return _is_served(xr3.robot_port)


def is_state_served(xr3):
    return status(xr3.monitor_port, "/state") == 200


IMAGES = 20
ATTACKS = [
    stop("idle", page, b""),
    stop("line-images", line, b"A**" * IMAGES, MANY_LINES),
    stop("http-images", page, get("/camera.pbm") * IMAGES),
    stop("http-png", page, get("/camera.png") * IMAGES),
    stop("http-pictures", page, get("/view.svg")),
    stop("http-unfinished", page, b"GET /"),
    stop("json-images", page, json_line("get", channel="image") * IMAGES),
    stop("json-followers", page, json_line("sub", channel="state", max_hz=60)),
    stop("websocket-images", frames, websocket.text("get", channel="image") * IMAGES),
    Attack("full.cpu", 5, "% of a core", full_cpu),
    Attack("full.health-checks", 0, "missed", full_health),
    Attack("full.recovery", CHECK_S, "s", full_recovery),
    Attack("crowd.silent", 0, "missed", crowded_health(b"")),
    Attack("crowd.http", 0, "missed", crowded_health(b"GET /sta")),
    Attack("crowd.json", 0, "missed", crowded_health(b'{"op":"ping"}\n')),
    Attack("crowd.lines-of-another", 0, "refused", other_address("robot_port", is_line_served)),
    Attack("crowd.pages-of-another", 0, "refused", other_address("monitor_port", is_state_served)),
    Attack("turns.lines", 0, "refused", one_after_the_other("robot_port", b"E?", lambda reply: reply == b" ")),
    Attack("turns.json", 0, "refused", one_after_the_other("monitor_port", b'{"op":"ping"}\n',
                                                           lambda reply: reply.startswith(b'{"op":"hello"'))),
    Attack("turns.http", 0, "refused", one_after_the_other("monitor_port", get("/healthz"),
                                                           lambda reply: reply.startswith(b"HTTP/1.1 200"))),
    Attack("turns.silent-lines", 0, "refused", silent_openings("robot_port", is_line_served)),
    Attack("turns.silent-pages", 0, "refused", silent_openings("monitor_port", is_state_served)),
]
