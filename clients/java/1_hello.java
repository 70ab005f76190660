// 1. Hello: connect to the robot, ask it two questions, print the answers.
//
//     java 1_hello.java [HOST [PORT]]
//
// A robot on a serial line knows no lines of text and no "OK". It answers a question with one byte,
// and everything else with silence.

import java.io.InputStream;
import java.io.OutputStream;
import java.net.Socket;

class Hello {
    static String setting(String name, String otherwise) {
        String value = System.getenv(name);
        return value != null ? value : otherwise;
    }

    public static void main(String[] args) throws Exception {
        // Where the robot is: from the arguments, else from the environment, else this machine.
        String host = args.length > 0 ? args[0] : setting("XR3_HOST", "localhost");
        String port = args.length > 1 ? args[1] : setting("XR3_PORT", "9600");

        Socket robot = new Socket(host, Integer.parseInt(port));
        OutputStream out = robot.getOutputStream();
        InputStream in = robot.getInputStream();

        // How far has the shoulder, joint E, still to go? The answer is counted from 32, the code
        // of a blank, so that it can be printed: a blank means 0 counts to go, "!" means 1, and
        // so on.
        out.write("E?".getBytes());
        int reply = in.read();
        System.out.println("E? is answered by " + reply + ": " + (reply - 32) + " counts to go");

        // Which microswitches are closed? Again 32 is added; each switch has a bit of its own.
        out.write("I".getBytes());
        reply = in.read();
        System.out.println("I is answered by " + reply + ": switches " + (reply - 32));

        robot.close();
    }
}
