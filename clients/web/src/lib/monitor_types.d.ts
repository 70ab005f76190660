// The messages of the monitor channel, as far as the page uses them; lengths in the unit of the robot's file, or in mm where
// a name says so.
export type Joint = {
  label: string; name: string; variable?: "theta" | "d"; kind?: string; theta_deg?: number; d?: number; home?: number;
  direction: number; precision: number; limits: [number, number]; speed: number;
};
export type Robot = { name: string; length_unit: string; joints: Joint[]; tool: Joint & { home: number }; carousel: Joint | null; coupling: [number, number][] };
export type Model = { robot: Robot; workcell: any };
export type Motor = {
  label: string; value: number; unit: string; count: number; error: number; speed: number; switch: boolean; blocked: string | null;
};
export type State = {
  epoch: number; tick: number; joints: Motor[]; tool: Motor & { xyz_mm: [number, number, number]; holding: string | null };
  moving: boolean; stalled: string | null; enabled: boolean; clock: { mode: "real" | "manual" | "bytes"; rate: number; past?: boolean };
  device?: { open: boolean; engaged: boolean; path: string }; blocks: any[]; io: any;
};
/** A cell in a message of the channel `overview`. */
export type Cell = {
  name: string; robot: string; robot_port: number | null; lines: number; peer: string | null; moving: boolean; stalled: string | null;
  holding: string | null; recording_failed: boolean; last_input_tick: number | null; joints: number[]; tool: number;
};
