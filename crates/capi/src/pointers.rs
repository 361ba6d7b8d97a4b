//! Pointers of callers. Null, invalid UTF-8 and panics become error messages here.

use std::ffi::{CStr, CString, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Returns the text behind a pointer.
///
/// # Safety
/// The pointer is null or points to a text that ends with 0.
pub(crate) unsafe fn text<'a>(text: *const c_char) -> Result<&'a str, String> {
    if text.is_null() {
        return Err("expected a text, got a null pointer".to_owned());
    }
    // SAFETY: by the contract of this function.
    unsafe { CStr::from_ptr(text) }.to_str().map_err(|error| format!("the text is not UTF-8: {error}"))
}

/// Returns the values behind a pointer.
///
/// # Safety
/// The pointer is null, or points to `count` values that nothing changes for the lifetime of the slice.
pub(crate) unsafe fn values<'a, T>(first: *const T, count: usize) -> Result<&'a [T], String> {
    match (first.is_null(), count) {
        (_, 0) => Ok(&[]),
        (true, _) => Err(format!("expected {count} values, got a null pointer")),
        // SAFETY: by the contract of this function.
        (false, _) => Ok(unsafe { std::slice::from_raw_parts(first, count) }),
    }
}

/// Returns the room for values behind a pointer.
///
/// # Safety
/// The pointer is null, or points to `count` values that nothing else uses for the lifetime of the slice.
pub(crate) unsafe fn room<'a, T>(first: *mut T, count: usize) -> Result<&'a mut [T], String> {
    match (first.is_null(), count) {
        (_, 0) => Ok(&mut []),
        (true, _) => Err(format!("expected room for {count} values, got a null pointer")),
        // SAFETY: by the contract of this function.
        (false, _) => Ok(unsafe { std::slice::from_raw_parts_mut(first, count) }),
    }
}

/// Writes a value, unless the pointer is null.
///
/// # Safety
/// The pointer is null or points to a value that nothing else uses.
pub(crate) unsafe fn put<T>(place: *mut T, value: T) {
    if !place.is_null() {
        // SAFETY: by the contract of this function.
        unsafe { place.write(value) };
    }
}

/// Returns a text for C; a 0 inside becomes a blank.
pub(crate) fn for_c(text: &str) -> CString {
    CString::new(text.replace('\0', " ")).unwrap_or_default()
}

/// Calls a function and catches its panic, whose message becomes an error. The flag is set for a panic.
pub(crate) fn guarded<T>(act: impl FnOnce() -> Result<T, String>) -> Result<T, (String, bool)> {
    match catch_unwind(AssertUnwindSafe(act)) {
        Ok(outcome) => outcome.map_err(|message| (message, false)),
        Err(panic) => {
            let text = panic.downcast_ref::<String>().map(String::as_str);
            let text = text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no message");
            Err((format!("internal error: {text}"), true))
        }
    }
}
