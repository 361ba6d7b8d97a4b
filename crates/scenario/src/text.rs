//! Reads files as text, with a size limit and a check of the encoding.

use crate::{folder, suggest};
use std::fs::File;
use std::io::{self, Read};
use std::ops::Range;
use std::path::Path;

/// Text that is not valid UTF-8.
#[derive(Debug, PartialEq)]
pub(crate) struct Garbled {
    /// Text, with invalid parts replaced.
    pub(crate) text: String,
    /// Range of the invalid part.
    pub(crate) range: Range<usize>,
    pub(crate) message: String,
    pub(crate) help: String,
}

/// Returns the bytes of a file, or `None` if there are more than `limit`.
///
/// Folders, devices and named pipes are refused, because opening a named pipe waits for a writer without limit. Pipes of the shell have
/// no name and are read.
pub(crate) fn read(path: &Path, limit: usize) -> io::Result<Option<Vec<u8>>> {
    if path.canonicalize().is_ok_and(|named| !named.is_file()) {
        let kind = if path.is_dir() { io::ErrorKind::IsADirectory } else { io::ErrorKind::InvalidInput };
        return Err(io::Error::new(kind, "not a file"));
    }
    let mut bytes = Vec::new();
    File::open(path)?.take(limit as u64 + 1).read_to_end(&mut bytes)?;
    Ok((bytes.len() <= limit).then_some(bytes))
}

/// Returns message and help for a scenario that cannot be read.
pub(crate) fn unreadable(path: &Path, error: &io::Error) -> (String, Option<String>) {
    match error.kind() {
        io::ErrorKind::NotFound => {
            let names = folder::names(path.parent().unwrap_or(Path::new("")));
            let scenarios = names.iter().map(String::as_str).filter(|name| name.ends_with(".json"));
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            ("there is no such file".to_owned(), suggest::help(&name, scenarios))
        }
        io::ErrorKind::IsADirectory => {
            let files = path.join("*.json");
            (
                "this is a folder, not a scenario".to_owned(),
                Some(format!("name its files: {}", files.display())),
            )
        }
        io::ErrorKind::PermissionDenied => ("there is no permission to read this file".to_owned(), None),
        io::ErrorKind::InvalidInput => ("this is not a file".to_owned(), None),
        _ => (format!("cannot be read: {error}"), None),
    }
}

/// Decodes UTF-8 and removes a byte order mark.
pub(crate) fn decode(bytes: Vec<u8>) -> Result<String, Garbled> {
    if let Some(text) = utf_16(&bytes) {
        let message = "expected UTF-8 text, got UTF-16".to_owned();
        return Err(Garbled { text, range: 0..1, message, help: "save the file as UTF-8".to_owned() });
    }
    match String::from_utf8(bytes) {
        Ok(text) => Ok(text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text)),
        Err(error) => {
            let start = error.utf8_error().valid_up_to();
            let byte = error.as_bytes()[start];
            let help = match byte {
                0xa0.. => format!("save the file as UTF-8; as Latin-1 the byte is \"{}\"", char::from(byte)),
                _ => "save the file as UTF-8".to_owned(),
            };
            Err(Garbled {
                text: String::from_utf8_lossy(error.as_bytes()).into_owned(),
                range: start..start + '\u{fffd}'.len_utf8(),
                message: format!("expected UTF-8 text, got the byte 0x{byte:02X}"),
                help,
            })
        }
    }
}

/// Decodes UTF-16 with a byte order mark; otherwise returns `None`.
fn utf_16(bytes: &[u8]) -> Option<String> {
    let unit: fn([u8; 2]) -> u16 = match bytes.get(..2)? {
        [0xff, 0xfe] => u16::from_le_bytes,
        [0xfe, 0xff] => u16::from_be_bytes,
        _ => return None,
    };
    let (units, _) = bytes[2..].as_chunks::<2>();
    let units: Vec<u16> = units.iter().copied().map(unit).collect();
    Some(String::from_utf16_lossy(&units))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Opening a named pipe without a writer would wait forever. A pipe of the shell has no name and is read.
    #[cfg(unix)]
    #[test]
    fn pipes_with_a_name_are_refused_at_once_and_those_of_a_shell_are_read() {
        use std::process::{Command, Stdio};
        let folder = tempfile::tempdir().unwrap();
        let pipe = folder.path().join("pipe.json");
        assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let link = folder.path().join("link.json");
        std::os::unix::fs::symlink(&pipe, &link).unwrap();
        for path in [&pipe, &link] {
            let error = read(path, 9).unwrap_err();
            assert_eq!(unreadable(path, &error).0, "this is not a file");
        }
        let error = read(folder.path(), 9).unwrap_err();
        assert_eq!(unreadable(folder.path(), &error).0, "this is a folder, not a scenario");
        let mut shell = Command::new("echo").arg("{}").stdout(Stdio::piped()).spawn().unwrap();
        let descriptor = std::os::fd::AsRawFd::as_raw_fd(shell.stdout.as_ref().unwrap());
        let bytes = read(Path::new(&format!("/dev/fd/{descriptor}")), 9).unwrap();
        assert_eq!(bytes.as_deref(), Some(&b"{}\n"[..]));
        shell.wait().unwrap();
    }

    #[test]
    fn what_is_no_text_has_a_place() {
        assert_eq!(decode("\u{feff}ä".into()), Ok("ä".to_owned()));
        let garbled = decode(b"ab\xe4c".to_vec()).unwrap_err();
        assert_eq!((garbled.text.as_str(), garbled.range), ("ab\u{fffd}c", 2..5));
        assert!(garbled.help.ends_with("\"ä\""));
        for (mark, unit) in
            [([0xff, 0xfe], u16::to_le_bytes as fn(u16) -> [u8; 2]), ([0xfe, 0xff], u16::to_be_bytes)]
        {
            let bytes: Vec<u8> = mark.into_iter().chain("{ä".encode_utf16().flat_map(unit)).collect();
            let garbled = decode(bytes).unwrap_err();
            assert_eq!((garbled.text.as_str(), garbled.message.ends_with("UTF-16")), ("{ä", true));
        }
    }
}
