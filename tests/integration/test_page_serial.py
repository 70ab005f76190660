"""The stand-in of the page for pyserial, as a program sees it."""

import io
import select
import time
import unittest

from page_python import Case, in_page, xr3_page


class SerialPort(Case):
    @in_page
    def test_ports(self, robot):
        import serial
        for name in "/dev/ttyUSB0", "COM3", "rfc2217://localhost:9600", "socket://robot:4000/x", "socket://robot:9601":
            with serial.serial_for_url(name, 9600, bytesize=7, parity="E", stopbits=2) as port:
                self.assertEqual((name, name, True, 7), (port.name, port.portstr, port.is_open, port.bytesize))
        self.assertEqual(["open"] * 4 + ["open_monitor"],
                         [name for name, _ in robot.calls if name.startswith("open")])
        for name, text in (("loop://", "is no port"), ("spy:///dev/ttyUSB0", "is no port"),
                           ("socket://robot", "no port number")):
            with self.subTest(name), self.assertRaisesRegex(serial.SerialException, text):
                serial.serial_for_url(name)

    @in_page
    def test_open_and_close(self, robot):
        import serial
        port = serial.Serial()
        with self.assertRaisesRegex(serial.SerialException, "must be configured"):
            port.open()
        self.assertFalse(port.isOpen())
        port.port = "COM3"
        port.open()
        with self.assertRaisesRegex(serial.SerialException, "already open"):
            port.open()
        held = list(xr3_page.line.lines.values())
        port.close()
        port.close()
        self.assertEqual([("open", 1), ("close", 1)], robot.calls)
        self.assertEqual(-1, held[0].fileno())
        for call in (port.read, lambda: port.write(b""), lambda: port.in_waiting, lambda: port.out_waiting, port.flush,
                     port.fileno, port.reset_input_buffer, port.reset_output_buffer, port.send_break):
            with self.assertRaisesRegex(serial.PortNotOpenError, "not open"):
                call()
        with port:
            self.assertTrue(port.is_open, "opened again")
        self.assertFalse(serial.serial_for_url("COM3", do_not_open=True).is_open)
        robot.open = lambda: (_ for _ in ()).throw(OSError("another line is open"))
        with self.assertRaisesRegex(serial.SerialException, "could not open port COM3: another line is open"):
            port.open()
        self.assertFalse(port.is_open)

    @in_page
    def test_settings(self, robot):
        import serial
        port = serial.Serial("robot")
        for name, value in (("bytesize", 9), ("parity", "X"), ("parity", "NE"), ("stopbits", 3), ("baudrate", 0),
                            ("timeout", -1), ("write_timeout", -1), ("inter_byte_timeout", -1)):
            with self.subTest(name), self.assertRaisesRegex(ValueError, f"Not a valid {name}: {value!r}"):
                setattr(port, name, value)
        port.timeout, port.parity = 3, serial.PARITY_ODD
        self.assertEqual((3, "O", 9600, serial.STOPBITS_ONE, serial.EIGHTBITS),
                         (port.timeout, port.parity, port.baudrate, port.stopbits, port.bytesize))
        self.assertEqual((True, True, True, False), (port.cts, port.dsr, port.cd, port.ri))

    @in_page
    def test_read(self, robot):
        import serial
        for at_ms, part in (0, b"ab"), (400, b"cd"), (5000, b"efgh"):
            robot.arrives(1, part, at_ms)
        port = serial.Serial("robot", timeout=1)
        self.assertEqual((2, 2, 0), (port.in_waiting, port.inWaiting(), port.out_waiting))
        self.assertEqual(b"abcd", port.read(5))
        self.assertEqual(1, time.monotonic(), "one timeout for all")
        port.timeout = 0
        self.assertEqual(b"", port.read(2))
        self.assertEqual(1, time.monotonic())
        port.timeout = None
        self.assertEqual(b"ef", port.read(2))
        self.assertEqual(b"gh", port.read_all())
        self.assertEqual(5, time.monotonic())

    @in_page
    def test_time_between_bytes(self, robot):
        import serial
        for at_ms, part in (500, b"a"), (550, b"b"), (700, b"c"):
            robot.arrives(1, part, at_ms)
        port = serial.Serial("robot", inter_byte_timeout=0.1)
        self.assertEqual(b"ab", port.read(9))
        port.timeout = 0.2
        self.assertEqual(b"c", port.read(9))
        self.assertAlmostEqual(0.8, time.monotonic())

    @in_page
    def test_lines(self, robot):
        import serial
        robot.arrives(1, b"one\ntwo;three\nfour\nfi")
        port = serial.Serial("robot", timeout=1)
        self.assertEqual(b"one\n", port.readline())
        self.assertEqual(b"two;", port.read_until(b";"))
        self.assertEqual(b"thr", port.read_until(size=3))
        self.assertEqual([b"ee\n", b"four\n"], [next(port), next(port)])
        self.assertEqual(b"fi", port.readline())
        robot.arrives(1, b"\0\1\n")
        wrapper = io.TextIOWrapper(io.BufferedReader(port, 1))
        self.assertEqual("\0\1\n", wrapper.readline())
        for call in port.reset_input_buffer, port.flushInput:
            robot.arrives(1, b"left over")
            call()
            self.assertEqual(0, port.in_waiting)

    @in_page
    def test_read_until_has_one_timeout_for_all(self, robot):
        import serial
        for number in range(20):
            robot.arrives(1, b"a", 400 * number)
        port = serial.Serial("robot", timeout=1)
        self.assertEqual(b"aaaa", port.read_until(b"b"))
        self.assertEqual(1.2, time.monotonic(), "the byte that came after the timeout is the last")

    @in_page
    def test_write(self, robot):
        import serial
        robot.room = 6
        port = serial.Serial("robot", write_timeout=2)
        self.assertEqual((2, 1, 2), (port.write(b"E?"), port.write([73]), port.write(memoryview(b"E?"))))
        self.assertEqual(b"E?IE?", robot.sent[1])
        port.flush()
        port.flushOutput()
        with self.assertRaisesRegex(TypeError, "encode to bytes: 'E.'"):
            port.write("E?")
        with self.assertRaisesRegex(serial.SerialTimeoutException, "Write timeout"):
            port.write(b"E?")
        self.assertEqual(2, time.monotonic())
        port.send_break(0.5)
        self.assertEqual(2.5, time.monotonic())
        self.assertTrue(issubclass(serial.SerialTimeoutException, serial.SerialException))
        self.assertTrue(issubclass(serial.SerialException, OSError))

    @in_page
    def test_closed_by_the_robot(self, robot):
        import serial
        robot.arrives(1, b"a")
        robot.arrives(1, b"")
        port = serial.Serial("robot")
        self.assertEqual(b"a", port.read_all())
        self.assertEqual(0, port.in_waiting)
        with self.assertRaisesRegex(serial.SerialException, "has closed the line"):
            port.read()
        with self.assertRaisesRegex(serial.SerialException, "write failed: .*reset"):
            port.write(b"E?")

    @in_page
    def test_select(self, robot):
        import serial
        robot.arrives(1, b"a")
        port = serial.Serial("robot")
        self.assertEqual([port], select.select([port], [], [])[0])

    @in_page
    def test_modules(self, robot):
        import serial.tools.list_ports
        from serial.serialutil import SerialException
        from serial.tools.list_ports import comports, grep
        self.assertIs(serial.SerialException, SerialException)
        port, = comports()
        self.assertEqual(("robot", "The robot of the page", "n/a"), tuple(port))
        self.assertEqual(("robot", "robot - The robot of the page"), (port.device, str(port)))
        self.assertEqual((1, 0), (len(list(grep("ROB"))), len(list(grep("usb")))))
        self.assertTrue(serial.Serial(serial.tools.list_ports.comports()[0].device).is_open)
        with self.assertRaises(ModuleNotFoundError):
            import serial.threaded

    @in_page
    def test_constants_are_those_of_pyserial(self, robot):
        import serial
        self.assertEqual(("NEOMS", (1, 1.5, 2), (5, 6, 7, 8)), (
            serial.PARITY_NONE + serial.PARITY_EVEN + serial.PARITY_ODD + serial.PARITY_MARK + serial.PARITY_SPACE,
            (serial.STOPBITS_ONE, serial.STOPBITS_ONE_POINT_FIVE, serial.STOPBITS_TWO),
            (serial.FIVEBITS, serial.SIXBITS, serial.SEVENBITS, serial.EIGHTBITS)))


if __name__ == "__main__":
    unittest.main()
