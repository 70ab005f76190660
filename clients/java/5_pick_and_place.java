// 5. Pick and place at known positions: take the red block from where it lies, and put it somewhere
// else.
//
//     java -cp build 5_pick_and_place.java [HOST [PORT]]
//
// The arm has to be at its soft home, as it is when the simulator starts, or after 3_home.java.

import java.io.IOException;
import java.util.Map;

class PickAndPlace {
    // Where the motors have to be, in counts from the soft home, for the tool to be at a place.
    // `xr3 kin --pose 262,0,20 --down 90` works out the one of the block: its middle is at x 262,
    // y 0 and z 20 mm, and it is turned by 90 degrees. "Above" is 100 mm higher up. On a real arm
    // one would drive there by hand and write the counts down. They are those of F, E, D, C and B.
    static final Map<String, Integer> ABOVE_BLOCK = Robot.arm(0, 242, -440, 0, 0);
    static final Map<String, Integer> AT_BLOCK = Robot.arm(0, 449, -625, 0, 0);
    static final Map<String, Integer> ABOVE_PLACE = Robot.arm(0, 483, -238, 0, 288); // x 400, y 0
    static final Map<String, Integer> AT_PLACE = Robot.arm(0, 623, -354, 0, 288);
    static final int SHUT = -64; // where the jaws, joint A, meet
    static final Map<String, Integer> HOME = Robot.arm(0, 0, 0, 0, 0);

    static void pickAndPlace(String[] args) throws IOException, InterruptedException {
        Robot robot = new Robot(args);

        // robot.go() brings all joints to these counts together. A single move is at most 127
        // counts long, so go() sends several, and waits after each.
        robot.go(Map.of("A", 16));
        System.out.println("the jaws are open");
        robot.go(ABOVE_BLOCK);
        System.out.println("above the block");
        robot.go(AT_BLOCK);

        // Close the jaws much further than the block lets them. They stop at the block, and what is
        // left to go tells how wide it is: A is 50.8 mm open at count 0, and a count is 0.79375 mm.
        // waitFor() also clears what is left (AX), or the jaws would go on pressing.
        robot.send("A-100\r");
        int jaws = 16 - (100 - robot.waitFor("A"));
        robot.at.put("A", jaws);
        if (jaws <= SHUT) {
            System.err.println("the jaws closed on nothing: is the block at x 262, y 0 mm? Restart "
                    + "the server to have it there (the examples 3 to 6 are for the Rhino XR-3 "
                    + "with its own workcell, in the profile paper)");
            robot.go(ABOVE_BLOCK); // back to where the examples begin
            robot.go(HOME);
            robot.go(Map.of("A", 0));
            System.exit(1);
        }
        System.out.printf("the jaws closed on %.1f mm%n", 50.8 + 0.79375 * jaws);

        robot.go(ABOVE_BLOCK);
        System.out.println("lifted");
        robot.go(ABOVE_PLACE);
        robot.go(AT_PLACE);
        System.out.println("at its new place");
        robot.go(Map.of("A", 16));
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
