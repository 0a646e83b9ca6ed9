//! Measures the cost of obstacles: bundled scenes along their own path of the hand on an emulated Cortex-M4F; and a scene with an increasing number of boxes that are never touched, within reach of the body and
//! out of it. Needs QEMU.

use std::error::Error;
use std::path::Path;

use stiction_core::Evolution;
use stiction_host_sim::columns::thousands;
use stiction_scene::ObstacleInfo;

use crate::emulator::{Board, Counted, Counter, Profile, job};
use crate::footprint::Case;
use crate::markdown::{Destination, Table};

/// The scenes of the first table.
const SCENES: [&str; 4] = ["table-edge", "peg-in-hole", "step", "plank-on-posts"];
/// The scene of the second table, and the numbers of boxes in addition to its own obstacles.
const AROUND: &str = "table-edge";
const BOXES: [usize; 6] = [0, 1, 2, 4, 8, 16];
/// The height of the boxes' lower sides (m): just above the highest position of the body, and far above it.
const IN_REACH: f64 = 0.13;
const OUT_OF_REACH: f64 = 1.0;

/// A bundled scene with this many boxes more, in a row at a height.
fn with_boxes(name: &str, count: usize, height: f64) -> Result<Case, Box<dyn Error>> {
    let mut case = Case::open(Path::new(name))?;
    let boxes = (0..count).map(|i| {
        let (left, width) = (-0.08 + 0.0125 * i as f64, 0.01);
        let [right, top] = [left + width, height + width];
        ObstacleInfo {
            name: format!("box {i}"),
            vertices: vec![[left, height], [right, height], [right, top], [left, top]],
            ..case.scene.obstacles[0].clone()
        }
    });
    let boxes: Vec<_> = boxes.collect();
    case.scene.written.obstacles.extend(boxes);
    Ok(case)
}

fn count(counter: &Counter, case: &Case) -> Result<Counted, Box<dyn Error>> {
    let job = job(&case.scene, Evolution::Path, &case.hands);
    Ok(counter.count(&job, u32::MAX)?)
}

/// A row of the first table.
fn scene_row(counter: &Counter, name: &str) -> Result<[String; 5], Box<dyn Error>> {
    let case = Case::open(Path::new(name))?;
    let counted = count(counter, &case)?;
    let most_work = counted.steps().iter().map(|step| step.work).max();
    Ok([
        name.to_owned(),
        thousands(counted.steps().len() as u64),
        format!("{:.0}", counted.mean()),
        thousands(counted.worst().into()),
        most_work.unwrap_or(0).to_string(),
    ])
}

fn of_boxes(counter: &Counter) -> Result<Table, Box<dyn Error>> {
    let mut table = Table::new("boxes: | in reach: | each: | out of reach: | each:");
    let mut none = None;
    for boxes in BOXES {
        let counted = [IN_REACH, OUT_OF_REACH].map(|height| {
            let case = with_boxes(AROUND, boxes, height)?;
            count(counter, &case).map(|counted| counted.mean())
        });
        let [near, far] = counted;
        let (near, far) = (near?, far?);
        let none = *none.get_or_insert(near);
        let each = |mean: f64| match boxes {
            0 => "–".to_owned(),
            _ => format!("{:.1}", (mean - none) / boxes as f64),
        };
        let [near, far] = [near, far].map(|mean| [format!("{mean:.0}"), each(mean)]);
        let cells = [boxes.to_string()].into_iter().chain(near).chain(far);
        table.row(cells);
    }
    Ok(table)
}

/// Measures both.
///
/// # Errors
/// QEMU or a target is missing, or the document cannot be written.
pub fn obstacles(output: Destination) -> Result<(), Box<dyn Error>> {
    let counter = Counter::among(Board::Stm32F405, Profile::Device)?;
    let mut table = Table::new("scene | steps: | mean: | worst: | units, worst:");
    for name in SCENES {
        table.row(scene_row(&counter, name)?);
    }
    let boxes = of_boxes(&counter)?;
    let text = format!(
        "Written by `cargo run --release -p stiction-lab -- obstacles --write`: instructions of a step on an emulated Cortex-M4F, f32, path\n\
         evolution, in a solver of 4 vertices, a half-plane and 17 obstacles of 4 corners.\n\n\
         {table}\nBoxes in addition to the obstacles of `{AROUND}`, which are never touched: instructions per step, on average, and the increase per box.\n\n\
         {boxes}"
    );
    Ok(output.put("host-sim/TRADE.md", "obstacles", &text)?)
}
