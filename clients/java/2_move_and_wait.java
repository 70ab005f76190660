// 2. Move and wait: send a joint somewhere, and ask until it has arrived.
//
//     java -cp build 2_move_and_wait.java [HOST [PORT]]

class MoveAndWait {
    /**
     * Asks how far there is still to go until nothing is left. Between two questions it does
     * nothing for a while.
     */
    static void waitFor(Robot robot, String joint) throws Exception {
        int left = robot.toGo(joint);
        while (left > 0) {
            System.out.println("  " + left + " counts to go");
            robot.pause();
            left = robot.toGo(joint);
        }
        System.out.println(joint + " is there");
    }

    public static void main(String[] args) throws Exception {
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
}
