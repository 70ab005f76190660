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
  moving: boolean; stalled: string | null; enabled: boolean; clock: { mode: "real" | "manual" | "bytes"; rate: number; past?: boolean; frozen?: boolean };
  device?: { open: boolean; engaged: boolean; path: string }; blocks: any[]; io: any;
};
/** A cell in a message of the channel `overview`; moments are Unix ms. */
export type Cell = {
  name: string; robot: string; robot_port: number | null; lines: number; peer: string | null; moving: boolean; stalled: string | null;
  holding: string | null; recording_failed: boolean; last_input_tick: number | null; joints: number[]; tool: number;
  paused: boolean; frozen: boolean; coming_back: boolean; viewers: number; last_input_at: number | null; stalled_at: number | null;
  last_command: { text: string; count: number; has_reply: boolean } | null; last_warning: { text: string; at: number; count: number } | null;
  goals: boolean[] | null; points: [number, number] | null;
};
/** A message of the channel `overview`; `now` is the server's time, Unix ms. */
export type Overview = { whole: boolean; now: number; cells: Cell[]; closed: string[] };
