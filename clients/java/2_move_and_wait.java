// 2. Move and wait: move a joint and ask until it has arrived.
//
//     java -cp build 2_move_and_wait.java [HOST [PORT]]

import java.io.IOException;

class MoveAndWait {
    /**
     * Asks for the remaining counts until none are left, with a pause between two questions. A
     * blocked joint would never finish, so the program gives up after STANDS_AFTER equal answers.
     */
    static void waitFor(Robot robot, String joint) throws IOException, InterruptedException {
        int left = robot.toGo(joint);
        int same = 0; // number of equal answers in a row
        while (left > 0) {
            System.out.println("  " + left + " counts to go");
            robot.pause();
            int before = left;
            left = robot.toGo(joint);
            same = left == before ? same + 1 : 0;
            if (same == Robot.STANDS_AFTER) {
                robot.send(joint + "X"); // cancel the rest: the next move would add to it
                Robot.checkArrived(joint, left);
            }
        }
        System.out.println(joint + " is there");
    }

    static void moveAndWait(String[] args) throws IOException, InterruptedException {
        Robot robot = new Robot(args);

        // Turn the shoulder by 50 counts of its encoder. The carriage return ends the number. The
        // robot starts to move and does not answer, so the program has to ask.
        System.out.println("E+50");
        robot.send("E+50\r");
        waitFor(robot, "E");

        // Move back.
        System.out.println("E-50");
        robot.send("E-50\r");
        waitFor(robot, "E");

        robot.close();
    }

    public static void main(String[] args) throws InterruptedException {
        try {
            moveAndWait(args);
        } catch (IOException why) { // Robot.java reports failures with a readable message
            System.err.println(why.getMessage());
            System.exit(1);
        }
    }
}
