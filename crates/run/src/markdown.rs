//! Text functions for Markdown pages: links, command line arguments and escaping.

use std::fmt::Write;
use std::io;
use std::path::{Component, Path, PathBuf};

/// Returns the path of a file relative to a folder.
///
/// # Errors
/// One of the paths cannot be resolved.
pub fn relative(file: &Path, folder: &Path) -> io::Result<PathBuf> {
    let (file, folder) = (file.canonicalize()?, folder.canonicalize()?);
    let common = file.components().zip(folder.components()).take_while(|(a, b)| a == b).count();
    let up = folder.components().skip(common).map(|_| Component::ParentDir);
    Ok(up.chain(file.components().skip(common)).collect())
}

/// Returns a path as a URL: with slashes on every system and percent-encoded special characters.
pub fn link(path: &Path) -> String {
    let parts: Vec<String> =
        path.components().map(|part| part.as_os_str().to_string_lossy().into_owned()).collect();
    let mut link = String::new();
    for byte in parts.join("/").bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'.' | b'-' | b'_' | b'@' => {
                link.push(char::from(byte));
            }
            byte => {
                let _ = write!(link, "%{byte:02X}");
            }
        }
    }
    link
}

/// Returns a path as an argument of a command line.
pub fn word(path: &Path) -> String {
    let text = path.to_string_lossy().replace('\\', "/");
    let is_plain = text.chars().all(|c| c.is_ascii_alphanumeric() || "/._-@".contains(c));
    if is_plain { text } else { format!("\"{text}\"") }
}

/// Returns a text in which the special characters of Markdown and HTML are escaped.
pub fn plain(text: &str) -> String {
    let mut plain = String::new();
    for c in text.chars() {
        match c {
            '<' => plain.push_str("&lt;"),
            '>' => plain.push_str("&gt;"),
            '&' => plain.push_str("&amp;"),
            '"' => plain.push_str("&quot;"),
            '*' | '_' | '[' | ']' | '`' | '|' | '#' | '\\' => {
                let _ = write!(plain, "&#{};", u32::from(c));
            }
            c if c.is_control() => plain.push(' '),
            c => plain.push(c),
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_from_folder_to_file_goes_up_as_far_as_needed() {
        let root = tempfile::tempdir().unwrap();
        let (scenarios, out) = (root.path().join("a/scenarios"), root.path().join("a/b/plots"));
        std::fs::create_dir_all(&scenarios).unwrap();
        std::fs::create_dir_all(&out).unwrap();
        std::fs::write(scenarios.join("p 1.json"), "").unwrap();
        let way = relative(&scenarios.join("p 1.json"), &out).unwrap();
        assert_eq!(link(&way), "../../scenarios/p%201.json");
        assert!(relative(&scenarios.join("none.json"), &out).is_err());
    }

    #[test]
    fn titles_and_names_do_not_become_markup() {
        assert_eq!(plain("a*b <i>_c_</i> \"d\" µ"), "a&#42;b &lt;i&gt;&#95;c&#95;&lt;/i&gt; &quot;d&quot; µ");
        assert_eq!(
            (word(Path::new("a/p1.json")), word(Path::new("a b"))),
            ("a/p1.json".into(), "\"a b\"".into())
        );
    }
}
