// What the examples 2 to 6 share: the line to the robot, and the few things that one says on it. It
// knows joints and their counts, but neither millimetres nor the camera.

import java.io.EOFException;
import java.io.IOException;
import java.net.Socket;
import java.net.UnknownHostException;
import java.util.LinkedHashMap;
import java.util.Map;

/** Whatever it cannot do, it throws as an IOException with a text for people. */
public class Robot {
    /** How long pause() does nothing, between two questions. */
    public static final int PAUSE_MS = 50;

    /**
     * A joint stands if its counter has not changed for so long. The slowest speed is one count a
     * second, and the simulator's clock may run slowly, so be patient.
     */
    public static final int STANDS_MS = 2000;

    /** Where the motors are, in counts from the soft home, as far as go() moved them. */
    public final Map<String, Integer> at = new LinkedHashMap<>(arm(0, 0, 0, 0, 0));

    private final Socket line;

    /** Connects to HOST and PORT of the arguments, else of XR3_HOST and XR3_PORT, else to localhost
     * 9600. */
    public Robot(String[] args) throws IOException {
        String host = args.length > 0 ? args[0] : setting("XR3_HOST", "localhost");
        String port = args.length > 1 ? args[1] : setting("XR3_PORT", "9600");
        line = connect(host, port);
        line.setTcpNoDelay(true); // few bytes at a time shall go out at once, not be gathered first
        at.put("A", 0);
    }

    private static Socket connect(String host, String port) throws IOException {
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

    /** A variable of the environment; one that is empty counts as not set. */
    private static String setting(String name, String otherwise) {
        String value = System.getenv(name);
        return value != null && !value.isEmpty() ? value : otherwise;
    }

    /** Counts of base, shoulder, elbow, pitch and roll, for go(). */
    public static Map<String, Integer> arm(int f, int e, int d, int c, int b) {
        Map<String, Integer> counts = new LinkedHashMap<>();
        counts.put("F", f);
        counts.put("E", e);
        counts.put("D", d);
        counts.put("C", c);
        counts.put("B", b);
        return counts;
    }

    /** Sends commands. A move has to end with \r. */
    public void send(String text) throws IOException {
        line.getOutputStream().write(text.getBytes());
    }

    /** Reads exactly so many bytes of an answer. */
    public byte[] read(int count) throws IOException {
        byte[] bytes = line.getInputStream().readNBytes(count);
        if (bytes.length < count) throw new EOFException("the robot has closed the line");
        return bytes;
    }

    /** Asks, and returns the byte that answers, 0 to 255. */
    public int ask(String inquiry) throws IOException {
        send(inquiry);
        byte[] reply = new byte[100];
        int got = line.getInputStream().read(reply);
        if (got < 1) throw new EOFException("the robot has closed the line");
        if (got > 1) {
            throw new IOException("no robot answers like this; is it the monitor port? "
                    + "The robot port is 9600");
        }
        return reply[0] & 0xFF;
    }

    /** How many counts the joint has still to go. */
    public int toGo(String joint) throws IOException {
        return ask(joint + "?") - 32;
    }

    /** Does nothing for a while. */
    public void pause() throws InterruptedException {
        Thread.sleep(PAUSE_MS);
    }

    /**
     * Waits until the joint is there. One that makes no count for STANDS_MS stands, at a limit or
     * with the jaws at a block, and is stopped. Returns the counts that were left.
     */
    public int waitFor(String joint) throws IOException, InterruptedException {
        int left = toGo(joint);
        int stillMs = 0; // for how long the counter has not changed
        while (left > 0 && stillMs < STANDS_MS) {
            pause();
            int before = left;
            left = toGo(joint);
            stillMs = left == before ? stillMs + PAUSE_MS : 0;
        }
        if (left > 0) send(joint + "X");
        return left;
    }

    /** Throws if there are counts left: says which joint stands, and what the reason may be. */
    public static void checkArrived(String joint, int left) throws IOException {
        if (left <= 0) return;
        throw new IOException(joint + " stands, " + left + " counts short of where it was sent. "
                + "Is it blocked at a limit, or stalled? Is a block in the jaws? Does time stand, "
                + "or run slowly? Look at the page or at `xr3 watch`");
    }

    /** Brings these motors to these counts together, in parts that the error counter can hold. */
    public void go(Map<String, Integer> wanted) throws IOException, InterruptedException {
        Map<String, Integer> start = new LinkedHashMap<>(at);
        int longest = 0;
        for (String joint : wanted.keySet()) {
            longest = Math.max(longest, Math.abs(wanted.get(joint) - start.get(joint)));
        }
        int parts = (longest + 59) / 60; // no move is longer than 60 counts
        for (int part = 1; part <= parts; part++) {
            for (String joint : wanted.keySet()) {
                int way = wanted.get(joint) - start.get(joint);
                int next = start.get(joint) + way * part / parts;
                if (next != at.get(joint)) send(move(joint, next - at.get(joint)) + "\r");
                at.put(joint, next);
            }
            for (String joint : wanted.keySet()) {
                checkArrived(joint, waitFor(joint));
            }
        }
    }

    /** "E+5": a joint, and a number that always shows its sign. */
    public static String move(String joint, int counts) {
        return joint + (counts < 0 ? "" : "+") + counts;
    }

    public void close() throws IOException {
        line.close();
    }
}
