// 3. Home by microswitches: after power-on the position of the arm is unknown. Each joint has a
// switch that closes at a known position. Searching for it tells where the joint is.
//
//     java -cp build 3_home.java [HOST [PORT]]

import java.io.IOException;

class Home {
    // The jaws come first: they show how a closed switch reads. The elbow, joint D, follows, since
    // it lifts the hand off the table.
    static final String[] JOINTS = {"A", "D", "E", "C", "B", "F"};
    static final int JAWS = 0, ELBOW = 1, SHOULDER = 2;

    // Where their switches close, in counts from the soft home: upper arm upright, forearm level,
    // tool down. Seen from there each is open before this count, and closed from it on: for a few
    // dozen counts on a real arm, for longer in the simulator.
    static final int[] SWITCHES = {-16, 40, -40, 40, -25, 30};

    // One byte reports several switches: I those of joints C to F, J those of A and B. Each has one
    // bit.
    static final String[] INQUIRIES = {"J", "I", "I", "I", "J", "I"};
    static final int[] BITS = {16, 2, 4, 1, 32, 8};

    static final int STEP = 10; // counts of one move of the search; a switch is closed for longer
    static final int FAR = 1600; // more counts than any joint has from a limit to its switch
    static final int LEAN = 400; // counts that bring the shoulder forward from its limit

    static Robot robot;

    static int closed; // the reading of a closed switch, 0 or 1

    /** The bit of the switch. Some controllers report a closed switch as 1, others as 0. */
    static int readSwitch(int k) throws IOException {
        return ((robot.ask(INQUIRIES[k]) - 32) & BITS[k]) != 0 ? 1 : 0;
    }

    /** Moves the joint and returns the counts that were left, 0 if it has arrived. */
    static int step(int k, int counts) throws IOException, InterruptedException {
        robot.send(Robot.move(JOINTS[k], counts) + "\r");
        return robot.waitFor(JOINTS[k]); // as in example 2; cancels the move of a blocked joint
    }

    /**
     * Moves in steps of `counts` until the switch changes. Returns false if it does not within
     * `farthest` counts, or before the joint is blocked.
     */
    static boolean changes(int k, int counts, int farthest)
            throws IOException, InterruptedException {
        int before = readSwitch(k);
        for (int gone = 0; gone < farthest; gone += Math.abs(counts)) {
            int left = step(k, counts);
            if (readSwitch(k) != before) return true;
            if (left > 0) return false;
        }
        return false;
    }

    /**
     * Moves until the switch closes, usually away from the soft home first. Returns false if it
     * does not close.
     */
    static boolean search(int k, int away) throws IOException, InterruptedException {
        // Forwards first: a shoulder that leans back folds the arm into its base.
        if (k == SHOULDER) return changes(k, STEP, LEAN) || changes(k, -STEP, 2 * FAR);

        if (changes(k, STEP * away, FAR)) return true;
        // The shoulder may lean far back: it must not when the forearm comes down.
        if (k == ELBOW) changes(SHOULDER, STEP, LEAN);
        return changes(k, -STEP * away, 2 * FAR);
    }

    /** Moves to the count at which the switch closes. Returns false if it does not change. */
    static boolean findNearEdge(int k) throws IOException, InterruptedException {
        int away = SWITCHES[k] > 0 ? 1 : -1;
        if (readSwitch(k) != closed && !search(k, away)) return false;
        // Back until the switch opens, and then count by count until it closes.
        return changes(k, -STEP * away, FAR) && changes(k, away, FAR);
    }

    static void home(String[] args) throws IOException, InterruptedException {
        robot = new Robot(args);

        // The open jaws are at the end of their travel, and on their switch. It opens when they
        // close.
        changes(JAWS, -STEP, FAR);
        closed = readSwitch(JAWS);

        // A shoulder on its switch may lean far back: it comes forward before the forearm moves.
        if (readSwitch(SHOULDER) == closed) findNearEdge(SHOULDER);

        for (int k = 0; k < JOINTS.length; k++) {
            if (!findNearEdge(k)) {
                throw new IOException("the switch of " + JOINTS[k] + " does not change. Is the "
                        + "joint blocked at a limit, or the arm stalled? Is the clock paused? (The "
                        + "examples 3 to 6 are for the Rhino XR-3 with its own workcell)");
            }
            System.out.printf("%s is on its switch, at %+d%n", JOINTS[k], SWITCHES[k]);
        }

        // All switches at once. J also reports four input lines, in its bits 1 to 8.
        int i = robot.ask("I") - 32;
        int j = (robot.ask("J") - 32) & 48;
        System.out.println("a closed switch reads " + closed + "; the switches of I are " + i
                + ", those of J " + j);

        // The soft home is at count 0: move each joint back by the count of its switch.
        for (int k = 0; k < JOINTS.length; k++) {
            Robot.checkArrived(JOINTS[k], step(k, -SWITCHES[k]));
        }
        System.out.println("at the soft home");

        robot.close();
    }

    public static void main(String[] args) throws InterruptedException {
        try {
            home(args);
        } catch (IOException why) {
            System.err.println(why.getMessage());
            System.exit(1);
        }
    }
}
