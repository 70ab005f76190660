// 1. Hello: connect to the robot, ask it two questions, print the answers.
//
//     java 1_hello.java [HOST [PORT]]
//
// A robot on a serial line knows no lines of text and no "OK". It answers a question with one byte,
// and everything else with silence.

import java.io.IOException;
import java.net.Socket;
import java.net.UnknownHostException;

class Hello {
    /** A variable of the environment; one that is empty counts as not set. */
    static String setting(String name, String otherwise) {
        String value = System.getenv(name);
        return value != null && !value.isEmpty() ? value : otherwise;
    }

    /** Sends a question and returns the byte that answers it, 0 to 255. */
    static int ask(Socket robot, String question) throws IOException {
        robot.getOutputStream().write(question.getBytes());
        byte[] reply = new byte[100];
        int got = robot.getInputStream().read(reply);
        if (got < 1) throw new IOException("the robot has closed the line");
        if (got > 1) {
            throw new IOException("no robot answers like this; is it the monitor port? "
                    + "The robot port is 9600");
        }
        return reply[0] & 0xFF;
    }

    /** A line to the robot; what may go wrong is said in words. */
    static Socket connect(String host, String port) throws IOException {
        try {
            return new Socket(host, Integer.parseInt(port));
        } catch (IllegalArgumentException why) { // no number, or one that is no port
            throw new IOException("the port has to be a number from 1 to 65535, not '" + port
                    + "'");
        } catch (UnknownHostException why) {
            throw new IOException("no such host: " + host);
        } catch (IOException why) {
            throw new IOException("no robot answers at " + host + " port " + port
                    + ": is the server running? ./run");
        }
    }

    static void hello(String[] args) throws IOException {
        // Where the robot is: from the arguments, else from the environment, else this machine.
        String host = args.length > 0 ? args[0] : setting("XR3_HOST", "localhost");
        String port = args.length > 1 ? args[1] : setting("XR3_PORT", "9600");

        Socket robot = connect(host, port);

        // How far has the shoulder, joint E, still to go? The answer is counted from 32, the code
        // of a blank, so that it can be printed: a blank means 0 counts to go, "!" means 1, and
        // so on.
        int reply = ask(robot, "E?");
        System.out.println("E? is answered by " + reply + ": " + (reply - 32) + " counts to go");

        // Which microswitches are closed? Again 32 is added; each switch has a bit of its own.
        reply = ask(robot, "I");
        System.out.println("I is answered by " + reply + ": switches " + (reply - 32));

        robot.close();
    }

    public static void main(String[] args) {
        try {
            hello(args);
        } catch (IOException why) { // no robot there, or not any more
            System.err.println(why.getMessage());
            System.exit(1);
        }
    }
}
