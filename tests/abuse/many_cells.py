"""Servers of many cells: floods of connections that each get a cell, and a thousand pages that show a thousand cells."""

from attack import Beside
from target import call, connect, json_line

FLOOD_LINES = 200
OVERVIEWS = 1000
CELLS = 300
PER_CONNECTION = ("--cell-per-connection", "--max-cells", 300, "--linger", 3600)


def cell_flood(target):
    """Connections that send an inquiry and close, so that each one makes a cell and pushes out another one."""
    for number in range(10**9):
        with connect(target.robot_port) as sock:
            sock.sendall(b"E?")
            sock.recv(1)
        if number == 2 * CELLS:
            target.ready()


def undecided_flood(target):
    """Connections that hold back the byte that decides: each waits without a cell."""
    kept = []
    for _ in range(FLOOD_LINES):
        sock = connect(target.robot_port)
        sock.sendall(b"GET")
        kept.append(sock)
    target.ready()
    while True:
        kept.pop(0).close()
        kept.append(connect(target.robot_port))
        kept[-1].sendall(b"GE")


def overviews(target):
    """A thousand subscribers of the overview, and a client that moves robots in every cell."""
    pages = [target.ask(json_line("sub", id=1, channel="overview")) for _ in range(OVERVIEWS)]
    mover = target.page()
    mover.sendall(b"".join(
        json_line("call", id=1, cell=str(k + 1), fn="send", args={"text": "B+100\rC+100\r"})
        for k in range(CELLS)))
    target.ready()
    while True:
        for page in pages:
            page.recv(1 << 20)
        mover.sendall(call("home"))


ATTACKS = [
    Beside("cells.connections", cell_flood, options=PER_CONNECTION),
    Beside("cells.undecided", undecided_flood, options=PER_CONNECTION),
    Beside("cells.overviews", overviews, options=("--cells", CELLS)),
]
