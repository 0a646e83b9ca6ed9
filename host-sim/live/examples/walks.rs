//! Runs random walks of the hand through ten bundled scenes and prints the results, for the test of the npm package. The hand
//! poses are written to a folder, one file of rows (t, x, y, phi, held; f64, little-endian) per scene. For each scene and
//! number type, a line of JSON holds the SHA-256 of all answers.
//!
//! ```sh
//! cargo run --release -p stiction-live --example walks -- FOLDER 100000
//! ```

use std::error::Error;
use std::fs;
use std::path::Path;

use sha2::{Digest, Sha256};
use stiction_core::{Evolution, StateKind, Status};
use stiction_live::guide::HandPose;
use stiction_live::number::Number;
use stiction_live::scenes;
use stiction_live::session::Session;
use stiction_live::stage::Stage;
use stiction_scene::{Sample, SceneFile, Source};

/// With and without obstacles, a point, a rod, polygons.
const SCENES: [&str; 10] = [
    "vertex-stick-slip",
    "box-flat",
    "ladder",
    "parallel-walls",
    "point-stick-slip",
    "rod-on-floor",
    "table-edge",
    "step",
    "peg-in-hole",
    "hook",
];
/// Largest step of the hand in one tick, and largest distance from its start, in sizes of the body.
const STRIDE: f64 = 0.01;
const RANGE: f64 = 0.5;
/// Mean number of ticks between two changes of the hold switch.
const SWITCH: f64 = 2000.0;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [folder, frames] = arguments.as_slice() else {
        return Err("usage: bits FOLDER FRAMES".into());
    };
    let frames: usize = frames.parse()?;
    for name in SCENES {
        let source = scenes::find(Path::new(name)).ok_or(name)?;
        let text = source.text().to_owned();
        let read = |number: Number| SceneFile::parse(Source::new(name, &*text), number.limit());
        let hands = walk(&Stage::new(read(Number::F64)?)?, frames);
        let bytes: Vec<u8> = hands
            .iter()
            .flatten()
            .flat_map(|value| value.to_le_bytes())
            .collect();
        fs::write(Path::new(folder).join(format!("{name}.f64")), bytes)?;
        for number in Number::ALL {
            let session = Session::new(&read(number)?, number, Evolution::Path, u32::MAX)?;
            let (hash, slips) = answers(session, &hands);
            let number = number.name();
            println!(
                "{{\"scene\":\"{name}\",\"number\":\"{number}\",\"slips\":{slips},\"sha256\":\"{hash}\"}}"
            );
        }
    }
    Ok(())
}

/// Returns a random walk around the hand's start.
fn walk(stage: &Stage, frames: usize) -> Vec<[f64; 5]> {
    let vertices = stage.scene.vertices.iter().flatten();
    let size = vertices.fold(0.02, |size: f64, x| size.max(x.abs()));
    let home = HandPose::of(&stage.home).pose;
    let scales = [size, size, 1.0];
    let (mut pose, mut held, mut seed) = (home, true, 1_u64);
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    let row = |k: usize, [x, y, phi]: [f64; 3], held: bool| {
        [k as f64 / 1000.0, x, y, phi, f64::from(u8::from(held))]
    };
    let mut rows = vec![row(0, home, true)];
    for k in 1..frames {
        for axis in 0..3 {
            let stride = (2.0 * random() - 1.0) * STRIDE * scales[axis];
            let far = RANGE * scales[axis];
            pose[axis] = (pose[axis] + stride).clamp(home[axis] - far, home[axis] + far);
        }
        // Open only briefly: for most of the walk the body is in contact.
        held = if held {
            random() > 1.0 / SWITCH
        } else {
            random() < 0.01
        };
        rows.push(row(k, pose, held));
    }
    rows
}

/// Returns a hash of all answers, column by column as in the package, and the number of slips that ended.
fn answers(mut session: Session, hands: &[[f64; 5]]) -> (String, u64) {
    let mut columns: [Vec<u8>; 7] = Default::default();
    let mut slips = 0;
    let samples = hands.iter().map(|&[t, x, y, phi, held]| {
        let hand = HandPose {
            pose: [x, y, phi],
            depth: 0.0,
            held: held != 0.0,
        };
        Sample {
            t,
            hand: hand.hand(),
        }
    });
    let mut k = 0.0;
    for sample in samples {
        let frame = session.step(&sample);
        let [t, pose, wrench, state, status, counts, contacts] = &mut columns;
        t.extend(frame.t.to_le_bytes());
        pose.extend(frame.pose.iter().flat_map(|value| value.to_le_bytes()));
        wrench.extend(frame.wrench.iter().flat_map(|value| value.to_le_bytes()));
        state.push(place(&StateKind::ALL, &frame.state));
        status.push(place(&Status::ALL, &frame.status));
        counts.extend(frame.slips.to_le_bytes());
        slips += u64::from(frame.slips);
        for contact in &frame.contacts {
            let ([x, y], sliding) = (contact.point, f64::from(contact.sliding));
            let row = [k, x, y, contact.normal, contact.friction, sliding];
            contacts.extend(row.iter().flat_map(|value| value.to_le_bytes()));
        }
        k += 1.0;
    }
    let mut hash = Sha256::new();
    for column in columns {
        hash.update(&column);
    }
    let hash = hash.finalize();
    (
        hash.iter().map(|byte| format!("{byte:02x}")).collect(),
        slips,
    )
}

fn place<T: PartialEq>(all: &[T], one: &T) -> u8 {
    let place = all.iter().position(|known| known == one);
    place.unwrap_or_default() as u8
}
