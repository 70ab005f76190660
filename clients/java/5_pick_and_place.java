// 5. Pick and place at known positions: pick up the red block and put it down elsewhere.
//
//     java -cp build 5_pick_and_place.java [HOST [PORT]]
//
// The arm must be at its soft home, as when the simulator starts or after 3_home.java.

import java.io.IOException;
import java.util.Map;

class PickAndPlace {
    // Motor counts from the soft home for each position of the tool.
    // `xr3 kin --pose 262,0,20 --down 90` computes those at the block, whose centre is at x 262, y
    // 0 and z 20 mm, with a yaw of 90 degrees. "Above" is 100 mm higher. On a real arm one would
    // move there manually and note the counts. The order is F, E, D, C, B.
    static final Map<String, Integer> ABOVE_BLOCK = Robot.arm(0, 242, -440, 0, 0);
    static final Map<String, Integer> AT_BLOCK = Robot.arm(0, 449, -625, 0, 0);
    static final Map<String, Integer> ABOVE_PLACE = Robot.arm(0, 483, -238, 0, 288); // x 400, y 0
    static final Map<String, Integer> AT_PLACE = Robot.arm(0, 623, -354, 0, 288);
    static final int SHUT = 64; // count of A at which the jaws are closed
    static final Map<String, Integer> HOME = Robot.arm(0, 0, 0, 0, 0);

    static void pickAndPlace(String[] args) throws IOException, InterruptedException {
        Robot robot = new Robot(args);

        // robot.go() moves all joints to these counts together. A single move is limited to 127
        // counts, so go() sends several and waits after each.
        robot.go(Map.of("A", -16));
        System.out.println("the jaws are open");
        robot.go(ABOVE_BLOCK);
        System.out.println("above the block");
        robot.go(AT_BLOCK);

        // Command the jaws to close much further than the block permits. They stop at the block,
        // and the remaining counts give its width: A is 50.8 mm open at count 0, and a count is
        // 0.79375 mm. waitFor() also cancels the remaining counts (AX); otherwise the jaws would
        // keep pressing.
        robot.send("A+90\r");
        int jaws = -16 + (90 - robot.waitFor("A"));
        robot.at.put("A", jaws);
        if (jaws >= SHUT) {
            System.err.println("the jaws closed on nothing: is the block at x 262, y 0 mm? Restart "
                    + "the server to have it there (the examples 3 to 6 are for the Rhino XR-3 "
                    + "with its own workcell)");
            robot.go(ABOVE_BLOCK); // back to the start position
            robot.go(HOME);
            robot.go(Map.of("A", 0));
            System.exit(1);
        }
        System.out.printf("the jaws closed on %.1f mm%n", 50.8 - 0.79375 * jaws);

        robot.go(ABOVE_BLOCK);
        System.out.println("lifted");
        robot.go(ABOVE_PLACE);
        robot.go(AT_PLACE);
        System.out.println("at its new place");
        robot.go(Map.of("A", -16));
        System.out.println("let go");
        robot.go(ABOVE_PLACE);
        robot.go(HOME);
        robot.go(Map.of("A", 0));
        System.out.println("back at the start");

        robot.close();
    }

    public static void main(String[] args) throws InterruptedException {
        try {
            pickAndPlace(args);
        } catch (IOException why) {
            System.err.println(why.getMessage());
            System.exit(1);
        }
    }
}
