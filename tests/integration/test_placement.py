"""Warnings on the monitor port when a pick-and-place program fails: a block is released in the air or inside another
one, or the jaws stop at a block's width."""

import unittest

from support import Server, drive

AT_RED, ABOVE_RED = {"E": 449, "D": -625}, {"E": 242, "D": -440}
AT_PLACE, ABOVE_PLACE = {"E": 623, "D": -354, "B": 288}, {"E": 483, "D": -238, "B": 288}  # x 400, y 0
OPEN, TO_THE_WIDTH = 16, 39  # counts of A: fully open; from there to the 32 mm of the red block


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
        self.send("A-100\r")
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
        self.send("A+20\r")
        self.assertEqual(["grasped grasped: the jaws hold block red", "released released: block red released"],
                         self.events())

    def test_a_block_released_in_the_air(self):
        self.pick_red()
        self.go(**ABOVE_PLACE)  # and the program forgets to go down
        self.events()
        self.send("A+20\r")
        released, warning = self.events()
        self.assertEqual("released released: block red released", released)
        self.assertEqual("warning released_in_air: block red was released 99.977 mm above the work surface and stays "
                         "in the air: release it lower", warning)
        self.xr3.wait_log("cell @[0-9]+: released_in_air: block red was released 99.977 mm")

    def test_a_block_released_in_the_air_above_another_one(self):
        self.monitor.call("block_move", name="blue", xyz_mm=[400, 0, 15])
        self.pick_red()
        self.go(**ABOVE_PLACE)
        self.events()
        self.send("A+20\r")
        self.assertEqual("warning released_in_air: block red was released 69.977 mm above block blue and stays in the "
                         "air: release it lower", self.events()[-1])

    def test_a_block_released_inside_another_one(self):
        self.monitor.call("block_move", name="blue", xyz_mm=[380, 0, 15])
        self.pick_red()
        self.go(**ABOVE_PLACE)
        self.go(**AT_PLACE)
        self.events()
        self.send("A+20\r")
        self.assertEqual(["released released: block red released",
                          "warning blocks_overlap: block red overlaps block blue: put it where no block is"],
                         self.events())

    def test_a_call_that_puts_a_block_into_another_one(self):
        self.monitor.call("block_move", name="blue", xyz_mm=[270, 0, 15])
        self.assertEqual(["warning blocks_overlap: block blue overlaps block red: put it where no block is"],
                         self.events())

    def test_jaws_that_stop_at_the_width_of_a_block(self):
        self.go(**AT_RED)
        self.send(f"A-{TO_THE_WIDTH}\r")
        self.assertEqual(["warning jaws_touch: the jaws stopped at the width of block red and do not hold it: close "
                          "them further"], self.events())
        self.assertIsNone(self.monitor.get("tool")["tool"]["holding"])
        self.send("A-1\r")
        self.assertEqual(["grasped grasped: the jaws hold block red"], self.events())

    def test_a_soft_home_drops_the_block_on_the_line_that_asked_for_it(self):
        self.pick_red()
        self.events()
        self.send("A$")
        released, warning, homed = self.events()
        self.assertEqual("released released: block red released", released)
        self.assertTrue(warning.startswith("warning released_in_air: block red was released "), warning)
        self.assertEqual("homed homed: soft home by A$", homed)
        event, = (event for event in self.monitor.recall("event", since=0) if event["event"] == "warning")
        self.assertEqual((1, "4124", 1), (event["line"], event["hex"], event["count"]))


if __name__ == "__main__":
    unittest.main()
