// 6. Find with the camera and pick: look at the table, find the largest block, pick it up, put it
// down elsewhere, and look again.
//
//     build/6_find_and_pick [HOST [PORT]]
//
// The arm must be at its soft home, as when the simulator starts or after 3_home.

mod robot;
use robot::{error, Robot, JAWS};
use std::io::Result;

// The camera looks straight down on a square of 384 mm centred at x 290, y 0, with 192 x 192 pixels
// of 2 mm. Each byte of the picture has six pixels.
const PIXELS: usize = 192;
const ROW_BYTES: usize = PIXELS / 6;

const OPEN: i32 = -16; // count of A with open jaws
const SHUT: i32 = 64; // count of A with closed jaws
const Z: f64 = 20.0; // height of the largest block's centre, mm
const ABOVE: f64 = 100.0; // height above it for approach and departure, mm

/// A place on the table: x and y in mm, and the direction of a block's long side in degrees.
struct Place {
    x: f64,
    y: f64,
    angle: f64,
}

/// Rows from the top; true where the camera sees a block.
type Picture = Vec<Vec<bool>>;

/// Requests the picture. The leftmost of six pixels is the highest bit, and 32 is added to each
/// byte.
fn look(robot: &mut Robot) -> Result<Picture> {
    robot.send("A**")?;
    let bytes = robot.read(PIXELS * ROW_BYTES)?;
    let mut picture = vec![vec![false; PIXELS]; PIXELS];
    for row in 0..PIXELS {
        for column in 0..PIXELS {
            let six = i32::from(bytes[row * ROW_BYTES + column / 6]) - 32;
            picture[row][column] = six >> (5 - column % 6) & 1 == 1;
        }
    }
    Ok(picture)
}

/// Removes this pixel and all pixels connected to it from the picture, so that none is counted
/// twice, and adds their positions on the table, in mm, to the patch.
fn collect(picture: &mut Picture, row: usize, column: usize, patch: &mut Vec<(f64, f64)>) {
    if row >= PIXELS || column >= PIXELS || !picture[row][column] {
        return;
    }
    picture[row][column] = false;
    let x = 290.0 - 192.0 + 2.0 * (column as f64 + 0.5);
    let y = 0.0 + 192.0 - 2.0 * (row as f64 + 0.5);
    patch.push((x, y));
    collect(picture, row, column + 1, patch);
    collect(picture, row + 1, column, patch);
    if column > 0 {
        collect(picture, row, column - 1, patch);
    }
    if row > 0 {
        collect(picture, row - 1, column, patch);
    }
}

/// The centre of a patch is the average of its pixels. The long side has the direction of their
/// largest spread, the principal axis of inertia.
fn measure(patch: &[(f64, f64)]) -> Place {
    let n = patch.len() as f64;
    let (mut x, mut y) = (0.0, 0.0);
    for (px, py) in patch {
        x += px / n;
        y += py / n;
    }
    let (mut xx, mut yy, mut xy) = (0.0, 0.0, 0.0);
    for (px, py) in patch {
        xx += (px - x) * (px - x);
        yy += (py - y) * (py - y);
        xy += (px - x) * (py - y);
    }
    let mut angle = ((2.0 * xy).atan2(xx - yy) / 2.0).to_degrees();
    if angle < 0.0 {
        angle += 180.0;
    }
    Place { x, y, angle }
}

fn find_largest(robot: &mut Robot) -> Result<Place> {
    let mut picture = look(robot)?;
    let mut largest = vec![];
    let mut patches = 0;
    for row in 0..PIXELS {
        for column in 0..PIXELS {
            let mut patch = vec![];
            collect(&mut picture, row, column, &mut patch);
            if !patch.is_empty() {
                patches += 1;
            }
            if patch.len() > largest.len() {
                largest = patch;
            }
        }
    }
    println!("blocks in the picture: {patches}");
    if patches == 0 {
        return Err(error("the camera sees no block: is one on the table?"));
    }
    let Place { x, y, angle } = measure(&largest);
    println!("the largest is at x {x:.0}, y {y:.0} mm, turned {angle:.0} degrees");
    Ok(Place { x, y, angle })
}

/// Inverse kinematics: moves the tool, pointing down, to a place at height z. Seen from the side,
/// upper arm and forearm, 228.6 mm each, are two sides of a triangle. The third side leads from the
/// shoulder, 260.4 mm above the table, to the wrist, 168.3 mm above the tip and 9.5 mm nearer to
/// the base. Each motor sets the slope of one link, independently of the others.
fn go_to(robot: &mut Robot, place: &Place, z: f64) -> Result<()> {
    let out = place.x.hypot(place.y) - 9.5;
    let up = z + 168.3 - 260.4;
    let base = place.y.atan2(place.x).to_degrees();
    let slope = up.atan2(out).to_degrees();
    let corner = (out.hypot(up) / 2.0 / 228.6).acos().to_degrees();
    let upper_arm = slope + corner;
    let forearm = slope - corner;
    // A block looks the same after half a turn, so the roll can be reduced to -90...90.
    let mut roll = base - place.angle + 90.0;
    roll -= 180.0 * (roll / 180.0).round();
    robot.go_arm([
        (base / 0.2269).round() as i32,
        ((90.0 - upper_arm) / 0.1135).round() as i32,
        (forearm / 0.1135).round() as i32,
        0,
        (roll / 0.3125).round() as i32,
    ])
}

fn find_and_pick() -> Result<()> {
    let mut robot = Robot::connect()?;
    let block = find_largest(&mut robot)?;

    robot.go_jaws(OPEN)?;
    go_to(&mut robot, &block, Z + ABOVE)?;
    go_to(&mut robot, &block, Z)?;
    robot.send("A+90\r")?; // as in example 5
    robot.at[JAWS] += 90 - robot.wait('A')?;
    if robot.at[JAWS] >= SHUT {
        eprintln!(
            "the jaws closed on nothing: is the block at x {:.0}, y {:.0} mm? (The examples 3 to 6 \
             are for the Rhino XR-3 with its own workcell)",
            block.x, block.y
        );
        go_to(&mut robot, &block, Z + ABOVE)?; // back to the start position
        robot.go([0; 6])?;
        std::process::exit(1);
    }
    println!("the jaws closed on {:.1} mm", 50.8 - 0.79375 * f64::from(robot.at[JAWS]));
    go_to(&mut robot, &block, Z + ABOVE)?;

    // A free place, the block's long side along y.
    let target = Place { x: 392.0, y: 60.0, angle: 90.0 };
    go_to(&mut robot, &target, Z + ABOVE)?;
    go_to(&mut robot, &target, Z)?;
    robot.go_jaws(OPEN)?;
    go_to(&mut robot, &target, Z + ABOVE)?;
    println!("put down at x {}, y {} mm", target.x, target.y);

    find_largest(&mut robot)?;
    robot.go([0; 6])?;
    println!("back at the start");
    Ok(())
}

fn main() {
    if let Err(why) = find_and_pick() {
        eprintln!("{why}");
        std::process::exit(1);
    }
}
