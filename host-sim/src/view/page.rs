//! The files of the page, built into the program.

/// Path, type and bytes.
type File = (&'static str, &'static str, &'static [u8]);

const FILES: &[File] = &[(
    "/index.html",
    "text/html; charset=utf-8",
    include_bytes!("plain.html"),
)];

/// Type and bytes of the file at a path.
pub(super) fn find(path: &str) -> Option<(&'static str, &'static [u8])> {
    let path = match path {
        "/" => "/index.html",
        path => path,
    };
    let (_, kind, bytes) = FILES.iter().find(|(known, ..)| *known == path)?;
    Some((kind, bytes))
}
