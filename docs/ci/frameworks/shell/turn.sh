#!/usr/bin/env bash
# The program under test: turns the base. It finds the robot by XR3_HOST and XR3_PORT.
cd "$(dirname "$0")" || exit
. ./robot.sh
robot_go F 40
