//! Text of operating system errors.

use std::io;

/// Returns the text of an error without the additions of libraries, such as error numbers and names of temporary files.
pub fn words(error: &io::Error) -> String {
    let said = error.to_string();
    let end = [" (os error ", " at path \""].iter().filter_map(|added| said.find(added)).min();
    said[..end.unwrap_or(said.len())].to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn numbers_of_errors_and_names_of_temporary_files_are_left_out() {
        let missing = std::fs::read("no/such/file").unwrap_err();
        let hidden = crate::folder::draft(Path::new("no/such/folder"), "loop.png").unwrap_err();
        for error in [missing, hidden] {
            let said = words(&error);
            assert!(
                error.to_string().starts_with(&said) && error.to_string().contains("(os error"),
                "{error}"
            );
            assert!(!said.is_empty() && !said.contains("os error") && !said.contains("loop.png"), "{said}");
        }
        assert_eq!(words(&io::Error::other("the disk is on fire")), "the disk is on fire");
    }
}
