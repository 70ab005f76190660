// Plays taught points. It waits by the state, and stops with a reason at a stall, a block, a limit, or when somebody else moves
// the robot. Independent of the page.
import { countsOf, Drive, Stopped } from "../lib/drive.js";
import { speedText } from "../lib/stride.js";

export { Stopped };

export class Player {
  /** As of Drive. */
  constructor(by) {
    this.drive = new Drive(by);
    this.isPlaying = false;
  }

  setRobot(robot) {
    this.drive.setRobot(robot);
  }

  /**
   * Moves through points, which are { point, text }: `text` names one in messages. Calls `onReached(i)` after each.
   * Throws Stopped.
   */
  async play(points, onReached) {
    if (this.isPlaying) throw new Stopped("a program is being played");
    Object.assign(this, { isPlaying: true, percent: null });
    try {
      await this.#begin(points);
      for (const [i, { point, text }] of points.entries()) {
        await this.#toward(text, () => this.#reach(point));
        onReached(i);
      }
    } finally {
      await this.#restoreSpeed();
      this.isPlaying = false;
    }
  }

  async #restoreSpeed() {
    if (this.percent !== null && this.percent !== 100) await this.drive.send(speedText(this.drive.speeds, 100)).catch(() => {});
  }

  /** Stops all motors at once, and the program. */
  stop() {
    return this.drive.stop();
  }

  // Rests of earlier moves would be added to the first ones.
  async #begin(points) {
    const state = await this.drive.begin();
    if (state.moving) throw new Stopped("The robot is moving already. Wait until it rests.");
    const rests = [...state.joints, state.tool].filter(({ error }) => error !== 0);
    if (rests.length > 0) await this.drive.send(rests.map(({ label }) => `${label}X`).join(""));
    this.setsSpeeds = points.some(({ point }) => point.speed_percent !== 100);
  }

  async #toward(text, act) {
    try {
      await act();
    } catch (error) {
      throw error instanceof Stopped ? new Stopped(`Stopped on the way to ${text}: ${error.message}.`) : error;
    }
  }

  async #reach(point) {
    await this.#setSpeed(point.speed_percent);
    await this.drive.go(countsOf(await this.drive.look()), point.joints);
    await this.#close(point.jaws);
    await this.drive.rest(point.pause_s * 1000);
  }

  async #setSpeed(percent) {
    if (!this.setsSpeeds || percent === this.percent) return;
    await this.drive.send(speedText(this.drive.speeds, percent));
    this.percent = percent;
  }

  async #close({ count, grip }) {
    const { label } = this.drive.jaws;
    const { tool } = await this.drive.look();
    if (!grip) return this.drive.go({ [label]: tool.count }, { [label]: count });
    if (tool.holding !== null) return; // held since an earlier point
    if (!(await this.drive.grip(count))) throw new Stopped("the jaws closed on nothing");
  }
}
