"""The telnet session of the README ("Two minutes"), typed unchanged; the table below it has the reply. The clock is
manual; two seconds pass before the inquiry."""
# labels: full

import pathlib
import re
import unittest

from support import ROOT, Server, counts
from telnet import Telnet, needs

SESSION = re.compile(r"^\$ telnet localhost 9600\n(.*?)^```", re.DOTALL | re.MULTILINE)
TICKS_BEFORE_ASKING = 2000


def session():
    """(input, the reply that its row of the table has, or None) of each line that is typed."""
    readme = pathlib.Path(ROOT, "README.md").read_text(encoding="utf-8")
    replies = dict(re.findall(r"^\| `(\S+)` \|.* reply.* `(.)`", readme, re.MULTILINE))
    return [(typed, replies.get(typed)) for typed in SESSION.search(readme)[1].splitlines()]


@needs("telnet", "inetutils-telnet")
class ThirtySeconds(unittest.TestCase):
    def test_commands_give_the_printed_replies(self):
        lines = session()
        self.assertEqual([("E5S", None), ("E+50", None), ("E?", "H"), ("A$", None), ("Q", None)], lines)
        received = 0
        with Server() as xr3, xr3.monitor() as monitor, Telnet(xr3.robot_port) as telnet:
            before = monitor.get("joints")
            for typed, reply in lines:
                if reply is not None:
                    state = monitor.step(TICKS_BEFORE_ASKING)
                    self.assertEqual("E10", counts(state))
                    self.assertEqual(reply, telnet.inquire(typed.encode()).decode())
                else:
                    telnet.type(typed.encode() + b"\n")
                received += len(typed) + 2  # telnet sends CR LF
                state = monitor.step(0, after=(1, received))
            self.assertEqual("", counts(state), "home")
            self.assertEqual(before["joints"], state["joints"], "with the original speeds")


if __name__ == "__main__":
    unittest.main()
