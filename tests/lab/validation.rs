//! Known results and the pages that show them.

use crate::program::{code, lab, listing, stderr, stdout};
use std::path::{Path, PathBuf};
use std::process::Output;
use tempfile::tempdir;

/// `stickslip-lab validate` into a folder.
fn validate(pages: &[&str], out: &Path) -> Output {
    lab().arg("validate").args(pages).arg("--out").arg(out).output().unwrap()
}

/// The pages of the project.
fn project() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/validation")
}

/// What the program computes today is what the project's pages say, every tolerance is kept, and the same comes out twice.
#[test]
fn the_pages_of_the_project_say_what_the_program_computes() {
    let root = tempdir().unwrap();
    let outs = [root.path().join("a"), root.path().join("b/c")];
    for out in &outs {
        let output = validate(&[], out);
        assert_eq!((code(&output), stderr(&output)), (0, String::new()));
        let said = format!("{}: 10 pages, 25 of 25 tolerances met\n", out.display());
        assert_eq!(stdout(&output), said);
    }
    let names = listing(&outs[0]);
    assert_eq!((names.len(), &names), (21, &listing(&project())));
    for name in &names {
        let [a, b] = [&outs[0], &outs[1]].map(|out| std::fs::read(out.join(name)).unwrap());
        assert!(a == b, "{name} differs from one time to the next");
        if name.ends_with(".md") {
            let there = std::fs::read_to_string(project().join(name)).unwrap();
            assert_eq!(String::from_utf8(a).unwrap(), there, "run stickslip-lab validate: {name}");
        }
    }
}

/// Links of the pages lead somewhere.
#[test]
fn links_of_the_pages_lead_somewhere() {
    for name in listing(&project()).iter().filter(|name| name.ends_with(".md")) {
        let page = std::fs::read_to_string(project().join(name)).unwrap();
        assert!(page.contains("](") && !page.contains("not kept**"), "{name}");
        let links = page.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        let pictures = page.split("src=\"").skip(1).filter_map(|rest| rest.split('"').next());
        for link in links.chain(pictures) {
            let file = link.split('#').next().unwrap();
            assert!(project().join(file).is_file(), "{name}: {link}");
        }
    }
}

#[test]
fn one_page_is_written_alone() {
    let root = tempdir().unwrap();
    let output = validate(&["contact"], root.path());
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
    assert_eq!(listing(root.path()), ["contact.md", "contact.png"]);
}

#[test]
fn a_page_that_is_not_there_and_a_folder_that_cannot_be_written_are_named() {
    let root = tempdir().unwrap();
    let out = root.path().join("pages");
    let output = validate(&["contakt"], &out);
    assert_eq!((code(&output), stdout(&output)), (2, String::new()));
    for text in ["contakt", "measured_impact, contact, oblique_loading", "similar value exists: 'contact'"] {
        assert!(stderr(&output).contains(text), "{text}: {}", stderr(&output));
    }
    assert!(!out.exists());
    let file = root.path().join("file");
    std::fs::write(&file, "not a folder").unwrap();
    let output = validate(&["contact"], &file.join("pages"));
    assert_eq!((code(&output), stdout(&output)), (3, String::new()));
    for text in ["file/pages: cannot be written: ", "help: choose another folder with --out"] {
        assert!(stderr(&output).contains(text), "{text}: {}", stderr(&output));
    }
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "not a folder");
}

/// The command of a page gives the number of the page.
#[test]
fn the_command_of_a_page_gives_its_number() {
    let page = std::fs::read_to_string(project().join("measured_impact.md")).unwrap();
    let command = page.split("```").nth(1).unwrap();
    let root = tempdir().unwrap();
    let values = command.split("--set '").skip(1).map(|rest| rest.split('\'').next().unwrap());
    let values: Vec<&str> = values.collect();
    let folder = crate::program::run_example("measured_impact", root.path(), &values);
    let trace = crate::program::Table::read(&folder.join("trace.csv"));
    let along = trace.column("ball.vx_m_s");
    let [before, after] = [along[0], along[along.len() - 1]].map(|text| text.parse::<f64>().unwrap());
    let restitution = format!("| 30.22 | 0.6883 | {:.4} |", after / before);
    assert!(page.contains(&restitution), "{restitution}");
}
