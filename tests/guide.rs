//! The guide: every command of its tutorials is run, and every line that a page shows is in what the program says.

use crate::program::stickslip;
use std::fs;
use std::path::Path;
use tempfile::tempdir;

/// The arguments of a command as a shell parts them: quotes hold blanks together.
fn arguments(line: &str) -> Vec<String> {
    let (mut words, mut word, mut quote) = (Vec::new(), String::new(), None);
    for c in line.chars() {
        match (c, quote) {
            ('"' | '\'', None) => quote = Some(c),
            (c, Some(open)) if c == open => quote = None,
            (' ', None) => words.push(std::mem::take(&mut word)),
            (c, _) => word.push(c),
        }
    }
    words.push(word);
    words.retain(|word| !word.is_empty());
    words
}

/// Blocks of a page by their language.
fn blocks(page: &str) -> Vec<(&str, &str)> {
    let parts = page.split("\n```").skip(1).step_by(2);
    parts.filter_map(|block| block.split_once('\n')).collect()
}

/// Runs a page in an empty folder, as whoever has nothing but the program, and counts commands and lines that were found.
fn follow(name: &str) -> (usize, usize) {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let page = fs::read_to_string(root.join("docs/guide").join(name)).unwrap();
    let folder = tempdir().unwrap();
    let (mut commands, mut lines, mut said) = (0, 0, String::new());
    for (language, block) in blocks(&page) {
        if language == "sh" {
            let words = arguments(block.trim());
            assert_eq!(words[0], "stickslip", "{name}: {block}");
            let output = stickslip().args(&words[1..]).current_dir(folder.path()).output().unwrap();
            said = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
            assert!(!said.is_empty() && !said.contains("error: unrecognized"), "{name}: {block}\n{said}");
            commands += 1;
        } else {
            for line in block.lines() {
                assert!(said.contains(line), "{name} shows\n{line}\nand the program says\n{said}");
                lines += 1;
            }
        }
    }
    // Folders that a page speaks of are there.
    for place in
        page.split('`').skip(1).step_by(2).filter(|word| word.ends_with(".png") || word.ends_with(".csv"))
    {
        let known = folder.path().join(place).exists() || !place.contains('/');
        assert!(known, "{name}: there is no {place}");
    }
    (commands, lines)
}

#[test]
fn a_drive_designer_finds_what_the_page_shows() {
    let (commands, lines) = follow("drive_designer.md");
    assert!(commands >= 8 && lines >= 12, "{commands} {lines}");
}

#[test]
fn a_tribologist_finds_what_the_page_shows() {
    let (commands, lines) = follow("tribologist.md");
    assert!(commands >= 5 && lines >= 13, "{commands} {lines}");
}

#[test]
fn a_student_finds_what_the_page_shows() {
    let (commands, lines) = follow("student.md");
    assert!(commands >= 4 && lines >= 10, "{commands} {lines}");
}
