//! What `stickslip info --json` says, and its tables under other heads.

use super::Definition;

const fn of(name: &'static str, text: &'static str) -> Definition {
    Definition { file: "info --json", name, text }
}

pub(super) const INFO: &[Definition] = &[
    of("scenario", "name of the scenario"),
    of("title", "the scenario's"),
    of("scenario_sha256", "SHA-256 of the resolved scenario, as in the summary of a run"),
    of("bodies.BODY.mass_kg", "m, mass; not told of a body that needs none"),
    of(
        "bodies.BODY.coordinates.AXIS",
        "what `x`, `z` and `pitch` do: `fixed`, `free` (by an equation of motion), `balanced` (where forces balance, without mass)",
    ),
    of("bodies.BODY.coordinates.AXIS.follows", "the waveform that the coordinate follows"),
    of("waveforms.WAVEFORM.period_s", "T, period; not told of what does not repeat"),
    of(
        "waveforms.WAVEFORM.commanded_Hz",
        "smallest and largest frequency that may be commanded of a generator",
    ),
    of("waveforms.WAVEFORM.range_m", "smallest and largest value over all time, where it drives lengths"),
    of("waveforms.WAVEFORM.range_N", "smallest and largest value over all time, where it drives forces"),
    of("waveforms.WAVEFORM.drives", "what follows it"),
    of("contacts.CONTACT.between", "first and second body"),
    of("contacts.CONTACT.materials", "names of their materials"),
    of("contacts.CONTACT.profile", "word for the profile"),
    of("contacts.CONTACT.count", "number of identical contacts"),
    of("contacts.CONTACT.normal_modulus_Pa", "E*, effective modulus: 1/E* = (1-ν₁²)/E₁ + (1-ν₂²)/E₂ (4.13)"),
    of(
        "contacts.CONTACT.tangential_modulus_Pa",
        "G*, effective shear modulus: 1/G* = (2-ν₁)/(4G₁) + (2-ν₂)/(4G₂), G = E/(2(1+ν)) (4.13)",
    ),
    of(
        "contacts.CONTACT.dundurs_beta",
        "β = [(1-2ν₁)/G₁ - (1-2ν₂)/G₂] / [2(1-ν₁)/G₁ + 2(1-ν₂)/G₂]; 0 of similar bodies (Dundurs 1969)",
    ),
    of("contacts.CONTACT.elastically_similar", "whether β is 0, which makes the theory exact"),
    of(
        "contacts.CONTACT.neglected_stiffness",
        "artanh(β)/β - 1, by how much of itself the normal stiffness at a given radius is too low at most, [derived here](figures.md#similarity)",
    ),
    of("contacts.CONTACT.similarity", "both in words"),
    of("contacts.CONTACT.friction", "μ, coefficient of friction"),
    of("contacts.CONTACT.stick_slope", "κ = μE*/G*, height under the memory curve per displacement"),
    of(
        "contacts.CONTACT.LOAD.normal_force_N",
        "F_N, normal force of one contact: 2E*∫₀^a (d - g(x)) dx (4.26)",
    ),
    of("contacts.CONTACT.LOAD.indentation_m", "d, indentation; below 0 the contact is open"),
    of("contacts.CONTACT.LOAD.contact_radius_m", "a, contact radius, where g(a) = d (4.26)"),
    of(
        "contacts.CONTACT.LOAD.peak_pressure_Pa",
        "p_max, largest pressure; infinite at tips and edges, not told of a list of springs",
    ),
    of(
        "contacts.CONTACT.LOAD.gross_slip_displacement_m",
        "u_c = κd, where gross slip of a first loading begins (4.28)",
    ),
    of(
        "contacts.CONTACT.LOAD.zero_step_stroke_m",
        "S₀, stroke up to which an ideal drive makes no step: flyback in no time, slow way back, all ringing damped, no load on the slider",
    ),
    of(
        "contacts.CONTACT.LOAD.loaded.force_N",
        "constant loads and gravity along x on the slider, where it has no other contact",
    ),
    of("contacts.CONTACT.LOAD.loaded.share", "its magnitude over μF_N of all count contacts"),
    of(
        "contacts.CONTACT.LOAD.loaded.zero_step_stroke_m",
        "S₀ where this load opposes the steps; not told where the contact does not hold it",
    ),
    of("contacts.CONTACT.LOAD.limit_force_N", "μF_N, what all count contacts hold at most"),
    of(
        "contacts.CONTACT.LOAD.tangential_stiffness_N_m",
        "∂F_x/∂u of all count contacts where all of them sticks: count · 2G*a",
    ),
    of("contacts.CONTACT.LOAD.normal_stiffness_N_m", "∂F_N/∂d of all count contacts: count · 2E*a"),
    of(
        "contacts.CONTACT.LOAD.contact_resonance_Hz",
        "√(k/m)/2π, with k the tangential stiffness and m the reduced mass of its two bodies; not told where neither is free",
    ),
    of(
        "modes.frequency_Hz",
        "frequency of a normal mode with all contacts stuck, as deep as at t = 0; 0: nothing holds this motion",
    ),
    of(
        "modes.frequency_range_Hz",
        "of the mode of this place at the smallest and the largest indentations, where loads vary",
    ),
    of("modes.damping_ratio", "share of critical damping: -Re λ/|λ| of its eigenvalue λ"),
    of("modes.shape.COORDINATE", "displacements in the mode, the largest of them 1"),
    of("stepping.stepper", "the stepper that the run takes"),
    of("stepping.tolerance", "its tolerance: local error per step, relative to the scales of the contacts"),
    of("stepping.step_s", "its step, where that is fixed; the longest of a frame"),
    of("stepping.frame_s", "length of a frame, of the stepper `frames`"),
    of("stepping.substeps", "steps that a frame takes without those that corners and contacts add"),
    of("stepping.duration_s", "simulated time"),
    of("stepping.until_steady", "largest relative change of a step at which the run ends earlier"),
    of(
        "stepping.longest_verlet_step_s",
        "longest stable step of velocity Verlet, 2/ω of the fastest mode with all contacts stuck and as deep as they get",
    ),
    of("stepping.longest_rk4_step_s", "the same of the classical Runge–Kutta method, 2√2/ω without damping"),
    of("expected.steps", "steps of a stepper of fixed step"),
    of("expected.events.corners", "corners of waveforms, counted"),
    of(
        "expected.events.contacts_estimate",
        "events of contacts, estimated to a factor of two on the examples",
    ),
    of("expected.events.per_period.waveform", "the waveform of `figures`"),
    of("expected.events.per_period.estimate", "all events in a period of it, on the average"),
    of("expected.rows", "rows of trace.csv"),
    of("expected.columns", "its columns"),
    of("expected.trace_B", "about the size of trace.csv, in bytes"),
    of("expected.events_B", "about the size of events.csv, in bytes"),
    of("expected.spring_lines", "lines of springs.csv"),
    of("expected.springs_B", "about its size, in bytes"),
    of("expected.memory_curves", "curves in memory.csv; an open contact has none"),
    of("expected.field_lines", "lines of fields.csv, and of friction.csv"),
    of("expected.memory_B", "about the memory that the program takes, in bytes"),
    of("usage.used.what", "what a run computes"),
    of("usage.used.of", "of which parts of the scene; not told of the whole"),
    of("usage.used.why", "why, or how"),
    of("usage.skipped.what", "what a run skips"),
    of("usage.skipped.of", "of which parts of the scene"),
    of("usage.skipped.why", "why it need not be computed"),
    of("warnings.kind", "what is odd about the scenario: as in summary.json"),
    of("warnings.path", "the place that it is about"),
    of("warnings.message", "what is odd"),
    of("warnings.help", "what to try"),
];
