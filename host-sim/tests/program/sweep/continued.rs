//! What a run leaves behind when it ends early, and how the next one goes on.

use std::fs;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use super::{folder, table};
use crate::common::{Folder, SCENE};
#[cfg(unix)]
use crate::common::{Signal, send};

const SWEEP: &str = r#"
scenes = ["scene.toml"]
[vary]
"friction.static" = { from = 0.2, to = 0.9, steps = 8 }
"spring.rotation" = [0.25, 0.5, 1.0]
"#;

/// A folder in which every row takes a while.
fn slow() -> Folder {
    let folder = folder(SWEEP);
    folder.write(
        "scene.toml",
        SCENE.replace("rate = 10.0", "rate = 100000.0"),
    );
    folder
}

fn start(folder: &Folder) -> Child {
    Command::new(env!("CARGO_BIN_EXE_stiction"))
        .args("sweep sweep.toml --out out.csv --threads 2 --quiet".split(' '))
        .current_dir(folder.file(""))
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts")
}

/// Waits until a table has so many lines.
fn wait_for(folder: &Folder, lines: usize) {
    let count =
        || fs::read_to_string(folder.file("out.csv")).map_or(0, |table| table.lines().count());
    while count() < lines {
        sleep(Duration::from_millis(1));
    }
}

/// The sweep is refused with a message that holds `expected`, and nothing is changed.
fn assert_refused(folder: &Folder, options: &str, expected: &[&str]) {
    let (names, before) = (folder.names(), folder.read("out.csv"));
    folder.refused(
        &format!("sweep sweep.toml --out out.csv {options}"),
        expected,
    );
    assert_eq!((folder.names(), folder.read("out.csv")), (names, before));
}

/// Whoever writes to a pipe and reads from it waits for itself.
#[cfg(unix)]
#[test]
fn a_pipe_beside_the_table_is_refused() {
    let folder = folder(SWEEP);
    table(&folder, "out.csv", "");
    let beside = folder.file("out.csv.sweep");
    fs::remove_file(&beside).expect("the digests");
    nix::unistd::mkfifo(&beside, nix::sys::stat::Mode::S_IRWXU).expect("a pipe");
    assert_refused(
        &folder,
        "",
        &["out.csv.sweep: ", "it is not a file on a disk"],
    );
}

#[test]
fn a_row_without_end_is_refused() {
    let folder = folder(SWEEP);
    let mut rows = table(&folder, "out.csv", "");
    rows.push_str(&"1".repeat(3 << 20));
    folder.write("out.csv", rows);
    assert_refused(
        &folder,
        "",
        &["out.csv, line 26: is not the row of index 24"],
    );
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let folder = folder(SWEEP);
    let one = table(&folder, "1.csv", "--threads 1");
    for threads in ["2", "3", "8"] {
        assert_eq!(
            table(
                &folder,
                &format!("{threads}.csv"),
                &format!("--threads {threads}")
            ),
            one
        );
    }
}

#[test]
fn a_killed_sweep_continues_to_the_bytes_of_one_that_was_not() {
    let folder = slow();
    let whole = table(&folder, "whole.csv", "");
    for moment in (0..300).step_by(30) {
        let mut child = start(&folder);
        sleep(Duration::from_millis(moment));
        child.kill().expect("the program is killed");
        child.wait().expect("the program ends");
    }
    assert_eq!(table(&folder, "out.csv", ""), whole);
    // Killed when rows are there for sure.
    for lines in [1, 2, 9, 20] {
        let _ = fs::remove_file(folder.file("out.csv"));
        let mut child = start(&folder);
        wait_for(&folder, lines);
        child.kill().expect("the program is killed");
        child.wait().expect("the program ends");
        assert!(whole.starts_with(&folder.read("out.csv")));
        assert_eq!(table(&folder, "out.csv", ""), whole);
    }
}

#[test]
fn a_table_that_is_cut_at_any_byte_is_completed() {
    let folder = folder(SWEEP);
    for shard in ["1/1", "2/2"] {
        let whole = table(&folder, "out.csv", &format!("--shard {shard}"));
        // The last rows, and all that can be left of the header.
        let header = 0..=whole.find('\n').expect("a line").min(20);
        for length in header.chain(whole.len() - 300..=whole.len()) {
            folder.write("out.csv", &whole[..length]);
            assert_eq!(
                table(&folder, "out.csv", &format!("--shard {shard}")),
                whole,
                "{length}"
            );
        }
        fs::remove_file(folder.file("out.csv")).expect("the table");
    }
}

#[cfg(unix)]
#[test]
fn an_interrupted_sweep_leaves_whole_rows_and_says_so_in_its_status() {
    let folder = slow();
    let whole = table(&folder, "whole.csv", "");
    let mut child = start(&folder);
    wait_for(&folder, 2);
    send(Signal::SIGINT, &child);
    assert_eq!(child.wait().expect("the program ends").code(), Some(1));
    let part = folder.read("out.csv");
    assert!(whole.starts_with(&part) && part.ends_with('\n') && part.len() < whole.len());
    assert_eq!(table(&folder, "out.csv", ""), whole);
}

#[test]
fn two_sweeps_do_not_write_one_table() {
    let folder = slow();
    let mut child = start(&folder);
    wait_for(&folder, 1);
    folder.refused("sweep sweep.toml --out out.csv", &["another sweep"]);
    child.kill().expect("the program is killed");
    child.wait().expect("the program ends");
}

#[test]
fn rows_of_other_input_are_not_continued() {
    let folder = folder(SWEEP);
    table(&folder, "out.csv", "");
    folder.write("sweep.toml", SWEEP.replace("0.25", "0.3"));
    assert_refused(&folder, "", &["out.csv", "(sweep file)", "allowed"]);
    folder.write("sweep.toml", SWEEP);
    folder.write("scene.toml", SCENE.replace("0.3", "0.31"));
    assert_refused(&folder, "", &["out.csv", "(scene \"scene.toml\")"]);
    folder.write("scene.toml", SCENE);
    assert_refused(&folder, "--shard 1/2", &["(shard)"]);
    assert_refused(&folder, "--time", &["(columns)"]);
}

#[test]
fn recorded_hands_are_input_too() {
    let folder = folder("scenes = [\"scene.toml\"]\n[vary]\n\"run.hand\" = [\"hand.csv\"]\n");
    folder.write("hand.csv", "t,x,y,phi\n0,0.2,0.14,0.5\n");
    table(&folder, "out.csv", "");
    folder.write("hand.csv", "t,x,y,phi\n0,0.2,0.15,0.5\n");
    assert_refused(&folder, "", &["(hand 1 \"hand.csv\")"]);
}

#[test]
fn a_row_that_was_changed_is_found() {
    let folder = folder(SWEEP);
    let whole = table(&folder, "out.csv", "");
    for (line, row) in (1..).zip(whole.lines()).skip(1) {
        // Its last digit is another one.
        let digit = row.rfind(|c: char| c.is_ascii_digit()).expect("a number");
        let other = if &row[digit..=digit] == "7" { "3" } else { "7" };
        let mut changed = row.to_owned();
        changed.replace_range(digit..=digit, other);
        folder.write("out.csv", whole.replacen(row, &changed, 1));
        let expected = format!("out.csv, line {line}: is not the row of index {}", line - 2);
        assert_refused(&folder, "", &[&expected]);
    }
    // A row of which nothing is known is made again.
    folder.write("out.csv", whole.replacen("ok", "good", 1));
    let beside = folder.read("out.csv.sweep");
    let (inputs, _) = beside.split_once("rows:\n").expect("digests");
    for left in [
        inputs.to_owned(),
        format!("{inputs}rows:\n"),
        format!("{inputs}rows:\n0123"),
    ] {
        folder.write("out.csv.sweep", left);
        assert_eq!(table(&folder, "out.csv", ""), whole);
        assert_eq!(folder.read("out.csv.sweep"), beside);
    }
}

#[test]
fn files_that_are_not_as_a_sweep_left_them_are_refused() {
    let folder = folder(SWEEP);
    let whole = table(&folder, "out.csv", "");
    let without_a_row: String = whole
        .lines()
        .enumerate()
        .filter(|(i, _)| *i != 5)
        .map(|(_, line)| format!("{line}\n"))
        .collect();
    folder.write("out.csv", without_a_row);
    assert_refused(&folder, "", &["out.csv, line 6", "index 4"]);
    folder.write("out.csv", whole.replacen("index", "number", 1));
    assert_refused(&folder, "", &["out.csv, line 1", "header"]);
    folder.write("out.csv", format!("{whole}24,more\n"));
    assert_refused(&folder, "", &["out.csv, line 26"]);
    folder.write("out.csv", "notes\n");
    fs::remove_file(folder.file("out.csv.sweep")).expect("the file beside the table");
    assert_refused(&folder, "", &["out.csv", "no sweep wrote it"]);
}
