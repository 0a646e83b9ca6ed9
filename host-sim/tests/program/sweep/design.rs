//! Grids and random designs: which points there are, in which order, in which shard.

use super::{column, folder, rows, table};

const GRID: &str = r#"
scenes = ["scene.toml", "point-stick-slip"]
[vary]
"friction.static" = [0.5, 0.75]
"spring.rotation" = { from = 0.1, to = 10.0, steps = 3, scale = "log" }
"body.weight" = { from = 0, to = 2, steps = 3 }
"#;

/// mu_s uniform, k_theta log-uniform, k_h one of two.
const RANDOM: &str = r#"
scenes = ["scene.toml"]
[vary]
"friction.static" = { from = 0.4, to = 0.9 }
"spring.rotation" = { from = 0.01, to = 10.0, scale = "log" }
"spring.translation" = [400.0, 600.0]
[design]
random = 3000
seed = 7
"#;

#[test]
fn a_grid_holds_every_point_once_the_last_key_fastest() {
    let rows = rows(&table(&folder(GRID), "out.csv", ""));
    let mut expected = Vec::new();
    for scene in ["scene.toml", "point-stick-slip"] {
        for friction in [0.5, 0.75] {
            for rotation in [0.1, 1.0, 10.0] {
                for weight in [0.0, 1.0, 2.0] {
                    expected.push((scene, [friction, rotation, weight]));
                }
            }
        }
    }
    assert_eq!(rows.len(), expected.len());
    for (i, (row, (scene, values))) in rows.iter().zip(expected).enumerate() {
        assert_eq!((&*row["index"], &*row["scene"]), (&*i.to_string(), scene));
        for (name, value) in ["friction.static", "spring.rotation", "body.weight"]
            .into_iter()
            .zip(values)
        {
            let given: f64 = row[name].parse().expect("a number");
            assert!((given - value).abs() <= 1e-15 * value, "{name} of row {i}");
        }
    }
}

#[test]
fn keys_may_be_written_without_quotes() {
    let mut bare = GRID.replace('"', "'");
    for key in ["friction.static", "spring.rotation", "body.weight"] {
        bare = bare.replace(&format!("'{key}'"), key);
    }
    assert_eq!(
        table(&folder(&bare), "out.csv", ""),
        table(&folder(GRID), "out.csv", "")
    );
}

#[test]
fn without_keys_every_scene_is_a_point() {
    let rows = rows(&table(
        &folder("scenes = [\"scene.toml\", \"snap\"]"),
        "out.csv",
        "",
    ));
    let scenes: Vec<&str> = rows.iter().map(|row| &*row["scene"]).collect();
    assert_eq!(scenes, ["scene.toml", "snap"]);
}

/// The largest distance of the distribution of `parts` from that of the uniform one on 0 to 1 (Kolmogorov, Smirnov).
fn distance_from_uniform(mut parts: Vec<f64>) -> f64 {
    parts.sort_by(f64::total_cmp);
    let count = parts.len() as f64;
    let distance = |(i, part): (usize, &f64)| {
        let (below, up_to) = (i as f64 / count, (i + 1) as f64 / count);
        (part - below).abs().max((part - up_to).abs())
    };
    parts.iter().enumerate().map(distance).fold(0.0, f64::max)
}

#[test]
fn random_points_are_distributed_as_the_file_says() {
    let rows = rows(&table(&folder(RANDOM), "out.csv", ""));
    assert_eq!(rows.len(), 3000);
    let (friction, rotation) = (
        column(&rows, "friction.static"),
        column(&rows, "spring.rotation"),
    );
    let friction: Vec<f64> = friction.iter().map(|mu| (mu - 0.4) / 0.5).collect();
    let rotation: Vec<f64> = rotation.iter().map(|k| (k / 0.01).log10() / 3.0).collect();
    let root = (rows.len() as f64).sqrt();
    for parts in [&friction, &rotation] {
        assert!(parts.iter().all(|part| (0.0..=1.0).contains(part)));
        // Exceeded once in a hundred times by numbers that are uniform.
        assert!(distance_from_uniform(parts.clone()) < 1.63 / root);
    }
    // Independent of one another: the correlation is within three deviations.
    let product = |(a, b): (&f64, &f64)| 12.0 * (a - 0.5) * (b - 0.5);
    let correlation = friction.iter().zip(&rotation).map(product).sum::<f64>() / rows.len() as f64;
    assert!(correlation.abs() < 3.0 / root, "{correlation}");
    // A coin: within three deviations of half.
    let heads = column(&rows, "spring.translation")
        .iter()
        .filter(|k| **k == 400.0)
        .count() as f64;
    assert!((heads - 1500.0).abs() < 3.0 * root / 2.0, "{heads}");
}

#[test]
fn shards_hold_the_points_of_the_whole() {
    for sweep in [GRID, RANDOM] {
        let folder = folder(&sweep.replace("random = 3000", "random = 100"));
        let whole = table(&folder, "out.csv", "");
        let mut parts = String::new();
        for part in 1..=3 {
            let (name, shard) = (format!("part.{part}.csv"), format!("{part}/3"));
            parts += &table(&folder, &name, &format!("--shard {shard}"));
        }
        assert_eq!(parts.lines().next(), whole.lines().next());
        let number = |line: &&str| {
            line.split(',')
                .next()
                .and_then(|index| index.parse::<u64>().ok())
        };
        let mut lines: Vec<&str> = parts.lines().collect();
        lines.sort_by_key(number);
        assert_eq!(lines, whole.lines().collect::<Vec<_>>());
    }
}

#[test]
fn shards_that_are_not_named_lie_in_order() {
    let folder = folder(GRID);
    for part in ["10", "2", "1"] {
        folder.done(&format!("sweep sweep.toml --shard {part}/12"));
    }
    let tables = folder
        .names()
        .into_iter()
        .filter(|name| name.ends_with(".csv"));
    let expected = [
        "sweep.01-of-12.csv",
        "sweep.02-of-12.csv",
        "sweep.10-of-12.csv",
    ];
    assert_eq!(tables.collect::<Vec<_>>(), expected);
    assert!(folder.read(expected[0]).starts_with("index,scene,"));
    assert!(folder.read(expected[1]).starts_with("1,scene.toml,"));
}

#[test]
fn another_seed_gives_other_points() {
    let few = RANDOM.replace("random = 3000", "random = 3");
    let values = |sweep: &str| {
        column(
            &rows(&table(&folder(sweep), "out.csv", "")),
            "friction.static",
        )
    };
    let (first, other) = (values(&few), values(&few.replace("seed = 7", "seed = 8")));
    assert!(first.iter().all(|value| !other.contains(value)));
}

#[test]
fn a_dry_run_tells_the_points_and_writes_nothing() {
    let folder = folder(GRID);
    let before = folder.names();
    let printed = folder.done("sweep sweep.toml --dry-run --shard 2/2");
    let lines: Vec<&str> = printed.lines().collect();
    assert_eq!(lines[0], "36 points, 18 of them in this shard");
    assert_eq!(lines[2], "1,scene.toml,0.5,0.1,1.0");
    assert_eq!(folder.names(), before);
}
