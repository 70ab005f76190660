// 3. Home by microswitches: after power-on nobody knows where the arm stands. Each joint has a
// switch that closes at one place of its way. Looking for that place is how a robot finds out.
//
//     java -cp build 3_home.java [HOST [PORT]]

class Home {
    // The elbow comes first, for it lifts the hand off the table; the jaws, joint A, come last.
    static final String[] JOINTS = {"D", "E", "C", "B", "F", "A"};

    // Where their switches are, in counts from the soft home: upper arm upright, forearm level,
    // tool down.
    static final int[] SWITCHES = {40, -40, 40, -25, 30, 16};

    static Robot robot;

    static boolean isClosed(String joint) throws Exception {
        return robot.ask(joint + "V") == 1; // a plain 0 or 1, nothing is added
    }

    static void step(String joint, int counts) throws Exception {
        robot.send(Robot.move(joint, counts) + "\r");
        robot.waitFor(joint); // asks as in example 2, and stops the joint if it cannot go on
    }

    public static void main(String[] args) throws Exception {
        robot = new Robot(args);

        for (int k = 0; k < JOINTS.length; k++) {
            String joint = JOINTS[k];
            int way = SWITCHES[k] > 0 ? 1 : -1;
            while (!isClosed(joint)) step(joint, 5 * way); // quickly, until the switch closes
            while (isClosed(joint)) step(joint, -way); // back, until it opens again
            while (!isClosed(joint)) step(joint, way); // slowly: now we know to the count
            System.out.printf("%s stands on its switch, at %+d%n", joint, SWITCHES[k]);
        }

        // All switches at once: I tells of joints C to F, J of A and B.
        int i = robot.ask("I") - 32;
        int j = robot.ask("J") - 32;
        System.out.println("switches closed: " + i + " of I, " + j + " of J");

        // From here the soft home is as far away as the switches are from it.
        for (int k = 0; k < JOINTS.length; k++) step(JOINTS[k], -SWITCHES[k]);
        System.out.println("at the soft home");

        robot.close();
    }
}
