//! `stiction sweep`: points, rows, what is left of an ended run, and input that cannot be used.

mod continued;
mod design;
mod mistakes;
mod rows;

use std::collections::HashMap;

pub(crate) use crate::common::rows;
use crate::common::{Folder, SCENE, said};

/// A folder with [`SCENE`] as `scene.toml` and this text as `sweep.toml`.
fn folder(sweep: &str) -> Folder {
    let folder = Folder::new();
    folder.write("scene.toml", SCENE);
    folder.write("sweep.toml", sweep);
    folder
}

/// Runs the sweep, with these options, to the text of a table.
fn table(folder: &Folder, out: &str, options: &str) -> String {
    let output = folder.stiction(&format!("sweep sweep.toml --quiet --out {out} {options}"));
    assert!(
        output.status.success() && said(&output).is_empty(),
        "{}",
        said(&output)
    );
    folder.read(out)
}

fn column(rows: &[HashMap<String, String>], name: &str) -> Vec<f64> {
    rows.iter()
        .map(|row| row[name].parse().expect(name))
        .collect()
}
