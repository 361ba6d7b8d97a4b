//! Reads files of results that may come from unknown sources: only regular files of limited size.

use serde_json::Value;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Maximum size of a summary, in bytes. A summary with a million periods and ten thousand contacts has about 40 MB.
const MOST_BYTES: u64 = 64 << 20;
/// Maximum number of values in a summary. A value needs about a hundred bytes of memory.
const MOST_VALUES: usize = 2_500_000;

/// Opens a regular file.
///
/// Files of other types are rejected, because opening a named pipe would wait for a writer.
///
/// # Errors
/// The path is not a regular file or cannot be opened.
pub fn open(path: &Path) -> io::Result<File> {
    plain(&path.metadata()?)?;
    let file = File::open(path)?;
    // The file may have been replaced in the meantime.
    plain(&file.metadata()?)?;
    Ok(file)
}

fn plain(found: &std::fs::Metadata) -> io::Result<()> {
    match (found.is_file(), found.is_dir()) {
        (true, _) => Ok(()),
        (_, true) => Err(io::ErrorKind::IsADirectory.into()),
        _ => Err(io::Error::new(io::ErrorKind::InvalidInput, "not a regular file")),
    }
}

/// Reads the bytes of a regular file.
///
/// # Errors
/// The file cannot be read or exceeds the maximum size of a summary.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open(path)?.take(MOST_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(io::Error::other(format!("the file has more than {MOST_BYTES} bytes")));
    }
    Ok(bytes)
}

/// Reads a regular file as UTF-8 text.
///
/// # Errors
/// The same errors as for [`read`], or the file is not UTF-8.
pub fn text(path: &Path) -> io::Result<String> {
    String::from_utf8(read(path)?).map_err(|_| io::Error::other("the file is not UTF-8 text"))
}

/// Reads a regular file as JSON. The JSON library limits the nesting depth to 127.
///
/// # Errors
/// The same errors as for [`read`], or the file is not JSON or has too many values.
pub fn json(path: &Path) -> io::Result<Value> {
    let bytes = read(path)?;
    // Every value except the first one follows one of these characters. Characters in strings are counted, too.
    let values = bytes.iter().filter(|byte| matches!(byte, b',' | b'[' | b'{' | b':')).count();
    if values > MOST_VALUES {
        return Err(io::Error::other(format!("the file has more than {MOST_VALUES} values")));
    }
    Ok(serde_json::from_slice(&bytes)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn a_file_of_another_kind_or_without_end_is_refused() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("summary.json");
        let refused = |text: String| {
            fs::write(&path, text).unwrap();
            json(&path).unwrap_err().to_string()
        };
        assert_eq!(json(root.path()).unwrap_err().kind(), io::ErrorKind::IsADirectory);
        assert!(json(&path).is_err_and(|error| error.kind() == io::ErrorKind::NotFound));
        assert!(refused("[".repeat(1000)).contains("recursion limit"), "{}", refused("[".repeat(1000)));
        assert_eq!(
            refused(format!("[{}0]", "0,".repeat(2_500_000))),
            "the file has more than 2500000 values"
        );
        File::create(&path).unwrap().set_len(MOST_BYTES + 1).unwrap();
        assert_eq!(read(&path).unwrap_err().to_string(), "the file has more than 67108864 bytes");
        fs::write(&path, "{}").unwrap();
        assert_eq!(json(&path).unwrap(), Value::Object(serde_json::Map::new()));
    }

    #[cfg(unix)]
    #[test]
    fn a_pipe_and_a_device_are_not_waited_for() {
        let root = tempfile::tempdir().unwrap();
        let pipe = root.path().join("pipe");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        std::os::unix::fs::symlink("/dev/zero", root.path().join("zero")).unwrap();
        for name in ["pipe", "zero"] {
            let error = open(&root.path().join(name)).unwrap_err();
            assert_eq!(error.to_string(), "not a regular file", "{name}");
        }
    }
}
