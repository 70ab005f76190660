// Shared by examples 2 to 6: the connection to the robot and its basic commands. It handles joints
// and counts, but not millimetres or the camera.

import java.io.EOFException;
import java.io.IOException;
import java.net.Socket;
import java.net.UnknownHostException;
import java.util.LinkedHashMap;
import java.util.Map;

/** The connection to the robot. All failures throw IOException with a readable message. */
public class Robot {
    /**
     * A joint counts as stopped if its counter is the same after this many questions, over 2
     * seconds. The slowest speed is one count per second, and the simulator's clock may run slowly,
     * hence the long wait.
     */
    public static final int STANDS_AFTER = 40;

    /** Motor positions in counts from the soft home, as tracked by go(). */
    public final Map<String, Integer> at = new LinkedHashMap<>(arm(0, 0, 0, 0, 0));

    private final Socket line;

    /**
     * Connects to HOST and PORT from the arguments, else XR3_HOST and XR3_PORT, else localhost
     * 9600.
     */
    public Robot(String[] args) throws IOException {
        String host = args.length > 0 ? args[0] : setting("XR3_HOST", "localhost");
        String port = args.length > 1 ? args[1] : setting("XR3_PORT", "9600");
        line = connect(host, port);
        line.setTcpNoDelay(true); // send small messages at once
        at.put("A", 0);
    }

    private static Socket connect(String host, String port) throws IOException {
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

    /** An environment variable; an empty one counts as not set. */
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

    /** Sends commands. A move must end with \r. */
    public void send(String text) throws IOException {
        line.getOutputStream().write(text.getBytes());
    }

    /** Reads exactly `count` bytes of an answer. */
    public byte[] read(int count) throws IOException {
        byte[] bytes = line.getInputStream().readNBytes(count);
        if (bytes.length < count) throw new EOFException("the robot has closed the line");
        return bytes;
    }

    /** Sends an inquiry and returns the one-byte answer, 0 to 255. */
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

    /**
     * The counts that the joint still has to go. A Mark III answers with seven bits: for more than
     * 95 counts the answer is wrong there, so no move of these programs is longer.
     */
    public int toGo(String joint) throws IOException {
        return ask(joint + "?") - 32;
    }

    /** Pauses between two questions: 50 ms, or XR3_POLL_MS. */
    public void pause() throws InterruptedException {
        Thread.sleep(Integer.parseInt(setting("XR3_POLL_MS", "50")));
    }

    /**
     * Waits until the joint has arrived. If it is blocked (at a limit, or jaws at a block), cancels
     * its move. Returns the counts that were left.
     */
    public int waitFor(String joint) throws IOException, InterruptedException {
        int left = toGo(joint);
        int same = 0; // number of equal answers in a row
        while (left > 0 && same < STANDS_AFTER) {
            pause();
            int before = left;
            left = toGo(joint);
            same = left == before ? same + 1 : 0;
        }
        if (left > 0) send(joint + "X");
        return left;
    }

    /** Throws if counts are left; the message has the joint and possible reasons. */
    public static void checkArrived(String joint, int left) throws IOException {
        if (left <= 0) return;
        throw new IOException(joint + " stopped " + left + " counts short of its target. Is it "
                + "blocked at a limit, or stalled? Is a block in the jaws? Is the clock paused or "
                + "slow? Look at the page or at `xr3 watch`");
    }

    /** Moves these motors to these counts together, in parts small enough for the error counter. */
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

    /** A move command such as "E+5": the joint and a number with explicit sign. */
    public static String move(String joint, int counts) {
        return joint + (counts < 0 ? "" : "+") + counts;
    }

    public void close() throws IOException {
        line.close();
    }
}
