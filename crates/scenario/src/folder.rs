//! Finds files in the folder of a scenario. Files outside the folder are neither read nor tested for existence.

use std::collections::VecDeque;
use std::io;
use std::path::{Component, Path, PathBuf};

/// Maximum number of symbolic links in the path of a file.
const MAX_LINKS: u32 = 40;

/// Maximum number of file names compared for a "did you mean" text.
const MAX_NAMES: usize = 1000;

/// Reason why a file is not accessible.
#[derive(Debug)]
pub(crate) enum Denied {
    /// The path leads out of the folder. The result does not depend on whether the file exists.
    Outside,
    /// The folder contains no such file.
    NotThere,
    /// The path is a folder or a device.
    NotAFile,
    /// The system cannot read the path.
    Unreadable(io::Error),
}

/// Returns the resolved path of a file in a folder or its subfolders. Links and `..` may lead through parent folders if they return.
///
/// Path components are resolved one by one, and only paths inside the folder are tested. For a path that ends outside, the result
/// therefore does not depend on what exists there.
pub(crate) fn find(folder: &Path, file: &Path) -> Result<PathBuf, Denied> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let folder = folder.canonicalize().map_err(Denied::Unreadable)?;
    let mut here = folder.clone();
    let mut ahead: VecDeque<PathBuf> = steps(file).into();
    let mut links = 0;
    while let Some(step) = ahead.pop_front() {
        if step.as_os_str() == ".." {
            here.pop();
        } else {
            // An absolute component starts a new path.
            here.push(&step);
        }
        if here.starts_with(&folder) {
            if here.symlink_metadata().map_err(denied)?.is_symlink() {
                links += 1;
                if links > MAX_LINKS {
                    return Err(Denied::Unreadable(io::Error::other("too many links")));
                }
                let target = here.read_link().map_err(Denied::Unreadable)?;
                here.pop();
                for step in steps(&target).into_iter().rev() {
                    ahead.push_front(step);
                }
            }
        } else if !folder.starts_with(&here) {
            return Err(Denied::Outside);
        }
    }
    match here.starts_with(&folder) {
        false => Err(Denied::Outside),
        true if here.is_file() => Ok(here),
        true => Err(Denied::NotAFile),
    }
}

fn denied(error: io::Error) -> Denied {
    match error.kind() {
        io::ErrorKind::NotFound | io::ErrorKind::NotADirectory => Denied::NotThere,
        _ => Denied::Unreadable(error),
    }
}

/// Returns the sorted names in a folder, or none if the folder cannot be read.
pub(crate) fn names(folder: &Path) -> Vec<String> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let entries = folder.read_dir().into_iter().flatten().take(MAX_NAMES).flatten();
    let mut names: Vec<String> = entries.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    names.sort();
    names
}

/// Returns the components of a path; prefix and root together are one component.
fn steps(path: &Path) -> Vec<PathBuf> {
    let mut steps = Vec::new();
    let mut root = PathBuf::new();
    for component in path.components() {
        match component {
            Component::Prefix(_) | Component::RootDir => root.push(component),
            Component::CurDir => {}
            Component::ParentDir | Component::Normal(_) => steps.push(PathBuf::from(component.as_os_str())),
        }
    }
    if !root.as_os_str().is_empty() {
        steps.insert(0, root);
    }
    steps
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::fs;
    use std::os::unix::fs::symlink;

    fn answer(folder: &Path, file: &str) -> String {
        match find(folder, Path::new(file)) {
            Ok(path) => path.file_name().map_or(String::new(), |name| name.to_string_lossy().into_owned()),
            Err(Denied::Outside) => "outside".to_owned(),
            Err(Denied::NotThere) => "not there".to_owned(),
            Err(Denied::NotAFile) => "not a file".to_owned(),
            Err(Denied::Unreadable(error)) => format!("{:?}", error.kind()),
        }
    }

    #[test]
    fn links_and_dots_are_resolved_step_by_step() {
        let all = tempfile::tempdir().unwrap();
        let root = all.path().canonicalize().unwrap();
        let inner = root.join("inner");
        fs::create_dir_all(inner.join("deep")).unwrap();
        fs::write(root.join("there"), "").unwrap();
        fs::write(inner.join("file"), "").unwrap();
        fs::write(inner.join("deep/below"), "").unwrap();
        symlink("deep/below", inner.join("good")).unwrap();
        symlink(inner.join("deep"), inner.join("absolute")).unwrap();
        symlink("../inner/file", inner.join("back")).unwrap();
        symlink("..", inner.join("up")).unwrap();
        symlink("round", inner.join("round")).unwrap();
        symlink(&inner, root.join("door")).unwrap();
        for (file, name) in [
            ("file", "file"),
            ("./deep/../file", "file"),
            ("../inner/file", "file"),
            ("good", "below"),
            ("absolute/below", "below"),
            ("absolute/../file", "file"),
            ("back", "file"),
            ("up/inner/file", "file"),
            ("deep", "not a file"),
            (".", "not a file"),
            ("", "not a file"),
            ("none", "not there"),
            ("deep/none", "not there"),
            ("file/below", "not there"),
        ] {
            assert_eq!(answer(&inner, file), name, "{file}");
            assert_eq!(answer(&root.join("door"), file), name, "{file} through a link to the folder");
        }
        assert_eq!(answer(&inner, "round"), "Other");
    }

    /// An author of a scenario must not learn which files exist on the machine that runs it.
    #[test]
    fn the_answer_for_a_way_out_does_not_tell_what_is_there() {
        let all = tempfile::tempdir().unwrap();
        let inner = all.path().join("inner");
        fs::create_dir(&inner).unwrap();
        fs::create_dir(all.path().join("next")).unwrap();
        fs::write(all.path().join("there"), "").unwrap();
        fs::write(all.path().join("next/there"), "").unwrap();
        symlink(all.path().join("there"), inner.join("link")).unwrap();
        symlink(all.path().join("missing"), inner.join("dangling")).unwrap();
        symlink("../..", inner.join("far")).unwrap();
        for file in [
            "../there",
            "../missing",
            "../there/none",
            "../next/there",
            "../missing/../inner/none",
            "/etc/passwd",
            "/etc/none",
            "/",
            "..",
            "link",
            "dangling",
            "link/none",
            "dangling/none",
            "far/none/there",
            "../../../../../../../../none",
        ] {
            assert_eq!(answer(&inner, file), "outside", "{file}");
        }
    }
}
