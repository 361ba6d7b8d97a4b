//! Exports of the engine.
//!
//! Texts pass through one buffer, numbers as pointers to `f64`. A function that returns a number of bytes has left a text in the buffer.
//! A pointer is valid until the next call.

#![allow(unreachable_pub, reason = "exports to WebAssembly")]

use crate::Page;
use std::cell::RefCell;

thread_local! {
    static BUFFER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static NUMBERS: RefCell<Vec<f64>> = const { RefCell::new(Vec::new()) };
    static PAGE: RefCell<Page> = RefCell::default();
}

/// Calls a function with the page and the text in the buffer.
fn with<T>(act: impl FnOnce(&mut Page, &str) -> T) -> T {
    BUFFER.with_borrow(|buffer| PAGE.with_borrow_mut(|page| act(page, &String::from_utf8_lossy(buffer))))
}

/// Leaves a text in the buffer and returns its number of bytes.
fn say(text: String) -> usize {
    BUFFER.set(text.into_bytes());
    buffer_len()
}

/// Leaves the message of an error in the buffer and returns 1; returns 0 without an error, with a text if there is one.
fn tell(result: Result<Option<String>, String>) -> u32 {
    let code = u32::from(result.is_err());
    if let Some(text) = result.unwrap_or_else(Some) {
        say(text);
    }
    code
}

/// Keeps numbers and returns a pointer to them.
fn give(numbers: Vec<f64>) -> *const f64 {
    NUMBERS.set(numbers);
    NUMBERS.with_borrow(|numbers| numbers.as_ptr())
}

/// Makes the buffer `length` bytes long and returns a pointer to it.
#[unsafe(no_mangle)]
pub extern "C" fn buffer(length: usize) -> *mut u8 {
    BUFFER.with_borrow_mut(|buffer| {
        buffer.clear();
        buffer.resize(length, 0);
        buffer.as_mut_ptr()
    })
}

/// Returns a pointer to the buffer.
#[unsafe(no_mangle)]
pub extern "C" fn buffer_ptr() -> *const u8 {
    BUFFER.with_borrow(|buffer| buffer.as_ptr())
}

/// Returns the length of the buffer in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn buffer_len() -> usize {
    BUFFER.with_borrow(Vec::len)
}

/// Reads the scenario in the buffer. Returns 0 with the names of the columns of `trace.csv`, one per line, or 1 with the error.
#[unsafe(no_mangle)]
pub extern "C" fn load() -> u32 {
    tell(with(|page, text| page.load(text).map(Some)))
}

/// Computes the whole run and returns its number of rows.
#[unsafe(no_mangle)]
pub extern "C" fn run() -> usize {
    begin(0);
    while go(u64::MAX) < 1.0 {}
    rows()
}

/// Begins a run with a number of snapshots of the slip memories. Returns 0, or 1 with the error.
#[unsafe(no_mangle)]
pub extern "C" fn begin(snapshots: usize) -> u32 {
    tell(with(|page, _| page.begin(snapshots).map(|()| None)))
}

/// Continues the run. Returns the part of its duration that is done, 1 at its end.
#[unsafe(no_mangle)]
pub extern "C" fn go(looks: u64) -> f64 {
    with(|page, _| page.go(looks))
}

/// Returns the number of rows of the last run.
#[unsafe(no_mangle)]
pub extern "C" fn rows() -> usize {
    with(|page, _| page.rows())
}

/// Returns a column of the last run, or null.
#[unsafe(no_mangle)]
pub extern "C" fn column(index: usize) -> *const f64 {
    with(|page, _| page.column(index).map_or(std::ptr::null(), <[f64]>::as_ptr))
}

/// Leaves `summary.json` of the last run in the buffer.
#[unsafe(no_mangle)]
pub extern "C" fn summary() -> usize {
    say(with(|page, _| page.summary()))
}

/// Leaves the events of the last run in the buffer, a line `time_s,source,kind` each.
#[unsafe(no_mangle)]
pub extern "C" fn events() -> usize {
    say(with(|page, _| page.events()))
}

/// Leaves the SHA-256 of `trace.csv` of the last run in the buffer.
#[unsafe(no_mangle)]
pub extern "C" fn hash() -> usize {
    say(with(|page, _| page.hash()))
}

/// Leaves what the page shows of the scenario in the buffer, as JSON: its resolved form, numbers, bodies, contacts and units.
#[unsafe(no_mangle)]
pub extern "C" fn about() -> usize {
    say(with(|page, _| page.about()))
}

/// Returns the inside of a contact: of snapshot `index`, of the motion by hand (-1), or of the contact by hand (-2).
#[unsafe(no_mangle)]
pub extern "C" fn inside(contact: usize, index: i32) -> *const f64 {
    // Without an inside, the counts are NaN.
    let inside = with(|page, _| page.inside(contact, index));
    give(if inside.is_empty() { vec![f64::NAN; 15] } else { inside })
}

/// Searches the periodic orbit. Returns 0 with the report as JSON, or 1 with the error.
#[unsafe(no_mangle)]
pub extern "C" fn steady() -> u32 {
    tell(with(|page, _| page.steady().map(Some)))
}

/// Takes a contact in the hand, untouched. Returns 0 with its constants and curves as JSON, or 1 with the error.
#[unsafe(no_mangle)]
pub extern "C" fn hold(contact: usize, indentation: f64) -> u32 {
    tell(with(|page, _| page.hold(contact, indentation).map(Some)))
}

/// Moves the contact in the hand on a straight path. Returns 0, or 1 with the error.
#[unsafe(no_mangle)]
pub extern "C" fn press(d: f64, u: f64) -> u32 {
    tell(with(|page, _| page.press(d, u).map(|()| None)))
}

/// Begins a motion by hand: a run whose inputs are set while it goes on. Returns 0 with the names of the inputs, one per line, or 1 with
/// the error.
#[unsafe(no_mangle)]
pub extern "C" fn live() -> u32 {
    tell(with(|page, _| page.live().map(Some)))
}

/// Advances the motion by hand with a value of an input. Returns the number of columns and their values, or null after an error.
#[unsafe(no_mangle)]
pub extern "C" fn step(until: f64, input: usize, value: f64) -> *const f64 {
    match with(|page, _| page.step(until, input, value)) {
        Ok(row) => give(std::iter::once(row.len() as f64).chain(row).collect()),
        Err(message) => {
            say(message);
            std::ptr::null()
        }
    }
}
