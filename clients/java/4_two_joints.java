// 4. Two joints at once: base and shoulder start together, and the program waits for both.
//
//     java -cp build 4_two_joints.java [HOST [PORT]]

import java.io.IOException;

class TwoJoints {
    static void twoJoints(String[] args) throws IOException, InterruptedException {
        Robot robot = new Robot(args);

        // Each joint has its own motor, and the robot does not wait: both start now.
        // The simulator can also set speeds, as in F40S. A Mark III cannot: it reads F40 as a move.
        robot.send("F+40 E+80\r");
        System.out.println("F+40 E+80");

        int f = robot.toGo("F");
        int e = robot.toGo("E");
        int same = 0; // number of equal answers in a row, as in example 2
        while (f > 0 || e > 0) {
            System.out.println("  F " + f + ", E " + e + " counts to go");
            robot.pause();
            int before = f + e;
            f = robot.toGo("F");
            e = robot.toGo("E");
            same = f + e == before ? same + 1 : 0;
            if (same == Robot.STANDS_AFTER) {
                robot.send("FX EX"); // cancel the rest: the next move would add to it
                Robot.checkArrived("F", f);
                Robot.checkArrived("E", e);
            }
        }
        System.out.println("both are there");

        // Move back. robot.waitFor() is the loop of example 2, for one joint after the other.
        robot.send("F-40 E-80\r");
        Robot.checkArrived("F", robot.waitFor("F"));
        Robot.checkArrived("E", robot.waitFor("E"));
        System.out.println("both are back");

        robot.close();
    }

    public static void main(String[] args) throws InterruptedException {
        try {
            twoJoints(args);
        } catch (IOException why) {
            System.err.println(why.getMessage());
            System.exit(1);
        }
    }
}
