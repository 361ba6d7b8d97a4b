//! The pages "Start" and "How do I": every command in them is run, and every line of output that they show is in what the program prints.

use crate::program::{code, listing, stderr, stickslip};
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

/// Runs a page in an empty folder, as a reader who has nothing but the program, and counts commands and lines that were found.
fn follow(page: &Path) -> (usize, usize) {
    let (name, page) = (page.display(), fs::read_to_string(page).unwrap());
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
        } else if language == "text" && commands > 0 {
            for line in block.lines() {
                assert!(said.contains(line.trim()), "{name} shows\n{line}\nand the program prints\n{said}");
                lines += 1;
            }
        } else if language == "json" && block.contains("\"stickslip\": 1") {
            let file = folder.path().join("shown.json");
            fs::write(&file, block).unwrap();
            let output = stickslip().arg("check").arg(&file).output().unwrap();
            assert_eq!(code(&output), 0, "{name}: {block}\n{}", stderr(&output));
        }
    }
    // Files of results that a page names exist.
    for place in page.split('`').skip(1).step_by(2).filter(|word| word.starts_with("results/")) {
        let is_there = folder.path().join(place).exists() || place.contains(|c: char| c.is_uppercase());
        assert!(is_there, "{name}: there is no {place}");
    }
    (commands, lines)
}

/// Runs all pages of a folder that have commands.
fn follow_all(folder: &str, least: (usize, usize)) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs").join(folder);
    let (mut commands, mut lines) = (0, 0);
    for name in listing(&folder) {
        let (run, found) = follow(&folder.join(name));
        (commands, lines) = (commands + run, lines + found);
    }
    assert!(commands >= least.0 && lines >= least.1, "{commands} {lines}");
}

#[test]
fn the_pages_to_start_with_show_what_the_program_prints() {
    follow_all("start", (20, 40));
}

#[test]
fn the_pages_of_tasks_show_what_the_program_prints() {
    follow_all("how", (40, 60));
}
