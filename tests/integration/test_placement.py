"""The warning on the monitor port and in the log when a pick-and-place program releases a block in the air.
(tests/core has the other failures: Placement, Grasp.)"""

import unittest

from support import Server, drive

AT_RED, ABOVE_RED = {"E": 449, "D": -625}, {"E": 242, "D": -440}
AT_PLACE, ABOVE_PLACE = {"E": 623, "D": -354, "B": 288}, {"E": 483, "D": -238, "B": 288}  # x 400, y 0
OPEN = -16  # counts of A


class Placement(unittest.TestCase):
    def setUp(self):
        self.xr3 = self.enterContext(Server())
        self.monitor = self.enterContext(self.xr3.monitor())
        self.line = self.enterContext(self.xr3.line())
        self.at = {}
        self.seen = 0
        self.go(A=OPEN)

    def go(self, **targets):
        """Moves motors to these counts."""
        drive(self.line, self.monitor, **{label: count - self.at.get(label, 0) for label, count in targets.items()})
        self.at |= targets

    def send(self, text):
        self.line.send(text)
        self.monitor.settle(after=self.line)

    def pick_red(self):
        self.go(**ABOVE_RED)
        self.go(**AT_RED)
        self.send("A+100\r")
        self.send("AX")
        self.go(**ABOVE_RED)

    def events(self):
        """The events since the last call but for moves and switches, as `kind code: message`."""
        events = self.monitor.recall("event", since=self.seen + 1)
        self.seen = events[-1]["seq"]
        return [f"{event['event']} {event['code']}: {event['message']}" for event in events
                if event["event"] in ("warning", "grasped", "released", "homed")]

    def test_a_block_put_down_on_the_table_is_no_warning(self):
        self.pick_red()
        self.go(**ABOVE_PLACE)
        self.go(**AT_PLACE)
        self.send("A-20\r")
        self.assertEqual(["grasped grasped: the jaws hold block red", "released released: block red released"],
                         self.events())

    def test_a_block_released_in_the_air(self):
        self.pick_red()
        self.go(**ABOVE_PLACE)  # a program that does not go down
        self.events()
        self.send("A-20\r")
        released, warning = self.events()
        self.assertEqual("released released: block red released", released)
        self.assertEqual("warning released_in_air: block red was released 99.977 mm above the work surface and stays "
                         "in the air: release it lower", warning)
        self.xr3.wait_log("cell @[0-9]+: released_in_air: block red was released 99.977 mm")


if __name__ == "__main__":
    unittest.main()
