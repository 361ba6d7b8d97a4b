//! The functions of `stickslip.h`, whose comments describe them.

use crate::instance::Instance;
use crate::pointers::{for_c, guarded, put, room, values};
use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char, c_int};
use stickslip_run::interface::Role;

/// A simulation. It belongs to one thread at a time.
pub struct Stickslip {
    instance: Instance,
    /// Name, unit and description of each variable, for C.
    texts: Vec<[CString; 3]>,
}

/// What a variable is.
#[repr(C)]
pub struct StickslipVariable {
    /// Name, such as `slider.x`.
    pub name: *const c_char,
    /// SI unit; empty for plain numbers.
    pub unit: *const c_char,
    /// Description.
    pub description: *const c_char,
    /// Role: 0 output, 1 input, 2 parameter.
    pub role: c_int,
    /// Number for [`stickslip_get`] and [`stickslip_set`].
    pub reference: u32,
}

const OK: c_int = 0;
const ERROR: c_int = 1;
const PANIC: c_int = 2;

thread_local! {
    static LAST: RefCell<CString> = RefCell::default();
}

/// Calls a function; an error is kept for [`stickslip_error`].
fn said(act: impl FnOnce() -> Result<(), String>) -> c_int {
    let (code, message) = match guarded(act) {
        Ok(()) => return OK,
        Err((message, false)) => (ERROR, message),
        Err((message, true)) => (PANIC, message),
    };
    LAST.with(|last| *last.borrow_mut() = for_c(&message));
    code
}

/// Calls a function with the simulation behind a pointer.
///
/// # Safety
/// The pointer is null or from [`stickslip_create`], and no other thread uses it.
unsafe fn with(it: *mut Stickslip, act: impl FnOnce(&mut Stickslip) -> Result<(), String>) -> c_int {
    // SAFETY: by the contract of this function.
    let it = unsafe { it.as_mut() };
    said(|| act(it.ok_or("expected a simulation, got a null pointer")?))
}

/// Returns the version of the library.
#[unsafe(no_mangle)]
pub extern "C" fn stickslip_version() -> *const c_char {
    const VERSION: &CStr =
        match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
            Ok(version) => version,
            Err(_) => c"",
        };
    VERSION.as_ptr()
}

/// Returns the message of the last error in this thread.
#[unsafe(no_mangle)]
pub extern "C" fn stickslip_error() -> *const c_char {
    LAST.with(|last| last.borrow().as_ptr())
}

/// Creates a simulation from the text of a scenario.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stickslip_create(
    json: *const c_char,
    length: usize,
    simulation: *mut *mut Stickslip,
) -> c_int {
    said(|| {
        if simulation.is_null() {
            return Err("expected a place for the simulation, got a null pointer".to_owned());
        }
        // SAFETY: the caller gives `length` bytes.
        let text = unsafe { values(json.cast::<u8>(), length) }?;
        let text =
            std::str::from_utf8(text).map_err(|error| format!("the scenario is not UTF-8: {error}"))?;
        let instance = Instance::new(text)?;
        let texts = instance.variables.iter();
        let texts = texts.map(|it| [&it.name, it.unit, &it.text].map(for_c)).collect();
        let made = Box::into_raw(Box::new(Stickslip { instance, texts }));
        // SAFETY: the place is not null.
        unsafe { put(simulation, made) };
        Ok(())
    })
}

/// Frees a simulation; null is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stickslip_free(simulation: *mut Stickslip) {
    if !simulation.is_null() {
        let _ = said(|| {
            // SAFETY: it is from `stickslip_create`, and the caller uses it no more.
            drop(unsafe { Box::from_raw(simulation) });
            Ok(())
        });
    }
}

/// Returns the number of variables.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stickslip_variables(simulation: *const Stickslip) -> usize {
    // SAFETY: it is null or from `stickslip_create`.
    unsafe { simulation.as_ref() }.map_or(0, |it| it.texts.len())
}

/// Describes a variable; its texts live as long as the simulation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stickslip_variable(
    simulation: *mut Stickslip,
    index: usize,
    variable: *mut StickslipVariable,
) -> c_int {
    let describe = |it: &mut Stickslip| {
        let (Some(known), Some([name, unit, description])) =
            (it.instance.variables.get(index), it.texts.get(index))
        else {
            return Err(format!("there is no variable {index} of {}", it.texts.len()));
        };
        let role = match known.role {
            Role::Output(..) => 0,
            Role::Input(..) => 1,
            Role::Parameter(..) => 2,
        };
        let [name, unit, description] = [name, unit, description].map(|text| text.as_ptr());
        // SAFETY: the caller gives room for a variable.
        unsafe {
            put(variable, StickslipVariable { name, unit, description, role, reference: known.reference });
        };
        Ok(())
    };
    // SAFETY: by the contract of the header.
    unsafe { with(simulation, describe) }
}

/// Finds the reference of a variable by its name.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stickslip_find(
    simulation: *mut Stickslip,
    name: *const c_char,
    reference: *mut u32,
) -> c_int {
    let find = |it: &mut Stickslip| {
        // SAFETY: the caller gives a text.
        let name = unsafe { crate::pointers::text(name) }?;
        let found = it.instance.variables.iter().find(|variable| variable.name == name);
        let found = found.ok_or_else(|| format!("there is no variable {name:?}"))?;
        // SAFETY: the caller gives room for a number.
        unsafe { put(reference, found.reference) };
        Ok(())
    };
    // SAFETY: by the contract of the header.
    unsafe { with(simulation, find) }
}

/// Reads a variable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stickslip_get(simulation: *mut Stickslip, reference: u32, value: *mut f64) -> c_int {
    // SAFETY: the caller gives room for a number.
    let get = |it: &mut Stickslip| it.instance.get(reference).map(|found| unsafe { put(value, found) });
    // SAFETY: by the contract of the header.
    unsafe { with(simulation, get) }
}

/// Sets an input, or before the start a parameter.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stickslip_set(simulation: *mut Stickslip, reference: u32, value: f64) -> c_int {
    // SAFETY: by the contract of the header.
    unsafe { with(simulation, |it| it.instance.set(reference, value)) }
}

/// Starts the simulation with the parameters and inputs set so far.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stickslip_start(simulation: *mut Stickslip) -> c_int {
    // SAFETY: by the contract of the header.
    unsafe { with(simulation, |it| it.instance.start()) }
}

/// Ends the run; parameters and inputs have their initial values again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stickslip_reset(simulation: *mut Stickslip) -> c_int {
    // SAFETY: by the contract of the header.
    unsafe { with(simulation, |it| it.instance.reset()) }
}

/// Advances to an absolute time, s.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stickslip_advance(simulation: *mut Stickslip, until: f64) -> c_int {
    let advance = |it: &mut Stickslip| {
        it.instance.start()?;
        it.instance.advance(until, false).map(drop)
    };
    // SAFETY: by the contract of the header.
    unsafe { with(simulation, advance) }
}

/// Returns the simulated time, s; NaN for a null pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stickslip_time(simulation: *const Stickslip) -> f64 {
    // SAFETY: it is null or from `stickslip_create`.
    unsafe { simulation.as_ref() }.map_or(f64::NAN, |it| it.instance.time())
}

/// Returns the number of columns of a row.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stickslip_columns(simulation: *const Stickslip) -> usize {
    // SAFETY: it is null or from `stickslip_create`.
    unsafe { simulation.as_ref() }.map_or(0, |it| it.instance.channels())
}

/// Reads all columns of `trace.csv` in their order.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stickslip_row(simulation: *mut Stickslip, values: *mut f64, count: usize) -> c_int {
    let read = |it: &mut Stickslip| {
        // SAFETY: the caller gives room for `count` numbers.
        let room = unsafe { room(values, count) }?;
        let row = it.instance.row()?;
        if room.len() != row.len() {
            return Err(format!("expected room for {} values, got {count}", row.len()));
        }
        room.copy_from_slice(row);
        Ok(())
    };
    // SAFETY: by the contract of the header.
    unsafe { with(simulation, read) }
}

/// Returns the number of bytes of the present state.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stickslip_state_size(simulation: *const Stickslip) -> usize {
    // SAFETY: it is null or from `stickslip_create`.
    let it = unsafe { simulation.as_ref() };
    guarded(|| Ok(it.map_or(0, |it| it.instance.save().len()))).unwrap_or(0)
}

/// Writes the present state, whose size is that of [`stickslip_state_size`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stickslip_save(simulation: *mut Stickslip, bytes: *mut u8, size: usize) -> c_int {
    let save = |it: &mut Stickslip| {
        let state = it.instance.save();
        // SAFETY: the caller gives room for `size` bytes.
        let room = unsafe { room(bytes, size) }?;
        if room.len() != state.len() {
            return Err(format!("expected room for {} bytes, got {size}", state.len()));
        }
        room.copy_from_slice(&state);
        Ok(())
    };
    // SAFETY: by the contract of the header.
    unsafe { with(simulation, save) }
}

/// Continues from a saved state, also one of another process.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stickslip_restore(
    simulation: *mut Stickslip,
    bytes: *const u8,
    size: usize,
) -> c_int {
    let restore = |it: &mut Stickslip| {
        // SAFETY: the caller gives `size` bytes.
        it.instance.restore(unsafe { values(bytes, size) }?)
    };
    // SAFETY: by the contract of the header.
    unsafe { with(simulation, restore) }
}
