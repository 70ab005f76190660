"""All attacks, by name."""

import connections
import http_requests
import json_requests
import lines
import logs
import memory
import websocket

ATTACKS = [attack for theme in (lines, http_requests, json_requests, websocket, memory, connections, logs)
           for attack in theme.ATTACKS]


def find(name):
    return next(attack for attack in ATTACKS if attack.name == name)
