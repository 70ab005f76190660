"""An example of a check: reads the positions of the joints from the monitor port."""

import json
import os
import urllib.request

where = f"http://{os.environ['XR3_HOST']}:{os.environ['XR3_MONITOR_PORT']}/state"
with urllib.request.urlopen(where) as answer:
    state = json.load(answer)

counts = {joint["label"]: joint["count"] for joint in state["joints"]}
assert counts == {"F": 0, "E": 50, "D": 0, "C": 0, "B": 0}, counts
assert state["stalled"] is None
print("the arm is where it should be")
