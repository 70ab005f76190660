"""The state of the model, in the form of the monitor's `state` and `display` (docs/monitor.md). Lengths are in mm."""

SPACE = 32


def state(controller):
    machine, robot = controller.machine, controller.robot
    motors = {motor.label: _motor(machine, motor, place) for place, motor in enumerate(robot.motors)}
    return {**motors, "tip": [length / 1000 for length in robot.tip(machine.positions)],
            "I": controller.query_switches_i()[0] - SPACE, "J": controller.query_switches_j()[0] - SPACE,
            "inputs": controller.inputs, "outputs": controller.outputs, "aux": controller.aux,
            "moving": any(map(machine.will_count, range(machine.size))),
            "stalled": machine.stalled, "enabled": controller.enabled, "tick": machine.tick,
            "display": controller.display}


def _motor(machine, motor, place):
    return {"count": machine.counts[place], "error": machine.errors[place], "speed": machine.speeds[place],
            "value": motor.variable(machine.positions[place]),
            "switch": machine.is_closed(place), "moving": machine.will_count(place),
            "blocked": "limit" if machine.is_blocked(place) else None}
