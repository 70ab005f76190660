#!/usr/bin/python3
"""The load of one attack. Runs until it is killed. Usage: load.py ATTACK ROBOT_PORT MONITOR_PORT [PATH
[DESCRIPTOR]]: the serial port of the server, and the device's end of it."""

import os
import pathlib
import resource
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "integration"))

# The attack must load the server, and not the scheduler of a machine with two cores.
NICENESS = 10


def main():
    import catalogue
    from target import Target
    _, name, robot_port, monitor_port, *port = sys.argv
    os.nice(NICENESS)
    _, most = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))
    catalogue.find(name).load(Target(int(robot_port), int(monitor_port), *port))


if __name__ == "__main__":
    main()
