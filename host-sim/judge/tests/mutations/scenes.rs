//! Scenes of true traces: all bundled ones, and random ones with and without obstacles.

use std::fs;
use std::path::Path;

use stiction_tests::obstacles::scene::Among;
use stiction_tests::obstacles::worlds::world;
use stiction_tests::random::scenarios;

/// Name and text of every bundled scene.
pub(crate) fn bundled() -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    let files = fs::read_dir(folder).expect("the scenes");
    let files = files.map(|entry| entry.expect("a file").path());
    let mut scenes: Vec<_> = files
        .filter(|file| {
            file.extension()
                .is_some_and(|extension| extension == "toml")
        })
        .map(|file| {
            let name = file
                .file_stem()
                .expect("a name")
                .to_string_lossy()
                .into_owned();
            (name, fs::read_to_string(&file).expect("a scene"))
        })
        .collect();
    scenes.sort();
    scenes
}

/// Scenes of bodies among half-planes: 4 legs of 250 frames.
pub(crate) fn random(count: usize) -> Vec<(String, String)> {
    let scene = |(i, scenario): (usize, stiction_tests::random::Scenario)| {
        let legs = scenario.keyframes.iter().enumerate();
        let keyframes: Vec<[f64; 4]> = legs
            .map(|(k, &[x, y, phi])| [k as f64 / 4.0, x, y, phi])
            .collect();
        let among = Among {
            setup: scenario.setup,
            obstacles: Vec::new(),
        };
        (format!("random {i}"), among.toml(&keyframes, 1000.0))
    };
    scenarios(count, 4).enumerate().map(scene).collect()
}

/// Scenes of bodies among obstacles.
pub(crate) fn among(count: u64) -> Vec<(String, String)> {
    let scene = |i| (format!("world {i}"), world(i).toml());
    (0..count).map(scene).collect()
}
