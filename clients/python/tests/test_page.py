"""show(): the address of the page, and the frame in which a notebook displays it."""

import os
import unittest
from html.parser import HTMLParser
from unittest import mock

import context  # noqa: F401
import xr3


class Frame(HTMLParser):
    """The attributes of the only element."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.attributes: dict = {}
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        assert tag == "iframe" and not self.attributes, tag
        self.attributes = dict(attrs)


class Show(unittest.TestCase):
    def setUp(self):
        environment = mock.patch.dict(os.environ, {"XR3_HOST": "", "XR3_MONITOR_PORT": ""})
        environment.start()
        self.addCleanup(environment.stop)

    def test_the_address_is_that_of_the_monitor_port(self):
        self.assertEqual("http://localhost:9601/", xr3.show().address)
        self.assertEqual("http://robot.lab:7/cell/a%2Fb", xr3.show("robot.lab", "7", cell="a/b").address)
        self.assertEqual("http://[::1]:7/", xr3.show("::1", 7).address)
        with mock.patch.dict(os.environ, {"XR3_HOST": "robot.lab", "XR3_MONITOR_PORT": "9701"}):
            self.assertEqual("http://robot.lab:9701/", xr3.show().address)

    def test_a_notebook_displays_a_frame_and_others_the_address(self):
        link = "https://page.school/?a=1&b=\"2\"#xr3=abc"
        shown = xr3.show(here=link, height=450)
        frame = Frame(shown._repr_html_()).attributes
        self.assertEqual((link, "450"), (frame["src"], frame["height"]))
        self.assertIn(link, repr(shown))

    def test_wrong_arguments_are_refused_with_what_is_allowed(self):
        for allowed, arguments in [("1 to 65535", {"port": 70000}), ("http://", {"here": "javascript:alert(1)"}),
                                   ("http://", {"here": "build/playground"}), ("either", {"here": "http://a/", "port": 9}),
                                   ("above 0", {"height": 0}), ("above 0", {"height": "600px"})]:
            with self.subTest(arguments), self.assertRaisesRegex(ValueError, allowed):
                xr3.show(**arguments)


if __name__ == "__main__":
    unittest.main()
