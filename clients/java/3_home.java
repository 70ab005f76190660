// 3. Home by microswitches: after power-on nobody knows where the arm stands. Each joint has a
// switch that closes at one place of its way. Looking for that place is how a robot finds out.
//
//     java -cp build 3_home.java [HOST [PORT]]

import java.io.IOException;

class Home {
    // The elbow comes first, for it lifts the hand off the table; the jaws, joint A, come last.
    static final String[] JOINTS = {"D", "E", "C", "B", "F", "A"};

    // Where their switches are, in counts from the soft home: upper arm upright, forearm level,
    // tool down.
    static final int[] SWITCHES = {40, -40, 40, -25, 30, 16};

    // No joint has so many counts to go from one end of its way to the other.
    static final int FARTHEST = 2500;

    static Robot robot;

    static boolean isClosed(String joint) throws IOException {
        return robot.ask(joint + "V") == 1; // a plain 0 or 1, nothing is added
    }

    /** Moves the joint and returns how many counts were left, if it could not go on. */
    static int step(String joint, int counts) throws IOException, InterruptedException {
        robot.send(Robot.move(joint, counts) + "\r");
        return robot.waitFor(joint); // asks as in example 2, and stops a joint that stands
    }

    /** Steps of so many counts until the switch is closed, or until it is open. */
    static void search(String joint, int counts, boolean closed)
            throws IOException, InterruptedException {
        for (int gone = 0; isClosed(joint) != closed; gone += Math.abs(counts)) {
            if (step(joint, counts) == Math.abs(counts)) {
                throw new IOException(joint + " does not move, and its switch is not found. Is it "
                        + "at a limit, or stalled? Does time stand? This example is for the Rhino "
                        + "XR-3, in the profile paper");
            }
            if (gone > FARTHEST) {
                throw new IOException(joint + " went " + gone + " counts, and its switch is not "
                        + "found. This example is for the Rhino XR-3, in the profile paper");
            }
        }
    }

    static void home(String[] args) throws IOException, InterruptedException {
        robot = new Robot(args);

        // A robot may tell of its switches the other way round. I shows it: the highest of its
        // six bits belongs to no switch, and should be 0.
        if (robot.ask("I") - 32 >= 32) {
            throw new IOException("the switches of D and of all other joints tell 1 when they are "
                    + "open, as in the profile mark3. This example is for the profile paper");
        }

        for (int k = 0; k < JOINTS.length; k++) {
            String joint = JOINTS[k];
            int way = SWITCHES[k] > 0 ? 1 : -1;
            search(joint, 5 * way, true); // quickly, until the switch closes
            search(joint, -5 * way, false); // back, until it opens again
            search(joint, way, true); // slowly: now we know to the count where it closes
            System.out.printf("%s stands on its switch, at %+d%n", joint, SWITCHES[k]);
        }

        // All switches at once: I tells of joints C to F, J of A and B.
        int i = robot.ask("I") - 32;
        int j = robot.ask("J") - 32;
        System.out.println("switches closed: " + i + " of I, " + j + " of J");

        // From here the soft home is as far away as the switches are from it.
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
