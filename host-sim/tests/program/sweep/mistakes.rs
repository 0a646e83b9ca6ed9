//! Sweep files that cannot be used: exit status 2, a message with the key or the line and what is allowed, and no table.

use super::folder;

/// What is below `scenes` and `[vary]`, and what the message must hold.
#[rustfmt::skip]
const IN_VARY: &[(&str, &[&str])] = &[
    ("\"friction.sttic\" = [0.5]", &["line 3", "`friction.sttic`", "friction.static", "surface.NAME.static", "obstacle.NAME.vertices", "run.number"]),
    ("frictoin.static = [0.5]", &["line 3", "`frictoin.static`"]),
    ("friction = [0.5]", &["line 3", "`friction`"]),
    ("friction.static = []", &["line 3", "`friction.static`", "empty", "at least one"]),
    ("friction.static = 0.5", &["line 3", "`friction.static` is 0.5", "a list"]),
    ("friction.static = [0.5, \"0.6\"]", &["line 3", "\"0.6\"", "finite numbers"]),
    ("friction.static = [0.5, nan]", &["line 3", "nan", "finite numbers"]),
    ("friction.static = [0.5, inf]", &["line 3", "inf", "finite numbers"]),
    ("friction.static = [0.5]\n\"friction.static\" = [0.6]", &["line 4", "twice"]),
    ("friction.static = [0.5]\nfriction.static = [0.6]", &["line 4", "duplicate key"]),
    ("body.start = [0.5]", &["line 3", "`body.start`", "arrays"]),
    ("body.weight.0 = [0.5]", &["line 3", "`body.weight.0`"]),
    ("hand.plane = [1]", &["line 3", "`hand.plane`", "texts"]),
    ("\"surface.ceiling.static\" = [0.5]", &["line 3", "`surface.ceiling.static`", "\"scene.toml\"", "no surface \"ceiling\", allowed: floor, wall"]),
    ("\"body.start.3\" = [0.5]", &["line 3", "`body.start.3`", "\"scene.toml\"", "no start \"3\", allowed: 0 to 2"]),
    ("hand.keyframes.9.1 = [0.5]", &["line 3", "`hand.keyframes.9.1`", "no keyframes \"9\", allowed: 0 to 1"]),
    ("friction.static = [0.5]\n\"surface.ceiling.static\" = [0.5]", &["line 4", "no surface \"ceiling\""]),
    ("\"body.rectangle.0\" = [0.5]", &["line 3", "`body.rectangle.0`", "\"scene.toml\"", "allowed: a scene that has it"]),
    ("run.number = [\"f16\"]", &["line 3", "`run.number`", "f16", "f64, f32, fixed"]),
    ("run.evolution = [\"paths\"]", &["line 3", "`run.evolution`", "path, frame"]),
    ("run.rate = [0]", &["line 3", "`run.rate`", "above 0"]),
    ("run.tolerance = [0.001]", &["line 3", "`run.tolerance`", "friction.memory"]),
    ("friction.memory = [\"short\"]", &["line 3", "`friction.memory`", "finite numbers"]),
    ("run.budget = [0]", &["line 3", "`run.budget`", "1 to 4294967295"]),
    ("run.budget = [1.5]", &["line 3", "`run.budget`", "whole number"]),
    ("run.hand = [1]", &["line 3", "`run.hand`", "file"]),
    ("run.speed = [1]", &["line 3", "`run.speed`"]),
    ("run.number = { from = 0, to = 1, steps = 2 }", &["line 3", "`run.number`", "a list"]),
    ("friction.static = { from = 0.1, steps = 3 }", &["line 3", "`friction.static`", "`to`"]),
    ("friction.static = { from = 0.1, to = 1.0, step = 3 }", &["line 3", "`step`", "`steps`"]),
    ("friction.static = { from = 0.1, to = 1.0 }", &["line 3", "no `steps`"]),
    ("friction.static = { from = 0.1, to = 1.0, steps = 1 }", &["line 3", "1 steps", "at least 2"]),
    ("friction.static = { from = 0.1, to = 1.0, steps = -1 }", &["line 3", "-1"]),
    ("friction.static = { from = 1.0, to = 0.1, steps = 3 }", &["line 3", "from 1.0 to 0.1", "above"]),
    ("friction.static = { from = nan, to = 0.1, steps = 3 }", &["line 3", "nan", "finite"]),
    ("friction.static = { from = 0.1, to = inf, steps = 3 }", &["line 3", "inf", "finite"]),
    ("body.weight = { from = -1.7e308, to = 1.7e308, steps = 3 }", &["line 3", "`body.weight`"]),
    ("spring.rotation = { from = 0.0, to = 1.0, steps = 3, scale = \"log\" }", &["line 3", "logarithmic", "above 0"]),
    ("spring.rotation = { from = 0.1, to = 1.0, steps = 3, scale = \"exp\" }", &["line 3", "exp", "log"]),
    ("run.rate = { from = 0.0, to = 10.0, steps = 3 }", &["line 3", "0", "above 0"]),
    ("friction.static = { from = 0.1, to = 1.0, steps = 100000 }\nspring.rotation = { from = 0.1, to = 1.0, steps = 100000 }", &["10000000000", "1 to 1000000000"]),
    ("[design]\nrandom = 0", &["line 4", "1 to 1000000000"]),
    ("[design]\nrandom = 2000000000", &["line 4", "2000000000"]),
    ("[design]\nrandom = -1", &["line 4", "`design.random` is integer `-1`, allowed: a whole number, 0 or more"]),
    ("[design]\nseed = 1", &["line 3", "random"]),
    ("[design]\nrandom = 1\nsead = 1", &["line 5", "sead", "seed"]),
    ("[degisn]\nrandom = 1", &["line 3", "degisn", "design"]),
];

#[rustfmt::skip]
const WHOLE: &[(&str, &[&str])] = &[
    ("", &["sweep.toml", "scenes"]),
    ("scenes = [", &["line 1"]),
    ("scenes = []", &["line 1", "`scenes`", "at least one"]),
    ("scenes = \"box-flat\"", &["line 1", "`scenes` is string \"box-flat\", allowed: an array"]),
    ("scenes = [\"box-flat\",\n\"box-round\"]", &["line 2", "box-round", "box-flat"]),
    ("scenes = [\"box-flat\"]\nvary = 3", &["line 2", "vary"]),
    ("scenes = [\"sweep.toml\"]\nfiles = 3", &["line 2", "files"]),
    ("scenes = [\"broken.toml\"]", &["broken.toml, line 1"]),
];

fn assert_refused(sweep: &str, expected: &[&str]) {
    let folder = folder(sweep);
    folder.write("broken.toml", "[body");
    let before = folder.names();
    for more in ["", "--dry-run"] {
        folder.refused(&format!("sweep sweep.toml {more}"), expected);
        assert_eq!(folder.names(), before, "{sweep}");
    }
}

#[test]
fn mistakes_in_sweep_files_are_refused() {
    for (below, expected) in IN_VARY {
        assert_refused(
            &format!("scenes = [\"scene.toml\"]\n[vary]\n{below}\n"),
            expected,
        );
    }
    for (sweep, expected) in WHOLE {
        assert_refused(sweep, expected);
    }
}

#[test]
fn options_that_cannot_be_used_are_refused() {
    let folder = folder("scenes = [\"scene.toml\"]");
    let before = folder.names();
    for (options, expected) in [
        ("--shard 0/3", "from 1 to N"),
        ("--shard 4/3", "from 1 to N"),
        ("--shard 3", "from 1 to N"),
        ("--threads 0", "--threads"),
        ("--out absent/out.csv", "absent"),
    ] {
        folder.refused(&format!("sweep sweep.toml {options}"), &[expected]);
        assert_eq!(folder.names(), before);
    }
}
