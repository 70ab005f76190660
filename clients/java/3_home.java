// 3. Home by microswitches: after power-on the position of the arm is unknown. Each joint has a
// switch that closes at a known position. Searching for it tells where the joint is.
//
//     java -cp build 3_home.java [HOST [PORT]]

import java.io.IOException;

class Home {
    // The elbow comes first, since it lifts the hand off the table; the jaws, joint A, come last.
    static final String[] JOINTS = {"D", "E", "C", "B", "F", "A"};

    // Where their switches are, in counts from the soft home: upper arm upright, forearm level,
    // tool down.
    static final int[] SWITCHES = {40, -40, 40, -25, 30, 16};

    // More counts than the full travel of any joint.
    static final int FARTHEST = 2500;

    static Robot robot;

    static boolean isClosed(String joint) throws IOException {
        return robot.ask(joint + "V") == 1; // 0 or 1, without the 32
    }

    /** Moves the joint and returns the counts that were left, 0 if it has arrived. */
    static int step(String joint, int counts) throws IOException, InterruptedException {
        robot.send(Robot.move(joint, counts) + "\r");
        return robot.waitFor(joint); // as in example 2; cancels the move of a blocked joint
    }

    /** Moves in steps of `counts` until the switch is closed (true) or open (false). */
    static void search(String joint, int counts, boolean closed)
            throws IOException, InterruptedException {
        for (int gone = 0; isClosed(joint) != closed; gone += Math.abs(counts)) {
            if (step(joint, counts) == Math.abs(counts)) {
                throw new IOException(joint + " does not move, and its switch is not found. Is it "
                        + "at a limit, or stalled? Is the clock paused? This example is for the "
                        + "Rhino XR-3, in the profile paper");
            }
            if (gone > FARTHEST) {
                throw new IOException(joint + " went " + gone + " counts, and its switch is not "
                        + "found. This example is for the Rhino XR-3, in the profile paper");
            }
        }
    }

    static void home(String[] args) throws IOException, InterruptedException {
        robot = new Robot(args);

        // Some controllers report their switches inverted. The answer to I shows it: the highest of
        // its six bits belongs to no switch and should be 0.
        if (robot.ask("I") - 32 >= 32) {
            throw new IOException("the switches of D and of all other joints read 1 when they are "
                    + "open, as in the profile mark3. This example is for the profile paper");
        }

        for (int k = 0; k < JOINTS.length; k++) {
            String joint = JOINTS[k];
            int way = SWITCHES[k] > 0 ? 1 : -1;
            search(joint, 5 * way, true); // quickly, until the switch closes
            search(joint, -5 * way, false); // back, until it opens again
            search(joint, way, true); // slowly, to find the exact count at which it closes
            System.out.printf("%s is on its switch, at %+d%n", joint, SWITCHES[k]);
        }

        // All switches at once: I reports joints C to F, J reports A and B.
        int i = robot.ask("I") - 32;
        int j = robot.ask("J") - 32;
        System.out.println("switches closed: " + i + " of I, " + j + " of J");

        // The soft home is at count 0: move each joint back by the count of its switch.
        for (int k = 0; k < JOINTS.length; k++) {
            Robot.checkArrived(JOINTS[k], step(JOINTS[k], -SWITCHES[k]));
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
