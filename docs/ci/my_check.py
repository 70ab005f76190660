"""An example of a check: reads the positions of the joints from the monitor port, which needs the token."""

import json
import os
import socket

monitor = socket.create_connection((os.environ["XR3_HOST"], int(os.environ["XR3_MONITOR_PORT"])))
with monitor, monitor.makefile("rw", encoding="utf-8") as lines:
    for request in ({"op": "auth", "id": 1, "token": os.environ["XR3_TOKEN"]},
                    {"op": "get", "id": 2, "channel": "state"}):
        print(json.dumps(request), file=lines, flush=True)
    state = next(message for message in map(json.loads, lines) if message["op"] == "state")

counts = {joint["label"]: joint["count"] for joint in state["joints"]}
assert counts == {"F": 0, "E": 50, "D": 0, "C": 0, "B": 0}, counts
assert state["stalled"] is None
print("the arm is where it should be")
