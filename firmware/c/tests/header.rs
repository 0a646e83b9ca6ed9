//! `include/stiction.h` is what cbindgen generates from the crate.

use std::fs;
use std::path::Path;

use cbindgen::{Builder, Config};

/// With STICTION_HEADER=write the header is generated again.
#[test]
fn the_header_is_that_of_the_crate() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = Config::from_file(folder.join("cbindgen.toml")).expect("a configuration");
    let builder = Builder::new().with_config(config).with_crate(folder);
    let mut made = Vec::new();
    builder.generate().expect("a header").write(&mut made);
    let file = folder.join("include/stiction.h");
    if std::env::var_os("STICTION_HEADER").is_some_and(|what| what == "write") {
        fs::write(&file, &made).expect("the header");
    }
    let there = fs::read(&file).expect("the header");
    assert!(
        there == made,
        "{} is of another version of the crate; STICTION_HEADER=write cargo test -p stiction-c --test header generates it again",
        file.display()
    );
}
