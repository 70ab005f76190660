// A fresh robot for a test: starts `xr3 serve` on free ports, and ends it.

import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse.BodyHandlers;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

class RobotServer implements AutoCloseable {
    private static final Pattern LISTENING =
            Pattern.compile("LISTENING robot=(\\S+):(\\d+) monitor=(\\S+):(\\d+)");

    private final Process process;
    private final Matcher ports;

    RobotServer() throws IOException {
        process = new ProcessBuilder(program(), "serve", "--robot-port", "0", "--monitor-port", "0",
                "--clock", "bytes", "--log-level", "warn", "--until-stdin-ends")
                .redirectError(ProcessBuilder.Redirect.INHERIT)
                .start();
        String line = new BufferedReader(new InputStreamReader(process.getInputStream()))
                .readLine(); // when both ports take connections
        ports = LISTENING.matcher(line == null ? "" : line);
        if (!ports.lookingAt()) throw new IOException("xr3 serve has not started: see above");
    }

    private static String program() {
        return System.getenv().getOrDefault("XR3", "xr3");
    }

    /** A connection to the robot. */
    Robot robot() throws IOException {
        return new Robot(new String[] {ports.group(1), ports.group(2)});
    }

    /** The count of a joint in the robot's own state, which the monitor port has as JSON. */
    int count(String joint) throws IOException, InterruptedException {
        URI state = URI.create("http://" + ports.group(3) + ":" + ports.group(4) + "/state");
        String json = HttpClient.newHttpClient()
                .send(HttpRequest.newBuilder(state).build(), BodyHandlers.ofString())
                .body();
        Matcher count = Pattern.compile("\"label\":\"" + joint + "\",\"count\":(-?\\d+)")
                .matcher(json);
        if (!count.find()) throw new IOException("there is no joint " + joint + ": " + json);
        return Integer.parseInt(count.group(1));
    }

    @Override
    public void close() throws IOException {
        process.getOutputStream().close();
    }
}
