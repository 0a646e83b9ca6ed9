//! External programs: what they print, why they failed, and the command that installs missing ones.

use std::env;
use std::io::{self, Read, Write};
use std::process::{Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// A program that runs longer than this is considered hung.
const LONGEST: Duration = Duration::from_secs(1800);

/// Why an emulated run gave no result.
#[derive(Debug, thiserror::Error)]
pub enum EmulatorError {
    /// Something is not installed.
    #[error("missing: {what}; to install it: {install}")]
    Missing {
        /// Its name.
        what: String,
        /// The command that installs it.
        install: String,
    },
    /// A program failed.
    #[error("{program} failed ({status}){message}")]
    Failed {
        /// Its name.
        program: String,
        /// Its exit status.
        status: ExitStatus,
        /// Its message, after a line break.
        message: String,
    },
    /// A program did not end.
    #[error("{0} was ended after {limit} s", limit = LONGEST.as_secs())]
    Hung(String),
    /// An image or an answer is not as expected.
    #[error("not understood: {0}")]
    Output(String),
    /// A file cannot be read or written, or a program cannot be started.
    #[error(transparent)]
    File(#[from] io::Error),
}

/// Runs a program to its end and returns its output.
///
/// # Errors
/// It is missing, fails or hangs.
pub fn output_of(mut command: Command) -> Result<String, EmulatorError> {
    let program = command.get_program().to_string_lossy().into_owned();
    let child = command
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn();
    let mut child = match child {
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            let install = install(&program);
            return Err(EmulatorError::Missing {
                what: program,
                install,
            });
        }
        other => other?,
    };
    let (out, err) = (text(child.stdout.take()), text(child.stderr.take()));
    let begun = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait()? {
            break status;
        }
        if begun.elapsed() > LONGEST {
            child.kill()?;
            child.wait()?;
            return Err(EmulatorError::Hung(program));
        }
        thread::sleep(Duration::from_millis(5));
    };
    let (out, err) = (joined(out)?, joined(err)?);
    if status.success() {
        return Ok(out);
    }
    Err(failure(program, status, &err))
}

/// Reads everything that a program prints while it runs.
fn text(pipe: Option<impl Read + Send + 'static>) -> thread::JoinHandle<io::Result<String>> {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        if let Some(mut pipe) = pipe {
            pipe.read_to_end(&mut bytes)?;
        }
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    })
}

fn joined(text: thread::JoinHandle<io::Result<String>>) -> io::Result<String> {
    text.join().unwrap_or_else(|_| Ok(String::new()))
}

/// The first QEMU whose boards are complete: serial lines, timers and clocks.
const OLDEST_QEMU: u32 = 10;

/// Checks that QEMU for boards with an ARM processor is installed, and new enough.
///
/// # Errors
/// It is not.
pub fn require_qemu_arm() -> Result<(), EmulatorError> {
    let program = "qemu-system-arm";
    let mut command = Command::new(program);
    command.arg("--version");
    let said = output_of(command)?;
    match major_version(&said) {
        Some(major) if major < OLDEST_QEMU => Err(EmulatorError::Missing {
            what: format!("{program} {OLDEST_QEMU} or newer (here is {major})"),
            install: install(program),
        }),
        _ => Ok(()),
    }
}

/// The name of the system's release, as used in its package sources.
fn codename() -> Option<String> {
    let about = std::fs::read_to_string("/etc/os-release").ok()?;
    let mut lines = about.lines();
    let name = lines.find_map(|line| line.strip_prefix("VERSION_CODENAME="))?;
    Some(name.trim_matches('"').to_owned())
}

/// The commands that install a package with QEMU. The version in Debian 12 is too old; a newer one is in its backports, on the same
/// server as its other packages.
fn install_qemu(package: &str, codename: Option<&str>) -> String {
    let install =
        |suite: &str| format!("apt-get install -y --no-install-recommends {suite}{package}");
    let Some(codename @ "bookworm") = codename else {
        return install("");
    };
    let suite = format!("{codename}-backports");
    let mirror = format!(
        "$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' 'Release: {codename}' | head -n 1)"
    );
    let install = install(&format!("-t {suite} "));
    format!(
        "as root\n  apt-get update\n  echo \"deb {mirror} {suite} main\" >/etc/apt/sources.list.d/{suite}.list\n  apt-get update\n  {install}"
    )
}

fn major_version(said: &str) -> Option<u32> {
    let (_, version) = said.split_once("version ")?;
    version.split('.').next()?.parse().ok()
}

/// Recognises failures due to a missing tool.
fn failure(program: String, status: ExitStatus, message: &str) -> EmulatorError {
    let target = message
        .split_once("target may not be installed")
        .and_then(|(before, _)| before.trim_end().rsplit('`').nth(1));
    if let Some(target) = target {
        return EmulatorError::Missing {
            what: format!("the target {target}"),
            install: format!("rustup target add {target}"),
        };
    }
    if message.contains("linker `flip-link` not found") {
        return EmulatorError::Missing {
            what: "flip-link".to_owned(),
            install: install("flip-link"),
        };
    }
    EmulatorError::Failed {
        program,
        status,
        message: match message.trim() {
            "" => String::new(),
            text => format!("\n{text}"),
        },
    }
}

pub(crate) fn install(program: &str) -> String {
    let qemu = |package| install_qemu(package, codename().as_deref());
    match program {
        "qemu-system-arm" => qemu("qemu-system-arm"),
        "qemu-system-riscv32" => qemu("qemu-system-misc"),
        "arm-none-eabi-gcc" => {
            "apt-get install -y --no-install-recommends gcc-arm-none-eabi".to_owned()
        }
        "node" => "apt-get install -y --no-install-recommends nodejs".to_owned(),
        "gcc" => "apt-get install -y --no-install-recommends gcc libc6-dev".to_owned(),
        "cmake" => "apt-get install -y --no-install-recommends cmake make".to_owned(),
        "clang" | "clang++" => {
            "apt-get install -y --no-install-recommends clang libclang-rt-dev".to_owned()
        }
        "flip-link" | "defmt-print" => format!("cargo install {program}"),
        _ => format!("see the documentation of {program}"),
    }
}

/// For tests: `None` if something is not installed, which is then reported on standard error.
///
/// # Panics
/// On any other error; with CI=true, when everything must be installed, on this one too.
pub fn if_installed<T>(result: Result<T, EmulatorError>) -> Option<T> {
    match result {
        Ok(value) => Some(value),
        Err(error @ EmulatorError::Missing { .. }) if may_skip(&error.to_string()) => None,
        Err(error) => panic!("{error}"),
    }
}

/// For tests: whether a message reports a missing tool and the test may be skipped because of it, which is the case without
/// CI=true. A skip is reported on standard error.
pub fn may_skip(message: &str) -> bool {
    let skipped = message.contains("missing: ") && env::var("CI").as_deref() != Ok("true");
    if skipped {
        // `println!` would show nothing in a test that passes.
        let _ = writeln!(io::stderr(), "skipped: {message}");
    }
    skipped
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shell(script: &str) -> Result<String, EmulatorError> {
        let mut command = Command::new("sh");
        command.arg("-c").arg(script);
        output_of(command)
    }

    #[test]
    fn a_program_gives_what_it_prints_or_says_why_it_failed() {
        assert_eq!(shell("echo yes").unwrap(), "yes\n");
        for (script, expected) in [
            (
                "echo '= note: the `thumbv6m-none-eabi` target may not be installed' >&2; exit 1",
                "missing: the target thumbv6m-none-eabi; to install it: rustup target add thumbv6m-none-eabi",
            ),
            (
                "echo 'error: linker `flip-link` not found' >&2; exit 1",
                "missing: flip-link; to install it: cargo install flip-link",
            ),
            (
                "echo broken >&2; exit 3",
                "sh failed (exit status: 3)\nbroken",
            ),
        ] {
            assert_eq!(shell(script).unwrap_err().to_string(), expected);
        }
        let error = output_of(Command::new("qemu-system-none")).unwrap_err();
        assert!(matches!(error, EmulatorError::Missing { .. }), "{error}");
        assert!(install("qemu-system-riscv32").ends_with("qemu-system-misc"));
    }

    #[test]
    fn the_version_of_qemu_is_read() {
        let said = "QEMU emulator version 10.0.2 (Debian 1:10.0.2+ds-2)\nCopyright";
        assert_eq!(major_version(said), Some(10));
        assert_eq!(major_version("something else"), None);
    }

    #[test]
    fn a_newer_qemu_comes_from_the_backports_of_the_systems_own_mirror() {
        let commands = install_qemu("qemu-system-arm", Some("bookworm"));
        let lines: Vec<&str> = commands.lines().collect();
        assert_eq!(lines[..2], ["as root", "  apt-get update"]);
        assert!(lines[2].ends_with(
            "bookworm-backports main\" >/etc/apt/sources.list.d/bookworm-backports.list"
        ));
        // No host is named.
        assert!(!commands.contains("://"), "{commands}");
        assert_eq!(
            lines[3..],
            [
                "  apt-get update",
                "  apt-get install -y --no-install-recommends -t bookworm-backports qemu-system-arm"
            ]
        );
        for other in [Some("trixie"), None] {
            assert_eq!(
                install_qemu("qemu-system-arm", other),
                "apt-get install -y --no-install-recommends qemu-system-arm"
            );
        }
    }
}
