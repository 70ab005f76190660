// 6. Find with the camera and pick: look at the table, find the largest block, pick it up, put it
// down elsewhere, and look again.
//
//     java -cp build 6_find_and_pick.java [HOST [PORT]]
//
// The arm must be at its soft home, as when the simulator starts or after 3_home.java.

import java.io.IOException;
import java.util.Map;

class FindAndPick {
    // The camera looks straight down on a square of 384 mm centred at x 290, y 0, with 192 x 192
    // pixels of 2 mm. Each byte of the picture has six pixels.
    static final int PIXELS = 192;
    static final int ROW_BYTES = PIXELS / 6;

    static final int OPEN = -16; // count of A with open jaws
    static final int SHUT = 64; // count of A with closed jaws
    static final double Z = 20; // height of the largest block's centre, mm
    static final double ABOVE = 100; // height above it for approach and departure, mm

    /** A place on the table: x and y in mm, and the direction of a block's long side in degrees. */
    record Place(double x, double y, double angle) {}

    /** Sums over the pixels of one patch, to compute its centre and angle. */
    static class Patch {
        double n, x, y, xx, yy, xy;

        void add(double px, double py) {
            n += 1;
            x += px;
            y += py;
            xx += px * px;
            yy += py * py;
            xy += px * py;
        }

        /**
         * The centre is the average of the pixels. The long side has the direction of their largest
         * spread, the principal axis of inertia.
         */
        Place measure() {
            double mx = x / n;
            double my = y / n;
            double spreadX = xx / n - mx * mx;
            double spreadY = yy / n - my * my;
            double both = xy / n - mx * my;
            double angle = Math.toDegrees(Math.atan2(2 * both, spreadX - spreadY) / 2);
            return new Place(mx, my, angle < 0 ? angle + 180 : angle);
        }
    }

    static Robot robot;

    /**
     * Requests the picture and returns its rows from the top, true where the camera sees a block.
     * The leftmost of six pixels is the highest bit, and 32 is added to each byte.
     */
    static boolean[][] look() throws IOException {
        robot.send("A**");
        byte[] bytes = robot.read(PIXELS * ROW_BYTES);
        boolean[][] picture = new boolean[PIXELS][PIXELS];
        for (int row = 0; row < PIXELS; row++) {
            for (int column = 0; column < PIXELS; column++) {
                int six = bytes[row * ROW_BYTES + column / 6] - 32;
                picture[row][column] = (six >> (5 - column % 6) & 1) == 1;
            }
        }
        return picture;
    }

    /**
     * Adds this pixel and all pixels connected to it to the patch and removes them from the
     * picture, so that none is counted twice.
     */
    static void collect(boolean[][] picture, int row, int column, Patch patch) {
        if (row < 0 || row >= PIXELS || column < 0 || column >= PIXELS) return;
        if (!picture[row][column]) return;
        picture[row][column] = false;
        patch.add(290 - 192 + 2 * (column + 0.5), 0 + 192 - 2 * (row + 0.5));
        collect(picture, row, column + 1, patch);
        collect(picture, row, column - 1, patch);
        collect(picture, row + 1, column, patch);
        collect(picture, row - 1, column, patch);
    }

    static Place findLargest() throws IOException {
        boolean[][] picture = look();
        Patch largest = new Patch();
        int patches = 0;
        for (int row = 0; row < PIXELS; row++) {
            for (int column = 0; column < PIXELS; column++) {
                Patch patch = new Patch();
                collect(picture, row, column, patch);
                if (patch.n > 0) patches++;
                if (patch.n > largest.n) largest = patch;
            }
        }
        System.out.println("blocks in the picture: " + patches);
        if (patches == 0) throw new IOException("the camera sees no block: is one on the table?");
        Place found = largest.measure();
        System.out.printf("the largest is at x %.0f, y %.0f mm, turned %.0f degrees%n",
                found.x(), found.y(), found.angle());
        return found;
    }

    /**
     * Inverse kinematics: moves the tool, pointing down, to a place at height z. Seen from the
     * side, upper arm and forearm, 228.6 mm each, are two sides of a triangle. The third side leads
     * from the shoulder, 260.4 mm above the table, to the wrist, 168.3 mm above the tip and 9.5 mm
     * nearer to the base. Each motor sets the slope of one link, independently of the others.
     */
    static void goTo(Place place, double z) throws IOException, InterruptedException {
        double out = Math.hypot(place.x(), place.y()) - 9.5;
        double up = z + 168.3 - 260.4;
        double base = Math.toDegrees(Math.atan2(place.y(), place.x()));
        double slope = Math.toDegrees(Math.atan2(up, out));
        double corner = Math.toDegrees(Math.acos(Math.hypot(out, up) / 2 / 228.6));
        double upperArm = slope + corner;
        double forearm = slope - corner;
        // A block looks the same after half a turn, so the roll can be reduced to -90...90.
        double roll = base - place.angle() + 90;
        roll -= 180 * Math.round(roll / 180);
        robot.go(Robot.arm(counts(base / 0.2269), counts((90 - upperArm) / 0.1135),
                counts(forearm / 0.1135), 0, counts(roll / 0.3125)));
    }

    static int counts(double exact) {
        return (int) Math.round(exact);
    }

    static void findAndPick(String[] args) throws IOException, InterruptedException {
        robot = new Robot(args);
        Place block = findLargest();

        robot.go(Map.of("A", OPEN));
        goTo(block, Z + ABOVE);
        goTo(block, Z);
        robot.send("A+90\r"); // as in example 5
        int jaws = OPEN + (90 - robot.waitFor("A"));
        robot.at.put("A", jaws);
        if (jaws >= SHUT) {
            System.err.printf("the jaws closed on nothing: is the block at x %.0f, y %.0f mm? "
                    + "(The examples 3 to 6 are for the Rhino XR-3 with its own workcell)%n",
                    block.x(), block.y());
            goTo(block, Z + ABOVE); // back to the start position
            robot.go(Robot.arm(0, 0, 0, 0, 0));
            robot.go(Map.of("A", 0));
            System.exit(1);
        }
        System.out.printf("the jaws closed on %.1f mm%n", 50.8 - 0.79375 * jaws);
        goTo(block, Z + ABOVE);

        Place target = new Place(392, 60, 90); // a free place, the block's long side along y
        goTo(target, Z + ABOVE);
        goTo(target, Z);
        robot.go(Map.of("A", OPEN));
        goTo(target, Z + ABOVE);
        System.out.printf("put down at x %.0f, y %.0f mm%n", target.x(), target.y());

        findLargest();
        robot.go(Robot.arm(0, 0, 0, 0, 0));
        robot.go(Map.of("A", 0));
        System.out.println("back at the start");

        robot.close();
    }

    public static void main(String[] args) throws InterruptedException {
        try {
            findAndPick(args);
        } catch (IOException why) {
            System.err.println(why.getMessage());
            System.exit(1);
        }
    }
}
