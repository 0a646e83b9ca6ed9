//! A board as a user runs it, `cargo emulate` in its folder: the lines of its log, and its serial line a socket of the test.

use crate::board::connected;
use crate::chip::{Built, Chip};
use std::env;
use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::os::unix::net::UnixStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command as Process, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::Duration;

/// No build of an image takes longer, on a machine that builds others at the same time.
const BUILD_PATIENCE: Duration = Duration::from_secs(1800);
/// No line takes longer.
const PATIENCE: Duration = Duration::from_secs(300);

/// What a user sees, and what the client at the serial line does.
pub(crate) struct Session {
    folder: PathBuf,
    child: Child,
    log: Receiver<String>,
    line: UnixStream,
    /// Held until the first line of the log: the image, which the next one that is built would replace, has been read by then.
    image: Option<Built>,
}

impl Session {
    /// From power-up; nothing where something is missing.
    pub(crate) fn start(chip: &Chip) -> Option<Self> {
        chip.log_installed()?;
        // Built before; a missing tool has been reported.
        chip.image()?;
        let folder = env::temp_dir().join(format!(
            "stiction-log-{}-{}",
            std::process::id(),
            chip.name()
        ));
        fs::create_dir_all(&folder).unwrap();
        let at = |name: &str| format!("unix:{},server=on", folder.join(name).display());
        let image = chip.built();
        let mut child = Process::new("cargo");
        child
            .args(["emulate", "--locked", "--"])
            // In addition to the empty one, for the end.
            .args(["-monitor", &(at("monitor") + ",wait=off")])
            .env("SERIAL", at("line") + ",wait=on")
            .env("ICOUNT", format!("shift={}", chip.shift))
            .env_remove("STICTION_SCENE")
            .env_remove("DEFMT_LOG")
            .current_dir(chip.board.folder())
            .stdin(Stdio::null())
            .stdout(Stdio::piped());
        let mut child = child.spawn().unwrap();
        let log = lines(child.stdout.take().unwrap());
        let first = log.recv_timeout(BUILD_PATIENCE).expect("the line is named");
        assert_eq!(first, format!("serial line: {},wait=on", at("line")));
        let line = connected(&folder.join("line"));
        received_by_nobody(line.try_clone().unwrap());
        Some(Self {
            folder,
            child,
            log,
            line,
            image: Some(image),
        })
    }

    /// The next line of the log, without the level that all but errors have.
    pub(crate) fn line(&mut self) -> String {
        let line = self.log.recv_timeout(PATIENCE).expect("the board logs");
        self.image = None;
        line.trim_start_matches("INFO").trim_start().to_owned()
    }

    pub(crate) fn send(&mut self, bytes: &[u8]) {
        self.line.write_all(bytes).unwrap();
    }

    /// The emulator ends, and all that it has begun: how it ended.
    fn end(&mut self, monitor: &Path) -> bool {
        // Where it never was, there is nothing to end but what began it.
        match UnixStream::connect(monitor).and_then(|mut monitor| writeln!(monitor, "quit")) {
            Ok(()) => {}
            Err(_) => drop(self.child.kill()),
        }
        self.child.wait().is_ok_and(|status| status.success())
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        let ended = self.end(&self.folder.join("monitor"));
        let _ = fs::remove_dir_all(&self.folder);
        assert!(ended || thread::panicking(), "cargo emulate failed");
    }
}

fn lines(from: impl Read + Send + 'static) -> Receiver<String> {
    let (sender, receiver) = channel();
    thread::spawn(move || {
        let lines = BufReader::new(from).lines().map_while(Result::ok);
        // The test may have ended.
        for line in lines {
            if sender.send(line).is_err() {
                break;
            }
        }
    });
    receiver
}

/// What the board sends is taken from the line, so that it can send more.
fn received_by_nobody(mut line: UnixStream) {
    thread::spawn(move || {
        let mut bytes = [0; 4096];
        while line.read(&mut bytes).is_ok_and(|count| count > 0) {}
    });
}
