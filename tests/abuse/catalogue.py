"""All attacks, by name."""

import connections
import devices
import foxglove_clients
import http_requests
import json_requests
import lines
import logs
import many_cells
import memory
import past
import ptys
import websocket

THEMES = (lines, ptys, devices, http_requests, json_requests, websocket, foxglove_clients, memory, connections, logs, many_cells, past)
ATTACKS = [attack for theme in THEMES for attack in theme.ATTACKS]


def find(name):
    return next(attack for attack in ATTACKS if attack.name == name)
