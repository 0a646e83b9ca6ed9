//! Text files of users, read with limits: from a file name to the bytes of the file ([`read`]) or to its lines ([`Lines`]), or to an
//! error that states the problem and what is allowed. Neither memory nor time depends on what an untrusted file contains.
//!
//! Only files on a disk are read. A device may have no end, and a pipe no writer.
//!
//! Of a word that nothing has as its name, the name that was probably meant ([`nearest`]).

mod nearest;

pub use nearest::{nearest, unknown};

use std::fs::{self, File};
use std::io::{self, BufRead, Read};
use std::path::Path;

/// The largest size of a file that is read as a whole (bytes). The numbers of the largest scene, 64 vertices, 16 surfaces and 128
/// corners, take less than 32 KiB; the rest has space for 8000 keyframes of five numbers with all their digits. A longer motion is a
/// recorded path, which is read line by line.
pub const LONGEST_WHOLE: u64 = 1 << 20;

/// Opens a file of at most `limit` bytes.
///
/// # Errors
/// The file does not exist, is not a file on a disk, or is longer; the message does not contain its name.
pub fn open(file: &Path, limit: u64) -> Result<File, String> {
    let about = fs::metadata(file).map_err(|error| unread(&error))?;
    if about.is_dir() {
        return Err("is a folder, allowed: a file".to_owned());
    }
    if !about.is_file() {
        return Err(
            "is a device, a pipe or a socket, allowed: a file on a disk, which has an end"
                .to_owned(),
        );
    }
    if about.len() > limit {
        return Err(too_long(&about.len().to_string(), limit));
    }
    File::open(file).map_err(|error| unread(&error))
}

/// The bytes of a file, at most [`LONGEST_WHOLE`].
///
/// # Errors
/// As for [`open`]; or the file cannot be read.
pub fn read(file: &Path) -> Result<Vec<u8>, String> {
    read_up_to(file, LONGEST_WHOLE)
}

fn read_up_to(file: &Path, limit: u64) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    // Files that the system generates while they are read have no length in advance.
    let mut given = open(file, limit)?.take(limit + 1);
    let count = given.read_to_end(&mut bytes);
    match count.map_err(|error| unread(&error))? as u64 > limit {
        true => Err(too_long(&format!("more than {limit}"), limit)),
        false => Ok(bytes),
    }
}

fn unread(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "cannot be read: no such file".to_owned(),
        _ => format!("cannot be read: {error}"),
    }
}

fn too_long(count: &str, limit: u64) -> String {
    format!("is {count} bytes long, allowed: at most {limit}")
}

/// The lines of a text in order, as bytes, none longer than a limit.
#[derive(Debug)]
pub struct Lines<R> {
    reader: R,
    limit: usize,
    number: usize,
    text: Vec<u8>,
    is_whole: bool,
}

impl<R: BufRead> Lines<R> {
    /// The lines from a reader, of at most `limit` bytes each, without the line break.
    pub const fn new(reader: R, limit: usize) -> Self {
        Self {
            reader,
            limit,
            number: 0,
            text: Vec::new(),
            is_whole: false,
        }
    }

    /// The next line, without its break and without a byte order mark; `None` at the end.
    ///
    /// # Errors
    /// The line is too long, or has carriage returns and no line break, in which case [`Self::text`] is its beginning; or it cannot be read.
    pub fn advance(&mut self) -> Result<Option<&[u8]>, String> {
        self.text.clear();
        // Space for both characters of a line break.
        let room = self.limit as u64 + 2;
        let mut given = self.reader.by_ref().take(room);
        let count = given.read_until(b'\n', &mut self.text);
        self.number += 1;
        if count.map_err(|error| unread(&error))? == 0 {
            return Ok(None);
        }
        self.is_whole = self.text.ends_with(b"\n");
        for end in [b'\n', b'\r'] {
            if self.text.last() == Some(&end) {
                self.text.pop();
            }
        }
        if !self.is_whole && self.text.contains(&b'\r') {
            let problem = "has carriage returns, allowed: lines that end with LF or CR LF";
            return Err(problem.to_owned());
        }
        if self.text.len() > self.limit {
            let limit = self.limit;
            return Err(format!(
                "is longer than {limit} bytes, allowed: at most {limit} in a line"
            ));
        }
        const MARK: &[u8] = "\u{feff}".as_bytes();
        if self.number == 1 && self.text.starts_with(MARK) {
            self.text.drain(..MARK.len());
        }
        Ok(Some(&self.text))
    }

    /// The number of the last line read, counted from 1; at the end, that of the line that would follow.
    pub const fn number(&self) -> usize {
        self.number
    }

    /// Whether the last line read has a break; the last line of a text may have none.
    pub const fn is_whole(&self) -> bool {
        self.is_whole
    }

    /// The last line read, without its break and without a byte order mark; or the beginning of a line that cannot be used.
    pub fn text(&self) -> &[u8] {
        &self.text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_read_up_to_its_limit() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("file");
        fs::write(&file, "12345").expect("a file");
        assert_eq!(read_up_to(&file, 5).expect("five bytes"), b"12345");
        let refused = read_up_to(&file, 4).expect_err("five bytes");
        assert_eq!(refused, "is 5 bytes long, allowed: at most 4");
        let folder = read(folder.path()).expect_err("a folder");
        assert_eq!(folder, "is a folder, allowed: a file");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn what_has_no_end_is_not_read() {
        let device = read(Path::new("/dev/zero")).expect_err("a device");
        assert!(device.starts_with("is a device"), "{device}");
        // It has no length until it is read.
        let made = read_up_to(Path::new("/proc/self/status"), 4).expect_err("more than four bytes");
        assert_eq!(made, "is more than 4 bytes long, allowed: at most 4");
    }

    #[test]
    fn lines_end_with_either_break_or_the_text() {
        let mut lines = Lines::new("\u{feff}ab\r\n\ncd\nabcd".as_bytes(), 3);
        // The mark is three bytes, which count towards the limit.
        lines.limit = 5;
        assert_eq!(lines.advance(), Ok(Some(&b"ab"[..])));
        assert_eq!(lines.advance(), Ok(Some(&b""[..])));
        lines.limit = 3;
        assert_eq!(lines.advance(), Ok(Some(&b"cd"[..])));
        assert!(lines.is_whole());
        let refused = lines.advance().expect_err("too long");
        assert_eq!(
            refused,
            "is longer than 3 bytes, allowed: at most 3 in a line"
        );
        assert_eq!((lines.number(), lines.text()), (4, &b"abcd"[..]));
        assert!(!lines.is_whole());
        assert_eq!(lines.advance(), Ok(None));
    }

    #[test]
    fn a_line_without_end_takes_no_memory() {
        let mut lines = Lines::new(io::BufReader::new(io::repeat(b'0')), 10);
        assert!(lines.advance().is_err());
        assert!(lines.text().len() <= 12);
    }
}
