"""Drives an xr3 robot from Python, using only the standard library.

    import xr3
    with xr3.Robot() as robot:
        robot.send("E+50\\r")
        print(robot.to_go("E"), "counts to go")

`Robot` uses the serial protocol of a real arm (port 9600), `Monitor` the JSON protocol that only
the simulator has (port 9601). `RHINO_XR3`, `ADEPT_ONE` and `INTELLEDEX_660` describe the arms and
compute their kinematics, `Arm.load(file)` does so for any robot file; `Picture` and `Patch` find
blocks in the camera's picture. `show()` displays the robot in a notebook. `Server` starts a server
of its own, and `judge()` runs a program against a fresh robot and judges it.
"""

from xr3.arms import ADEPT_ONE, ARMS, INTELLEDEX_660, RHINO_XR3
from xr3.joints import Jaws, Joint, Pose, Switch, Unreachable
from xr3.kinematics import Arm
from xr3.monitor import Monitor, MonitorError
from xr3.page import show
from xr3.program import ServerError
from xr3.robot import Robot, RobotError, connect
from xr3.server import Server
from xr3.verdict import Verdict, judge
from xr3.vision import Camera, Patch, Picture

__version__ = "0.10.0"  # the version of the xr3 server in this repository

__all__ = ["ADEPT_ONE", "ARMS", "Arm", "Camera", "INTELLEDEX_660", "Jaws", "Joint", "Monitor",
           "MonitorError", "Patch", "Picture", "Pose", "RHINO_XR3", "Robot", "RobotError",
           "Server", "ServerError", "Switch", "Unreachable", "Verdict", "connect", "judge", "show"]
