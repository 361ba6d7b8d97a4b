//! Functions of FMI 2.0 for co-simulation; the standard describes them.
#![allow(non_snake_case, reason = "names of the standard")]

use crate::fmu::{self, ERROR, Fmu, Log, Logger, absent, begins_at_zero, calls, states};
use crate::pointers::{for_c, text};
use std::ffi::{c_char, c_int, c_void};
use std::path::PathBuf;

/// Kind of FMU that is supported.
const CO_SIMULATION: c_int = 1;

/// Functions of the host.
#[repr(C)]
struct Callbacks {
    logger:
        Option<unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char, ...)>,
    allocate: *const c_void,
    free: *const c_void,
    finished: *const c_void,
    environment: *mut c_void,
}

/// Returns the path of a `file:` address.
fn path(address: &str) -> PathBuf {
    let plain = address.strip_prefix("file:").unwrap_or(address);
    let plain =
        plain.strip_prefix("//localhost/").map_or(plain, |rest| &plain[plain.len() - rest.len() - 1..]);
    let bytes = plain.strip_prefix("//").unwrap_or(plain).as_bytes();
    let (mut decoded, mut i) = (Vec::with_capacity(bytes.len()), 0);
    while i < bytes.len() {
        let digits = bytes.get(i + 1..i + 3).and_then(|digits| std::str::from_utf8(digits).ok());
        match digits.and_then(|digits| u8::from_str_radix(digits, 16).ok()).filter(|_| bytes[i] == b'%') {
            Some(byte) => {
                decoded.push(byte);
                i += 3;
            }
            None => {
                decoded.push(bytes[i]);
                i += 1;
            }
        }
    }
    String::from_utf8_lossy(&decoded).into_owned().into()
}

#[unsafe(no_mangle)]
extern "C" fn fmi2GetTypesPlatform() -> *const c_char {
    c"default".as_ptr()
}

#[unsafe(no_mangle)]
extern "C" fn fmi2GetVersion() -> *const c_char {
    c"2.0".as_ptr()
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2Instantiate(
    name: *const c_char,
    kind: c_int,
    guid: *const c_char,
    resources: *const c_char,
    functions: *const Callbacks,
    _visible: c_int,
    _logging: c_int,
) -> *mut c_void {
    // SAFETY: the host gives texts and functions, or null.
    let (name, guid, resources, functions) =
        unsafe { (text(name), text(guid), text(resources), functions.as_ref()) };
    let log = Log {
        logger: functions.and_then(|it| it.logger).map_or(Logger::Silent, Logger::Two),
        environment: functions.map_or(std::ptr::null_mut(), |it| it.environment),
        name: for_c(name.unwrap_or_default()),
    };
    if kind != CO_SIMULATION {
        return fmu::refused(&log, "only co-simulation is supported");
    }
    match (guid, resources) {
        (Ok(guid), Ok(resources)) => Fmu::create(guid, &path(resources), false, log),
        (Err(error), _) | (_, Err(error)) => fmu::refused(&log, &error),
    }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2FreeInstance(it: *mut c_void) {
    // SAFETY: the host gives an instance of fmi2Instantiate, or null.
    unsafe { fmu::free(it) }
}

calls! {
    fmi2SetDebugLogging(_on: c_int, _count: usize, _categories: *const *const c_char) |_it| Ok(());
    fmi2SetupExperiment(_given: c_int, _tolerance: f64, start: f64, _ends: c_int, _stop: f64) |_it| begins_at_zero(start);
    fmi2EnterInitializationMode() |it| it.enter_initialisation(0.0);
    fmi2ExitInitializationMode() |it| it.exit_initialisation();
    fmi2Terminate() |it| it.terminate();
    fmi2Reset() |it| it.reset();
    fmi2DoStep(t: f64, step: f64, _keeps: c_int) |it| it.step(t, step).map(drop);
    fmi2CancelStep() |_it| Err("steps are complete when they return; there is none to cancel".to_owned());
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2GetReal(
    it: *mut c_void,
    references: *const u32,
    count: usize,
    values: *mut f64,
) -> c_int {
    // SAFETY: the host gives an instance and `count` references and places.
    unsafe { fmu::get(it, (references, count), (values, count), (false, |value| value)) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2SetReal(
    it: *mut c_void,
    references: *const u32,
    count: usize,
    values: *const f64,
) -> c_int {
    // SAFETY: the host gives an instance and `count` references and values.
    unsafe { fmu::set(it, (references, count), (values, count), (false, |value| value)) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2GetInteger(
    it: *mut c_void,
    references: *const u32,
    count: usize,
    values: *mut c_int,
) -> c_int {
    // SAFETY: the host gives an instance and `count` references and places.
    unsafe { fmu::get(it, (references, count), (values, count), (true, |value| value as c_int)) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2SetInteger(
    it: *mut c_void,
    references: *const u32,
    count: usize,
    values: *const c_int,
) -> c_int {
    // SAFETY: the host gives an instance and `count` references and values.
    unsafe { fmu::set(it, (references, count), (values, count), (true, f64::from)) }
}

states! {
    fmi2GetFMUstate fmi2SetFMUstate fmi2FreeFMUstate fmi2SerializedFMUstateSize fmi2SerializeFMUstate fmi2DeSerializeFMUstate
}

absent! {
    fmi2GetBoolean fmi2GetString fmi2SetBoolean fmi2SetString fmi2GetDirectionalDerivative fmi2SetRealInputDerivatives
    fmi2GetRealOutputDerivatives
}

/// Status of steps in progress, which do not exist here.
macro_rules! status {
    ($($name:ident)*) => {$(
        #[unsafe(no_mangle)]
        extern "C" fn $name(_it: *mut c_void, _kind: c_int, _value: *mut c_void) -> c_int {
            ERROR
        }
    )*};
}

status! { fmi2GetStatus fmi2GetRealStatus fmi2GetIntegerStatus fmi2GetBooleanStatus fmi2GetStringStatus }

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_paths() {
        for (address, wanted) in [
            ("file:///tmp/a%20b/resources", "/tmp/a b/resources"),
            ("file:/tmp/x", "/tmp/x"),
            ("file://localhost/tmp/x", "/tmp/x"),
            ("/tmp/100%", "/tmp/100%"),
        ] {
            assert_eq!(path(address), PathBuf::from(wanted));
        }
    }
}
