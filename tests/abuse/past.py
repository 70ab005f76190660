"""Loads on the past of a cell: a client that looks at distant moments, asks for the whole history, takes the robot back
and forth, and opens cells from its past. The others are in another cell of the same server."""

import random

from attack import Beside
from target import json_line

CELL = "2"
TWO = ("--cells", 2)
MOVES = "B+60\rC+60\rE+30\rD-30\rB-60\rC-60\rE-30\rD+30\r"
ROUNDS = 120
ROUND_TICKS = 30_000  # an hour in all
CHANNELS = ["state", "image", "display", "model"]
MOMENTS = 200


def ask_cell(fn, **arguments):
    return json_line("call", id=1, cell=CELL, fn=fn, args=arguments)


def an_hour(target):
    """Gives the cell an hour of moves and pauses."""
    rounds = [ask_cell("pause")]
    for _ in range(ROUNDS):
        rounds += [ask_cell("send", text=MOVES), ask_cell("step", ticks=ROUND_TICKS, fields=[])]
    target.ask(*rounds).close()


def moments():
    """Ticks in no order, so that each is made anew from the state that is kept before it."""
    choice = random.Random(1)
    return [choice.randrange(ROUNDS * ROUND_TICKS) for _ in range(MOMENTS)]


def flood(requests, count=1):
    """Repeats the requests, of which the first must succeed."""
    def load(target):
        an_hour(target)
        target.ask(requests[0]).close()
        target.flood(target.ask, b"".join(requests), count=count)
    return load


def looks(**more):
    return [ask_cell("look", tick=tick, epoch=0, **more) for tick in moments()]


def traces():
    return [ask_cell("trace", tick=tick, epoch=0, every=10) for tick in moments()]


def seeks():
    """Each is followed by the next without `resume`: what came after stays, and is searched again."""
    return [ask_cell("seek", tick=tick, epoch=0) for tick in moments()]


def parts():
    """Each reset begins a part of the history."""
    part = [ask_cell("send", text="B+1\r"), ask_cell("step", ticks=20, fields=[]), ask_cell("reset")]
    return [*(MOMENTS * part), ask_cell("history")]


def branches():
    return [ask_cell("branch", tick=tick, epoch=0) for tick in moments()]


ATTACKS = [
    Beside("past.look", flood(looks()), options=TWO),
    Beside("past.look-at-all", flood(looks(channels=CHANNELS)), options=TWO),
    Beside("past.look-many-clients", flood(looks(), count=20), options=TWO),
    Beside("past.trace", flood(traces(), count=4), options=TWO),
    Beside("past.history", flood([ask_cell("history")], count=4), options=TWO),
    Beside("past.seek", flood(seeks()), options=TWO),
    Beside("past.parts", flood(parts()), options=TWO),
    Beside("past.branch", flood(branches()), options=(*TWO, "--max-cells", 40, "--linger", 0.2)),
]
