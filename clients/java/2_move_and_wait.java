// 2. Move and wait: send a joint somewhere, and ask until it has arrived.
//
//     java -cp build 2_move_and_wait.java [HOST [PORT]]

import java.io.IOException;

class MoveAndWait {
    /**
     * Asks how far there is still to go until nothing is left. Between two questions it does
     * nothing for a while. A joint that is blocked would let us ask forever: we give up after
     * STANDS_MS without a count.
     */
    static void waitFor(Robot robot, String joint) throws IOException, InterruptedException {
        int left = robot.toGo(joint);
        int stillMs = 0; // for how long the counter has not changed
        while (left > 0) {
            System.out.println("  " + left + " counts to go");
            robot.pause();
            int before = left;
            left = robot.toGo(joint);
            stillMs = left == before ? stillMs + Robot.PAUSE_MS : 0;
            if (stillMs >= Robot.STANDS_MS) {
                robot.send(joint + "X"); // forget the rest, or the next move would add to it
                Robot.checkArrived(joint, left);
            }
        }
        System.out.println(joint + " is there");
    }

    static void moveAndWait(String[] args) throws IOException, InterruptedException {
        Robot robot = new Robot(args);

        // The shoulder shall turn by 50 counts of its encoder. The carriage return tells the
        // robot that the number ends here. It starts to move, and answers nothing: so we ask.
        System.out.println("E+50");
        robot.send("E+50\r");
        waitFor(robot, "E");

        // And back again.
        System.out.println("E-50");
        robot.send("E-50\r");
        waitFor(robot, "E");

        robot.close();
    }

    public static void main(String[] args) throws InterruptedException {
        try {
            moveAndWait(args);
        } catch (IOException why) { // Robot.java says in words what went wrong
            System.err.println(why.getMessage());
            System.exit(1);
        }
    }
}
