// The code under test: turns the base. `Robot` is clients/java/Robot.java.

import java.io.IOException;
import java.util.Map;

class Turn {
    static void base(Robot robot, int counts) throws IOException, InterruptedException {
        robot.go(Map.of("F", counts));
    }
}
