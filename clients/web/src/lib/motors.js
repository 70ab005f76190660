// The motors of a robot file, in the order of a state: the joints from the base, the carousel if
// there is one, then the tool.

const beside = ({ carousel }) => (carousel ? [carousel] : []);

/** Label, name and limits of every motor. */
export const motorFiles = (robot) => [...robot.joints, ...beside(robot), { ...robot.tool, name: "tool" }];

/** The labels of a state's `joints`. */
export const jointLabels = (robot) => [...robot.joints, ...beside(robot)].map(({ label }) => label);
