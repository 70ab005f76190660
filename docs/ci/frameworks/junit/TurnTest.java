import static org.junit.jupiter.api.Assertions.assertEquals;

import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

class TurnTest {
    private RobotServer server;
    private Robot robot;

    @BeforeEach
    void start() throws Exception {
        server = new RobotServer();
        robot = server.robot();
    }

    @AfterEach
    void end() throws Exception {
        if (robot != null) robot.close();
        if (server != null) server.close();
    }

    @Test
    void turnsTheBase() throws Exception {
        Turn.base(robot, 90);
        assertEquals(90, server.count("F"));
    }

    @Test
    void turnsBackFromWhereItIs() throws Exception {
        Turn.base(robot, 30);
        Turn.base(robot, -30);
        assertEquals(-30, server.count("F"));
    }
}
