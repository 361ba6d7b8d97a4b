//! Files of results opened as if a stranger had sent them: no pipe is waited for, no device read, nothing without end.

use serde_json::Value;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Most bytes of a summary. A million periods and ten thousand contacts have some 40 MB.
const MOST_BYTES: u64 = 64 << 20;
/// Most values in a summary, each some hundred bytes in memory.
const MOST_VALUES: usize = 2_500_000;

/// Opens a plain file.
///
/// To open a pipe with a name would wait for whoever writes into it, which may be nobody.
pub fn open(path: &Path) -> io::Result<File> {
    plain(&path.metadata()?)?;
    let file = File::open(path)?;
    // It may have been replaced in between.
    plain(&file.metadata()?)?;
    Ok(file)
}

fn plain(found: &std::fs::Metadata) -> io::Result<()> {
    match (found.is_file(), found.is_dir()) {
        (true, _) => Ok(()),
        (_, true) => Err(io::ErrorKind::IsADirectory.into()),
        _ => Err(io::Error::new(io::ErrorKind::InvalidInput, "it is not a plain file")),
    }
}

/// The bytes of a plain file that has no more than a summary may have.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open(path)?.take(MOST_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(io::Error::other(format!("it has more than {MOST_BYTES} bytes")));
    }
    Ok(bytes)
}

/// The same as text.
pub fn text(path: &Path) -> io::Result<String> {
    String::from_utf8(read(path)?).map_err(|_| io::Error::other("it is not UTF-8 text"))
}

/// The JSON of a plain file. Its depth is bounded by the library, to 127.
pub fn json(path: &Path) -> io::Result<Value> {
    let bytes = read(path)?;
    // Every value but the first comes after one of these, inside of texts or not.
    let values = bytes.iter().filter(|byte| matches!(byte, b',' | b'[' | b'{' | b':')).count();
    if values > MOST_VALUES {
        return Err(io::Error::other(format!("it has more than {MOST_VALUES} values")));
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
        assert_eq!(refused(format!("[{}0]", "0,".repeat(2_500_000))), "it has more than 2500000 values");
        File::create(&path).unwrap().set_len(MOST_BYTES + 1).unwrap();
        assert_eq!(read(&path).unwrap_err().to_string(), "it has more than 67108864 bytes");
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
            assert_eq!(error.to_string(), "it is not a plain file", "{name}");
        }
    }
}
