//! What both versions of FMI share: an instance with its phase and its logger.

use crate::instance::Instance;
use crate::pointers::{for_c, guarded, put, room, values};
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::path::Path;
use stickslip_run::interface::{Variable, token};

/// Status of a call.
pub(crate) const OK: c_int = 0;
pub(crate) const ERROR: c_int = 3;
const FATAL: c_int = 4;

const CATEGORY: &CStr = c"error";

/// Function of the host that receives messages.
#[derive(Clone, Copy)]
pub(crate) enum Logger {
    /// None.
    Silent,
    /// That of FMI 2: environment, name of the instance, status, category, format.
    Two(unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char, ...)),
    /// That of FMI 3: environment, status, category, message.
    Three(unsafe extern "C" fn(*mut c_void, c_int, *const c_char, *const c_char)),
}

/// Logger with its environment and the name of the instance.
pub(crate) struct Log {
    pub(crate) logger: Logger,
    pub(crate) environment: *mut c_void,
    pub(crate) name: CString,
}

impl Log {
    fn say(&self, status: c_int, message: &str) {
        let (environment, category) = (self.environment, CATEGORY.as_ptr());
        match self.logger {
            Logger::Silent => {}
            Logger::Two(log) => {
                let text = for_c(message);
                // SAFETY: the host gives a function of this type; the format has one text.
                unsafe {
                    log(environment, self.name.as_ptr(), status, category, c"%s".as_ptr(), text.as_ptr());
                }
            }
            Logger::Three(log) => {
                let text = for_c(message);
                // SAFETY: the host gives a function of this type.
                unsafe { log(environment, status, category, text.as_ptr()) };
            }
        }
    }
}

/// Phase of an instance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Phase {
    Created,
    Initialising,
    Running,
    Terminated,
}

/// An instance of the FMU.
pub(crate) struct Fmu {
    pub(crate) instance: Instance,
    pub(crate) phase: Phase,
    /// Whether steps may end early at events.
    pub(crate) stops: bool,
    log: Log,
}

/// Saved state of an instance.
struct Saved(Vec<u8>);

impl Fmu {
    /// Creates an instance from the folder of resources; null after an error, which the host is told.
    pub(crate) fn create(asked: &str, resources: &Path, stops: bool, log: Log) -> *mut c_void {
        let made = guarded(|| {
            let file = resources.join("scenario.json");
            let text =
                std::fs::read_to_string(&file).map_err(|error| format!("{}: {error}", file.display()))?;
            let own = token(&text);
            if asked != own {
                return Err(format!(
                    "expected the token {own}, got {asked:?}: the description is another FMU's"
                ));
            }
            Instance::new(&text)
        });
        match made {
            Ok(instance) => {
                Box::into_raw(Box::new(Self { instance, phase: Phase::Created, stops, log })).cast()
            }
            Err((message, _)) => refused(&log, &message),
        }
    }

    fn expect(&self, phases: &[Phase], what: &str) -> Result<(), String> {
        if phases.contains(&self.phase) {
            Ok(())
        } else {
            Err(format!("{what} is not possible in the phase {:?}", self.phase))
        }
    }

    pub(crate) fn enter_initialisation(&mut self, start: f64) -> Result<(), String> {
        self.expect(&[Phase::Created], "initialisation")?;
        begins_at_zero(start)?;
        self.phase = Phase::Initialising;
        Ok(())
    }

    pub(crate) fn exit_initialisation(&mut self) -> Result<(), String> {
        self.expect(&[Phase::Initialising], "the end of initialisation")?;
        self.instance.start()?;
        self.phase = Phase::Running;
        Ok(())
    }

    pub(crate) fn terminate(&mut self) -> Result<(), String> {
        self.expect(&[Phase::Running], "termination")?;
        self.phase = Phase::Terminated;
        Ok(())
    }

    pub(crate) fn reset(&mut self) -> Result<(), String> {
        self.phase = Phase::Created;
        self.instance.reset()
    }

    /// Advances by a step; returns the time reached and whether the step ended early.
    pub(crate) fn step(&mut self, t: f64, step: f64) -> Result<(f64, bool), String> {
        self.expect(&[Phase::Running], "a step")?;
        let step = self.instance.step(t, step, self.stops)?;
        Ok((step.time, step.is_early))
    }
}

/// Tells the host why there is no instance; returns null.
pub(crate) fn refused(log: &Log, message: &str) -> *mut c_void {
    log.say(ERROR, message);
    std::ptr::null_mut()
}

/// Outcome of a function for something that does not exist here.
pub(crate) fn none(name: &str, count: usize) -> Result<(), String> {
    if count == 0 { Ok(()) } else { Err(format!("{name}: there is no such variable, mode or derivative")) }
}

/// Checks the start time of an experiment.
pub(crate) fn begins_at_zero(start: f64) -> Result<(), String> {
    if start == 0.0 {
        Ok(())
    } else {
        Err(format!("expected the start at 0 s, where the scenario begins, got {start} s"))
    }
}

/// Calls a function with the instance behind a pointer and returns a status; the host is told of errors.
///
/// # Safety
/// The pointer is null or from [`Fmu::create`], and no other thread uses it.
pub(crate) unsafe fn with(it: *mut c_void, act: impl FnOnce(&mut Fmu) -> Result<(), String>) -> c_int {
    // SAFETY: by the contract of this function.
    let Some(it) = (unsafe { it.cast::<Fmu>().as_mut() }) else { return ERROR };
    let (status, message) = match guarded(|| act(it)) {
        Ok(()) => return OK,
        Err((message, false)) => (ERROR, message),
        Err((message, true)) => (FATAL, message),
    };
    it.log.say(status, &message);
    status
}

/// Frees an instance; null is allowed.
///
/// # Safety
/// The pointer is null or from [`Fmu::create`], and the host uses it no more.
pub(crate) unsafe fn free(it: *mut c_void) {
    if !it.is_null() {
        let _ = guarded(|| {
            // SAFETY: by the contract of this function.
            drop(unsafe { Box::from_raw(it.cast::<Fmu>()) });
            Ok(())
        });
    }
}

fn of_kind(variable: &Variable, is_whole: bool) -> Result<(), String> {
    let kind = |is_whole| if is_whole { "an integer" } else { "a floating-point number" };
    if variable.is_whole() == is_whole {
        Ok(())
    } else {
        Err(format!("{} is {}, not {}", variable.name, kind(variable.is_whole()), kind(is_whole)))
    }
}

/// Reads variables. Integers are those of [`Variable::is_whole`].
///
/// # Safety
/// As for [`with`]; references and values are those of the host.
pub(crate) unsafe fn get<T>(
    it: *mut c_void,
    (references, count): (*const u32, usize),
    (found, room_for): (*mut T, usize),
    (is_whole, of): (bool, fn(f64) -> T),
) -> c_int {
    let read = |fmu: &mut Fmu| {
        // SAFETY: by the contract of this function.
        let (references, found) = unsafe { (values(references, count)?, room(found, room_for)?) };
        if references.len() != found.len() {
            return Err(format!("expected room for {count} values, got {room_for}"));
        }
        for (reference, found) in references.iter().zip(found) {
            // Hosts that know no integers read all outputs as floating-point numbers.
            if is_whole {
                of_kind(fmu.instance.variable(*reference)?, is_whole)?;
            }
            *found = of(fmu.instance.get(*reference)?);
        }
        Ok(())
    };
    // SAFETY: by the contract of this function.
    unsafe { with(it, read) }
}

/// Sets variables.
///
/// # Safety
/// As for [`get`].
pub(crate) unsafe fn set<T: Copy>(
    it: *mut c_void,
    (references, count): (*const u32, usize),
    (given, number): (*const T, usize),
    (is_whole, of): (bool, fn(T) -> f64),
) -> c_int {
    let write = |fmu: &mut Fmu| {
        fmu.expect(&[Phase::Created, Phase::Initialising, Phase::Running], "setting a variable")?;
        // SAFETY: by the contract of this function.
        let (references, given) = unsafe { (values(references, count)?, values(given, number)?) };
        if references.len() != given.len() {
            return Err(format!("expected {count} values, got {number}"));
        }
        for (reference, value) in references.iter().zip(given) {
            of_kind(fmu.instance.variable(*reference)?, is_whole)?;
            fmu.instance.set(*reference, of(*value))?;
        }
        Ok(())
    };
    // SAFETY: by the contract of this function.
    unsafe { with(it, write) }
}

/// Saves the state; an earlier one in the same place is freed.
///
/// # Safety
/// As for [`with`]; `state` is the place of null or of a saved state.
pub(crate) unsafe fn save(it: *mut c_void, state: *mut *mut c_void) -> c_int {
    let save = |fmu: &mut Fmu| {
        let mut bytes = vec![fmu.phase as u8];
        bytes.extend(fmu.instance.save());
        // SAFETY: by the contract of this function.
        unsafe {
            forget(state);
            put(state, Box::into_raw(Box::new(Saved(bytes))).cast());
        }
        Ok(())
    };
    // SAFETY: by the contract of this function.
    unsafe { with(it, save) }
}

/// Goes back to a saved state.
///
/// # Safety
/// As for [`with`]; `state` is null or a saved state.
pub(crate) unsafe fn restore(it: *mut c_void, state: *const c_void) -> c_int {
    let restore = |fmu: &mut Fmu| {
        // SAFETY: by the contract of this function.
        let saved =
            unsafe { state.cast::<Saved>().as_ref() }.ok_or("expected a state, got a null pointer")?;
        let (phase, bytes) = saved.0.split_first().ok_or("the state is empty")?;
        let all = [Phase::Created, Phase::Initialising, Phase::Running, Phase::Terminated];
        let phase = *all.get(usize::from(*phase)).ok_or("the state is damaged")?;
        fmu.instance.restore(bytes)?;
        fmu.phase = phase;
        Ok(())
    };
    // SAFETY: by the contract of this function.
    unsafe { with(it, restore) }
}

/// Frees the saved state in a place.
///
/// # Safety
/// The place is null, or that of null or of a saved state.
pub(crate) unsafe fn forget(state: *mut *mut c_void) {
    // SAFETY: by the contract of this function.
    if let Some(state) = unsafe { state.as_mut() }.filter(|state| !state.is_null()) {
        // SAFETY: by the contract of this function.
        drop(unsafe { Box::from_raw(state.cast::<Saved>()) });
        *state = std::ptr::null_mut();
    }
}

/// Writes the size of a saved state.
///
/// # Safety
/// As for [`restore`].
pub(crate) unsafe fn size(it: *mut c_void, state: *const c_void, size: *mut usize) -> c_int {
    let tell = |_: &mut Fmu| {
        // SAFETY: by the contract of this function.
        let saved =
            unsafe { state.cast::<Saved>().as_ref() }.ok_or("expected a state, got a null pointer")?;
        // SAFETY: by the contract of this function.
        unsafe { put(size, saved.0.len()) };
        Ok(())
    };
    // SAFETY: by the contract of this function.
    unsafe { with(it, tell) }
}

/// Writes a saved state as bytes.
///
/// # Safety
/// As for [`restore`]; the host gives room for `count` bytes.
pub(crate) unsafe fn serialise(it: *mut c_void, state: *const c_void, bytes: *mut u8, count: usize) -> c_int {
    let write = |_: &mut Fmu| {
        // SAFETY: by the contract of this function.
        let saved =
            unsafe { state.cast::<Saved>().as_ref() }.ok_or("expected a state, got a null pointer")?;
        // SAFETY: by the contract of this function.
        let room = unsafe { room(bytes, count) }?;
        let needed = saved.0.len();
        let room =
            room.get_mut(..needed).ok_or_else(|| format!("expected room for {needed} bytes, got {count}"))?;
        room.copy_from_slice(&saved.0);
        Ok(())
    };
    // SAFETY: by the contract of this function.
    unsafe { with(it, write) }
}

/// Creates a saved state from bytes. They are checked where the state is restored.
///
/// # Safety
/// As for [`save`]; the host gives `count` bytes.
pub(crate) unsafe fn deserialise(
    it: *mut c_void,
    (bytes, count): (*const u8, usize),
    state: *mut *mut c_void,
) -> c_int {
    let read = |_: &mut Fmu| {
        // SAFETY: by the contract of this function.
        let bytes = unsafe { values(bytes, count) }?.to_vec();
        // SAFETY: by the contract of this function.
        unsafe {
            forget(state);
            put(state, Box::into_raw(Box::new(Saved(bytes))).cast());
        }
        Ok(())
    };
    // SAFETY: by the contract of this function.
    unsafe { with(it, read) }
}

/// Functions whose body is that of an instance.
macro_rules! calls {
    ($($name:ident($($argument:ident: $kind:ty),*) |$it:ident| $body:expr;)*) => {$(
        #[unsafe(no_mangle)]
        unsafe extern "C" fn $name(it: *mut c_void $(, $argument: $kind)*) -> c_int {
            // SAFETY: the host gives an instance of this FMU, or null.
            unsafe { $crate::fmu::with(it, |$it: &mut $crate::fmu::Fmu| $body) }
        }
    )*};
}

pub(crate) use calls;

/// Functions for variables of types that do not exist here: nothing to do for no variable, otherwise an error.
macro_rules! absent {
    ($($name:ident)*) => {$(
        #[unsafe(no_mangle)]
        unsafe extern "C" fn $name(it: *mut c_void, _references: *const u32, count: usize) -> c_int {
            // SAFETY: the host gives an instance, or null.
            unsafe { $crate::fmu::with(it, |_| $crate::fmu::none(stringify!($name), count)) }
        }
    )*};
}

pub(crate) use absent;

/// Functions that save, restore, free, measure, serialise and deserialise a state.
macro_rules! states {
    ($save:ident $restore:ident $free:ident $size:ident $serialise:ident $deserialise:ident) => {
        #[unsafe(no_mangle)]
        unsafe extern "C" fn $save(it: *mut c_void, state: *mut *mut c_void) -> c_int {
            // SAFETY: the host gives an instance and the place of a state.
            unsafe { $crate::fmu::save(it, state) }
        }

        #[unsafe(no_mangle)]
        unsafe extern "C" fn $restore(it: *mut c_void, state: *const c_void) -> c_int {
            // SAFETY: the host gives an instance and a state.
            unsafe { $crate::fmu::restore(it, state) }
        }

        #[unsafe(no_mangle)]
        unsafe extern "C" fn $free(_it: *mut c_void, state: *mut *mut c_void) -> c_int {
            // SAFETY: the host gives the place of a state.
            unsafe { $crate::fmu::forget(state) };
            $crate::fmu::OK
        }

        #[unsafe(no_mangle)]
        unsafe extern "C" fn $size(it: *mut c_void, state: *const c_void, size: *mut usize) -> c_int {
            // SAFETY: the host gives an instance, a state and a place.
            unsafe { $crate::fmu::size(it, state, size) }
        }

        #[unsafe(no_mangle)]
        unsafe extern "C" fn $serialise(
            it: *mut c_void,
            state: *const c_void,
            bytes: *mut u8,
            count: usize,
        ) -> c_int {
            // SAFETY: the host gives an instance, a state and room.
            unsafe { $crate::fmu::serialise(it, state, bytes, count) }
        }

        #[unsafe(no_mangle)]
        unsafe extern "C" fn $deserialise(
            it: *mut c_void,
            bytes: *const u8,
            count: usize,
            state: *mut *mut c_void,
        ) -> c_int {
            // SAFETY: the host gives an instance, bytes and the place of a state.
            unsafe { $crate::fmu::deserialise(it, (bytes, count), state) }
        }
    };
}
pub(crate) use states;
