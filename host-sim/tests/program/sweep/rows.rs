//! What a row says: the same as `stiction run` with the same values, and what the law of friction says.

use super::{column, folder, rows, table};
use crate::common::{Folder, SCENE};

/// The last pose, the slips and the frames of `stiction run` of `scene.toml` with these options, as they are written.
fn run(folder: &Folder, options: &str) -> [String; 5] {
    folder.done(&format!("run scene.toml --out trace.csv {options}"));
    let records = rows(&folder.read("trace.csv"));
    let slips: f64 = column(&records, "slips").iter().sum();
    let last = records.last().expect("a record");
    let [x, y, theta] = ["pose_x", "pose_y", "pose_theta"].map(|name| last[name].clone());
    [x, y, theta, slips.to_string(), records.len().to_string()]
}

/// A box that is pressed on the floor and dragged.
fn dragged() -> String {
    SCENE.replace(
        "[1.0, 0.2, 0.06, 0.5],",
        "[1.0, 0.2, 0.06, 0.5],\n  [2.0, 0.3, 0.05, 0.2],",
    )
}

#[test]
fn a_row_is_what_a_run_of_the_same_values_gives() {
    let sweep = r#"
scenes = ["scene.toml"]
[vary]
"run.number" = ["f64", "f32", "fixed"]
"run.evolution" = ["path", "frame"]
"run.rate" = [31, 300]
"surface.floor.memory" = [1e-5, 1e-3]
"run.budget" = [1, 4294967295]
"surface.floor.static" = [0.45, 0.7]
"#;
    let folder = folder(sweep);
    folder.write("scene.toml", dragged());
    let rows = rows(&table(&folder, "out.csv", ""));
    assert_eq!(rows.len(), 96);
    let (mut slips_seen, mut limited) = (0, [0.0; 2]);
    for row in rows {
        let floor = format!(
            "name = \"floor\"\nstatic = {}\nmemory = {}",
            row["surface.floor.static"], row["surface.floor.memory"]
        );
        folder.write("scene.toml", dragged().replace("name = \"floor\"", &floor));
        let dials = ["number", "evolution", "rate", "budget"];
        let options = dials.map(|dial| format!("--{dial}={}", row[&format!("run.{dial}")]));
        let given = ["x", "y", "theta", "slips", "frames"].map(|name| row[name].clone());
        assert_eq!(given, run(&folder, &options.join(" ")), "{row:?}");
        let few = usize::from(row["run.budget"] == "1");
        limited[few] += row["frames_behind"].parse::<f64>().expect("a number");
        slips_seen += given[3].parse::<u64>().expect("a number");
    }
    assert!(slips_seen > 0 && limited[0] == 0.0 && limited[1] > 0.0);
}

/// An edge pressed by d slips by d (mu_s - mu_d) each time, at any stiffness, and the largest reaction is k_h d √(1 + mu_s²).
#[test]
fn slips_and_forces_of_an_edge_are_those_of_the_law_of_friction() {
    let sweep = r#"
scenes = ["box-flat"]
[vary]
"friction.static" = [0.45, 0.9]
"spring.translation" = [50.0, 5000.0]
"run.number" = ["f64"]
"#;
    for row in rows(&table(&folder(sweep), "out.csv", "")) {
        let [mu, stiffness, slip, force] = [
            "friction.static",
            "spring.translation",
            "longest_slip",
            "largest_force",
        ]
        .map(|name| row[name].parse::<f64>().expect("a number"));
        assert!((slip - 0.01 * (mu - 0.3)).abs() < 1e-9, "{row:?}");
        let expected = stiffness * 0.01 * 1_f64.hypot(mu);
        // The last frame before a slip may come a frame before it: the hand goes 20 µm in one.
        let missing = expected - force;
        assert!(
            (-1e-9 * expected..stiffness * 2e-5).contains(&missing),
            "{row:?}"
        );
        // The hand drags 0.1 m: mu_s d without a slip, then one slip for each of its lengths, the first one at once.
        let slips = 1.0 + ((0.1 - 0.01 * mu) / slip).floor();
        assert_eq!(row["slips"].parse(), Ok(slips), "{row:?}");
    }
}

#[test]
fn every_point_of_the_example_runs() {
    let example = include_str!("../../../sweeps/friction-stiffness.toml");
    let rows = rows(&table(&folder(example), "out.csv", ""));
    assert!(rows.len() == 25 && rows.iter().all(|row| row["status"] == "ok"));
}

#[test]
fn shares_of_the_states_are_parts_of_the_time() {
    let folder = folder("scenes = [\"scene.toml\", \"corner-stick-slip\", \"locked\"]");
    for row in rows(&table(&folder, "out.csv", "")) {
        let shares = row.iter().filter(|(name, _)| name.starts_with("share_"));
        let shares: Vec<f64> = shares
            .map(|(_, share)| share.parse().expect("a number"))
            .collect();
        assert_eq!(shares.len(), 6);
        assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-9, "{row:?}");
    }
}

#[test]
fn a_refused_scene_is_a_row_with_its_message() {
    let sweep = "scenes = [\"scene.toml\"]\n[vary]\n\"friction.static\" = [0.5, 0.2]\n\"run.number\" = [\"f32\", \"f64\"]\n";
    let folder = folder(sweep);
    let rows = rows(&table(&folder, "out.csv", ""));
    let status: Vec<&str> = rows.iter().map(|row| &*row["status"]).collect();
    let refused = "`friction.static` is 0.2, allowed: not less than the dynamic friction";
    assert_eq!(status, ["ok", "ok", refused, refused]);
    assert!(rows[2]["x"].is_empty() && rows[2]["frames"].is_empty());
}

#[test]
fn elements_of_arrays_can_be_varied() {
    let sweep = "scenes = [\"scene.toml\"]\n[vary]\nhand.keyframes.1.1 = [0.2, 0.35]\n\"body.start\" = [[0.2, 0.12, 0.5], [0.2, 0.5, 0.0]]\n";
    let folder = folder(sweep);
    let rows = rows(&table(&folder, "out.csv", ""));
    assert_eq!(rows[3]["body.start"], "[0.2, 0.5, 0.0]");
    let x = column(&rows, "x");
    assert!(x[0] < 0.3 && x[2] > 0.3, "{x:?}");
}

#[test]
fn recorded_hands_can_be_varied() {
    let folder =
        folder("scenes = [\"scene.toml\"]\n[vary]\n\"run.hand\" = [\"up.csv\", \"absent.csv\"]\n");
    folder.write("up.csv", "t,x,y,phi\n0,0.2,0.14,0.5\n0.5,0.2,0.2,0.5\n");
    let rows = rows(&table(&folder, "out.csv", "--time"));
    assert_eq!((&*rows[0]["status"], &*rows[0]["seconds"]), ("ok", "0.5"));
    assert!(
        rows[0]["solver_seconds"]
            .parse::<f64>()
            .is_ok_and(|time| time > 0.0)
    );
    assert!(
        rows[1]["status"].contains("cannot be read"),
        "{:?}",
        rows[1]
    );
}
