//! Reading of tables that instruments have written: nine forms of the same loop, and other cases.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::{Path, PathBuf};
use stickslip_record::{Encoding, Named, Recipe, Record, RecordError, Role};

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

const LOOP: [Role; 2] = [Role::Displacement, Role::Force];

fn named(displacement: &str, force: &str) -> Recipe {
    let named = Named {
        displacement: Some(displacement.to_owned()),
        force: Some(force.to_owned()),
        ..Named::default()
    };
    Recipe::default().with(&named)
}

fn read(name: &str, recipe: &Recipe) -> Record {
    Record::read(&file(name), recipe, &LOOP).unwrap_or_else(|error| panic!("{error}"))
}

/// The nine forms of one loop give equal values within their digits. Three forms need units or columns from the user.
#[test]
fn nine_writings_of_one_loop_are_one() {
    let wanted = read("04_semicolon_decimal_comma.csv", &Recipe::default());
    assert_eq!(wanted.rows, 241);
    let plain = Recipe::default();
    for (name, recipe, sign, digit) in [
        ("01_no_head_mm_kN.csv", named("1:mm", "2:kN"), 1.0, 1e-9),
        ("02_units_in_second_line.csv", plain.clone(), 1.0, 1e-9),
        ("03_tabs_force_first_cm.txt", named("2:cm", "1:N"), -1.0, 1e-9),
        ("05_logger_preamble_bom_quotes.csv", plain.clone(), 1.0, 1e-9),
        ("06_axis_preamble_two_heads.csv", named("2:um", "3:N"), 1.0, 1e-10),
        ("08_units_cm_gf.csv", plain.clone(), 1.0, 1e-9),
        ("09_clock_times.csv", plain.clone(), 1.0, 1e-10),
    ] {
        let found = read(name, &recipe);
        assert_eq!(found.rows, 241, "{name}");
        for (role, within) in [(Role::Displacement, digit), (Role::Force, 1.1e-3), (Role::Time, 3e-5)] {
            let (Some(found), Some(wanted)) = (found.columns.get(&role), wanted.columns.get(&role)) else {
                continue;
            };
            let sign = if role == Role::Displacement { sign } else { 1.0 };
            let off = found
                .iter()
                .zip(wanted)
                .map(|(found, wanted)| (sign * found - wanted).abs())
                .fold(0.0, f64::max);
            assert!(off <= within, "{name}: {role:?} is {off:e} off");
        }
    }
    let gaps = read("07_gaps_nan_blank.csv", &plain);
    assert_eq!((gaps.rows, gaps.passed.missing), (239, 2));
    assert!(gaps.notes.iter().any(|note| note == "skipped: 2 rows with a missing value"), "{:?}", gaps.notes);
}

/// A written recipe gives the same record, and its settings can be changed.
#[test]
fn a_recipe_that_was_written_reads_the_same() {
    for name in [
        "05_logger_preamble_bom_quotes.csv",
        "09_clock_times.csv",
        "logger_latin1.csv",
        "28_tribometer_blocks.csv",
    ] {
        let found = read(name, &Recipe::default());
        let text = serde_json::to_string(&found.recipe()).unwrap();
        let again = read(name, &Recipe::from_text(&text, name).unwrap());
        assert_eq!((&again.columns, again.recipe()), (&found.columns, found.recipe()), "{name}");
    }
    let text = r#"{"columns": {"force": {"column": "Kraft", "unit": "N", "gain": -2, "offset": 0.5}}}"#;
    let own = read("04_semicolon_decimal_comma.csv", &Recipe::from_text(text, "own").unwrap());
    let plain = read("04_semicolon_decimal_comma.csv", &Recipe::default());
    for (own, plain) in own.columns[&Role::Force].iter().zip(&plain.columns[&Role::Force]) {
        assert_eq!(*own, -2.0 * plain + 0.5);
    }
}

#[test]
fn columns_are_found_by_their_names_in_other_languages_and_by_their_units() {
    let latin = read("logger_latin1.csv", &Recipe::default());
    assert_eq!((latin.layout.encoding, latin.layout.skip, latin.columns.len()), (Encoding::Latin1, 4, 4));
    assert!(
        (latin.columns[&Role::Displacement][0] - 3.21e-6).abs() < 1e-18
            && latin.columns[&Role::Normal][0] == 9.997
    );
    let normal = read("10_normal_force_column.csv", &Recipe::default());
    assert_eq!((normal.columns[&Role::Force][1], normal.columns[&Role::Normal][1]), (1.5786, 10.06));
    let blocks = read("28_tribometer_blocks.csv", &Recipe::default());
    assert_eq!((blocks.rows, blocks.blocks.clone()), (164, vec![0, 41, 82, 123]));
    // Grams of a force are weights under standard gravity.
    assert_eq!(blocks.columns[&Role::Force][2], 100.0 * (1e-3 * 9.80665));
}

/// Oscilloscopes write start and increment next to the first row. The unit of a voltage must be given by the user.
#[test]
fn scopes_have_their_times_and_volts_need_a_unit() {
    for name in ["29_scope_start_increment.csv", "30_scope_ragged_head.csv"] {
        let found = read(name, &named("2:um", "3:N"));
        let times = &found.columns[&Role::Time];
        assert_eq!((found.rows, times[0], times[2]), (400, -1e-3, -1e-3 + 2.0 * 5e-6), "{name}");
        assert_eq!(found.columns[&Role::Force][1], 0.2, "{name}");
        let refused = Record::read(&file(name), &Recipe::default(), &LOOP).unwrap_err();
        assert!(
            matches!(refused, RecordError::Unknown { .. })
                && refused.to_string().contains("2 \"CH1 [Volt]\""),
            "{refused}"
        );
    }
    for (name, rows) in
        [("17_scope_two_heads.csv", 201), ("18_scope_preamble.csv", 201), ("19_awg_one_column.csv", 201)]
    {
        assert_eq!(Record::read(&file(name), &Recipe::default(), &[]).unwrap().rows, rows, "{name}");
    }
}

#[test]
fn lines_of_profilometers_are_read() {
    let plain = Recipe::default();
    for (name, columns) in [
        ("24_profile_preamble.csv", "1 \"Lateral [um]\", 2 \"Raw [Micrometer]\""),
        ("26_profile_utf16.csv", "1 \"x [\u{b5}m]\", 2 \"y [\u{b5}m]\""),
    ] {
        let found = Record::read(&file(name), &plain, &[]).unwrap();
        assert_eq!((found.layout.words().as_str(), found.rows > 200), (columns, true), "{name}");
    }
    assert_eq!(Record::read(&file("25_profile_two_columns.asc"), &plain, &[]).unwrap().rows, 300);
}

/// `STICKSLIP_WRITE=1` updates the copy.
#[test]
fn the_schema_lies_in_the_tree() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../schema/recipe-1.json");
    if std::env::var_os("STICKSLIP_WRITE").is_some() {
        std::fs::write(&path, stickslip_record::recipe_schema()).unwrap();
    }
    assert_eq!(std::fs::read_to_string(&path).unwrap(), stickslip_record::recipe_schema());
}

/// Any bytes give a record or an error, never a panic.
#[test]
fn any_bytes_get_an_answer() {
    let root = tempfile::tempdir().unwrap();
    let path = root.path().join("a.csv");
    let own = std::fs::read(file("05_logger_preamble_bom_quotes.csv")).unwrap();
    let mut seed = 1_u64;
    let mut next = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        seed >> 33
    };
    for _ in 0..400 {
        let mut bytes = own[..next() as usize % own.len()].to_vec();
        for _ in 0..next() % 20 {
            if let Some(byte) = bytes.get_mut(next() as usize % own.len()) {
                *byte = next() as u8;
            }
        }
        std::fs::write(&path, &bytes).unwrap();
        let recipe = Recipe {
            encoding: [None, Some(Encoding::Utf16), Some(Encoding::Latin1)][next() as usize % 3],
            ..Recipe::default()
        };
        let _ = Record::read(&path, &recipe, &LOOP).map(|record| record.rows);
    }
    assert!(matches!(Record::read(root.path(), &Recipe::default(), &LOOP), Err(RecordError::File { .. })));
}

/// Fortran exponents, words for missing values, a trailing comma, a footer, times after midnight.
#[test]
fn what_stands_in_the_way_is_passed_over_and_counted() {
    let root = tempfile::tempdir().unwrap();
    let path = root.path().join("a.csv");
    let text = "clock,disp [um],force [mN],\n23:59:59.8,1.2D-03,5,\n23:59:59.9,OVER,6,\n00:00:00.0,1.4D-03,---,\n00:00:00.1,1.5D-03,8,\n\n# pause\n00:00:00.2,1.6D-03,9,\nEnd of data\nTotal: 5\n";
    std::fs::write(&path, text).unwrap();
    let recipe = Recipe { comment: Some("#".to_owned()), ..Recipe::default() };
    let found = Record::read(&path, &recipe, &LOOP).unwrap();
    assert_eq!(found.columns[&Role::Force], [5e-3, 8e-3, 9e-3]);
    assert_eq!(found.columns[&Role::Displacement], [1.2e-9, 1.5e-9, 1.6e-9]);
    let times = &found.columns[&Role::Time];
    assert!((times[1] - 0.3).abs() < 1e-9 && (times[2] - 0.4).abs() < 1e-9, "{times:?}");
    let passed = found.passed;
    assert_eq!((passed.missing, passed.words, passed.empty, passed.comments), (2, 2, 1, 1));
}

/// The first non-empty sheet is read, with the stored values of its numbers.
#[test]
fn spreadsheets_are_read() {
    let found = read("sheet.xlsx", &Recipe::default());
    assert_eq!(found.rows, 41);
    assert_eq!((found.columns[&Role::Time][3], found.columns[&Role::Displacement][5]), (1.5e-3, 1e-5));
    assert_eq!(found.columns[&Role::Force][10], -3.0);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("broken.xlsx");
    std::fs::write(&path, "no sheet").unwrap();
    let error = Record::read(&path, &Recipe::default(), &LOOP).unwrap_err().to_string();
    assert!(error.contains("broken.xlsx: not a readable spreadsheet"), "{error}");
}
