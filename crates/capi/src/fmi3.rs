//! Functions of FMI 3.0; the standard describes them. Co-simulation is supported, with early return at slip events.
#![allow(non_snake_case, reason = "names of the standard")]

use crate::fmu::{self, Fmu, Log, Logger, absent, calls, states};
use crate::pointers::{for_c, put, text};
use std::ffi::{c_char, c_int, c_void};
use std::path::Path;

type LogMessage = Option<unsafe extern "C" fn(*mut c_void, c_int, *const c_char, *const c_char)>;

#[unsafe(no_mangle)]
extern "C" fn fmi3GetVersion() -> *const c_char {
    c"3.0".as_ptr()
}

#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments, reason = "arguments of the standard")]
unsafe extern "C" fn fmi3InstantiateCoSimulation(
    name: *const c_char,
    token: *const c_char,
    resources: *const c_char,
    _visible: u8,
    _logging: u8,
    _event_mode: u8,
    early_return: u8,
    _intermediate: *const u32,
    _intermediate_count: usize,
    environment: *mut c_void,
    logger: LogMessage,
    _update: *const c_void,
) -> *mut c_void {
    // SAFETY: the host gives texts, or null.
    let (name, token, resources) = unsafe { (text(name), text(token), text(resources)) };
    let logger = logger.map_or(Logger::Silent, Logger::Three);
    let log = Log { logger, environment, name: for_c(name.unwrap_or_default()) };
    match (token, resources) {
        (Ok(token), Ok(resources)) => Fmu::create(token, Path::new(resources), early_return != 0, log),
        (Err(error), _) | (_, Err(error)) => fmu::refused(&log, &error),
    }
}

/// Kinds of FMU that do not exist here.
macro_rules! kinds {
    ($($name:ident($($argument:ident: $kind:ty),*);)*) => {$(
        #[unsafe(no_mangle)]
        #[allow(clippy::too_many_arguments, reason = "arguments of the standard")]
        extern "C" fn $name($($argument: $kind,)* environment: *mut c_void, logger: LogMessage) -> *mut c_void {
            let log = Log { logger: logger.map_or(Logger::Silent, Logger::Three), environment, name: for_c("") };
            fmu::refused(&log, "only co-simulation is supported")
        }
    )*};
}

kinds! {
    fmi3InstantiateModelExchange(_name: *const c_char, _token: *const c_char, _resources: *const c_char, _visible: u8, _logging: u8);
    fmi3InstantiateScheduledExecution(_name: *const c_char, _token: *const c_char, _resources: *const c_char, _visible: u8, _logging: u8);
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3FreeInstance(it: *mut c_void) {
    // SAFETY: the host gives an instance of fmi3InstantiateCoSimulation, or null.
    unsafe { fmu::free(it) }
}

calls! {
    fmi3SetDebugLogging(_on: u8, _count: usize, _categories: *const *const c_char) |_it| Ok(());
    fmi3EnterInitializationMode(_given: u8, _tolerance: f64, start: f64, _ends: u8, _stop: f64) |it| it.enter_initialisation(start);
    fmi3ExitInitializationMode() |it| it.exit_initialisation();
    fmi3Terminate() |it| it.terminate();
    fmi3Reset() |it| it.reset();
    fmi3EnterStepMode() |_it| Ok(());
}

#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments, reason = "arguments of the standard")]
unsafe extern "C" fn fmi3DoStep(
    it: *mut c_void,
    t: f64,
    step: f64,
    _keeps: u8,
    event: *mut u8,
    terminate: *mut u8,
    early: *mut u8,
    last: *mut f64,
) -> c_int {
    let advance = |fmu: &mut Fmu| {
        let outcome = fmu.step(t, step);
        let (time, is_early) = *outcome.as_ref().unwrap_or(&(fmu.instance.time(), false));
        // SAFETY: the host gives places, or null.
        unsafe {
            put(event, 0);
            put(terminate, 0);
            put(early, u8::from(is_early));
            put(last, time);
        }
        outcome.map(drop)
    };
    // SAFETY: the host gives an instance, or null.
    unsafe { fmu::with(it, advance) }
}

/// Functions that read and set variables of one type: floating-point numbers, or integers.
macro_rules! values {
    ($($get:ident $set:ident $kind:ty, $is_whole:literal, $of:expr, $to:expr;)*) => {$(
        #[unsafe(no_mangle)]
        unsafe extern "C" fn $get(it: *mut c_void, references: *const u32, count: usize, values: *mut $kind, room: usize) -> c_int {
            // SAFETY: the host gives an instance, references and places.
            unsafe { fmu::get(it, (references, count), (values, room), ($is_whole, $of)) }
        }

        #[unsafe(no_mangle)]
        unsafe extern "C" fn $set(it: *mut c_void, references: *const u32, count: usize, values: *const $kind, number: usize) -> c_int {
            // SAFETY: the host gives an instance, references and values.
            unsafe { fmu::set(it, (references, count), (values, number), ($is_whole, $to)) }
        }
    )*};
}

values! {
    fmi3GetFloat64 fmi3SetFloat64 f64, false, |value| value, |value| value;
    fmi3GetInt32 fmi3SetInt32 i32, true, |value| value as i32, f64::from;
    fmi3GetInt64 fmi3SetInt64 i64, true, |value| value as i64, |value| value as f64;
}

states! {
    fmi3GetFMUState fmi3SetFMUState fmi3FreeFMUState fmi3SerializedFMUStateSize fmi3SerializeFMUState fmi3DeserializeFMUState
}

absent! {
    fmi3GetFloat32 fmi3SetFloat32 fmi3GetInt8 fmi3SetInt8 fmi3GetUInt8 fmi3SetUInt8 fmi3GetInt16 fmi3SetInt16
    fmi3GetUInt16 fmi3SetUInt16 fmi3GetUInt32 fmi3SetUInt32 fmi3GetUInt64 fmi3SetUInt64 fmi3GetBoolean fmi3SetBoolean
    fmi3GetString fmi3SetString fmi3GetBinary fmi3SetBinary fmi3GetClock fmi3SetClock fmi3GetIntervalDecimal
    fmi3GetIntervalFraction fmi3GetShiftDecimal fmi3GetShiftFraction fmi3SetIntervalDecimal fmi3SetIntervalFraction
    fmi3SetShiftDecimal fmi3SetShiftFraction fmi3GetOutputDerivatives fmi3GetDirectionalDerivative
    fmi3GetAdjointDerivative
}

/// Functions of modes that do not exist here.
macro_rules! unsupported {
    ($($name:ident)*) => {$(
        #[unsafe(no_mangle)]
        unsafe extern "C" fn $name(it: *mut c_void) -> c_int {
            // SAFETY: the host gives an instance, or null.
            unsafe { fmu::with(it, |_| fmu::none(stringify!($name), 1)) }
        }
    )*};
}

unsupported! {
    fmi3EnterEventMode fmi3EnterConfigurationMode fmi3ExitConfigurationMode fmi3GetNumberOfVariableDependencies
    fmi3GetVariableDependencies fmi3EvaluateDiscreteStates fmi3UpdateDiscreteStates fmi3EnterContinuousTimeMode
    fmi3CompletedIntegratorStep fmi3SetTime fmi3SetContinuousStates fmi3GetContinuousStateDerivatives
    fmi3GetEventIndicators fmi3GetContinuousStates fmi3GetNominalsOfContinuousStates fmi3GetNumberOfEventIndicators
    fmi3GetNumberOfContinuousStates fmi3ActivateModelPartition
}
