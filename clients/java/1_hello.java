// 1. Hello: connect to the robot, ask it two questions, print the answers.
//
//     java 1_hello.java [HOST [PORT]]
//
// The robot's serial protocol has no lines of text and no "OK". The robot answers most questions
// with one byte and does not answer other commands.

import java.io.IOException;
import java.net.Socket;
import java.net.UnknownHostException;

class Hello {
    /** An environment variable; an empty one counts as not set. */
    static String setting(String name, String otherwise) {
        String value = System.getenv(name);
        return value != null && !value.isEmpty() ? value : otherwise;
    }

    /** Sends a question and returns the one-byte answer, 0 to 255. */
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

    /** Connects to the robot; errors have a readable message. */
    static Socket connect(String host, String port) throws IOException {
        try {
            return new Socket(host, Integer.parseInt(port));
        } catch (IllegalArgumentException why) { // not a number, or not a valid port
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
        // Host and port: from the arguments, else from the environment, else the defaults.
        String host = args.length > 0 ? args[0] : setting("XR3_HOST", "localhost");
        String port = args.length > 1 ? args[1] : setting("XR3_PORT", "9600");

        Socket robot = connect(host, port);

        // Ask how many counts the shoulder, joint E, still has to go. 32, the code of a blank, is
        // added to the answer to make it printable: a blank means 0 counts to go, "!" means 1, and
        // so on.
        int reply = ask(robot, "E?");
        System.out.println("E? is answered by " + reply + ": " + (reply - 32) + " counts to go");

        // Which microswitches are closed? Again 32 is added; each switch has one bit.
        reply = ask(robot, "I");
        System.out.println("I is answered by " + reply + ": switches " + (reply - 32));

        robot.close();
    }

    public static void main(String[] args) {
        try {
            hello(args);
        } catch (IOException why) { // no robot, or connection lost
            System.err.println(why.getMessage());
            System.exit(1);
        }
    }
}
