// The code under test: turns the base. `robot` is that of clients/javascript/robot.js.
export const turnBase = (robot, counts) => robot.go({ F: counts });
