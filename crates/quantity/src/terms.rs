//! Terms of the field that are not names of keys, columns or results, and names of Greek letters.

/// Term of the field with its explanation.
pub struct Term {
    /// Names in lower case.
    pub names: &'static [&'static str],
    /// Definition, with the command, key or column where the term occurs.
    pub text: &'static str,
    /// Page in docs/.
    pub page: &'static str,
}

/// All terms.
pub const TERMS: &[Term] = &[
    Term {
        names: &["mdr", "method of dimensionality reduction"],
        text: "the method of dimensionality reduction maps a contact to a one-dimensional row of independent springs with the same forces",
        page: "theory/contact_mechanics.md",
    },
    Term {
        names: &["partial slip", "mixed regime"],
        text: "an outer ring of the contact slips while its core sticks; `state` is `partial`, the regime of a loop `partial`: stickslip run fretting.json",
        page: "theory/contact_mechanics.md",
    },
    Term {
        names: &["gross slip", "sliding"],
        text: "the whole contact slips, from the displacement u_c on: contacts.CONTACT.gross_slip_displacement_m",
        page: "theory/contact_mechanics.md",
    },
    Term {
        names: &["stick-slip", "stick–slip", "stick slip"],
        text: "the contact sticks in the slow stroke and slips in the fast one, which makes a drive step: stickslip new, stickslip run drive.json",
        page: "start/drive_designer.md",
    },
    Term {
        names: &["slip memory", "memory curve", "return-point memory"],
        text: "the reversals that a contact remembers, over depth; a reversal is forgotten when its loop closes: \"output\": {\"memory\": {}}",
        page: "theory/contact_mechanics.md",
    },
    Term {
        names: &["masing", "masing's rules"],
        text: "unloading follows the first loading curve, doubled in force and displacement: stickslip contact FILE --history \"30 nm, -30 nm\"",
        page: "theory/contact_mechanics.md",
    },
    Term {
        names: &["hysteresis curve", "hysteresis loop", "fretting loop", "friction loop"],
        text: "tangential force over displacement: the plot `loop`, its numbers in cycles.csv and contacts.CONTACT.fretting; measured ones: stickslip measure FILE.csv",
        page: "how/measured_loop.md",
    },
    Term {
        names: &["running-condition map", "fretting map", "fretting regime", "slip regime"],
        text: "slip regimes over amplitude and load: stickslip map fretting.json --of contacts.CONTACT.regime; each run gives one point, contacts.CONTACT.fretting.regime",
        page: "how/maps.md",
    },
    Term {
        names: &["zero-step stroke", "zero-step amplitude", "dead zone", "zero step"],
        text: "S₀, the stroke below which a drive makes no step, since partial slip takes it up: stickslip curve FILE --curve step-amplitude",
        page: "how/curves.md",
    },
    Term {
        names: &["stall", "stall force", "blocking load"],
        text: "the load against the steps at which the mean speed is zero: stickslip curve FILE --curve force-speed",
        page: "how/curves.md",
    },
    Term {
        names: &["holding force"],
        text: "the maximum load that the drive holds at rest: stickslip curve FILE --curve holding-force",
        page: "how/curves.md",
    },
    Term {
        names: &["preload", "clamping force"],
        text: "the normal force of the contacts; contacts.NAME.normal.force is that of one contact, so 6 N on a count of 3 are 2 N: stickslip curve FILE --curve preload",
        page: "how/curves.md",
    },
    Term {
        names: &["friction coefficient", "coefficient of friction", "static friction", "kinetic friction"],
        text: "contacts.NAME.friction, μ, one coefficient per contact for stick and slip",
        page: "theory/limits.md",
    },
    Term {
        names: &["settling", "convergence", "settling time"],
        text: "whether the step length converges, drifts or oscillates as periods go by: steps.settling of summary.json, the plot `trajectory`",
        page: "theory/evaluation.md",
    },
    Term {
        names: &["step length", "step size of the drive"],
        text: "the displacement of the body in one drive period: length_m of steps.csv, steps.steady.step_m of summary.json",
        page: "theory/evaluation.md",
    },
    Term {
        names: &["kappa", "κ"],
        text: "κ = μE*/G*, the ratio of tangential to normal displacement at full slip: gross slip begins at u_c = κd, with d the indentation",
        page: "theory/contact_mechanics.md",
    },
    Term {
        names: &["ringing", "resonance", "dither"],
        text: "oscillation after the flyback, of the slider on its contacts or of the foot on its stack; it decides the step of many drives: MODES of stickslip info, the plot `drive`, actuators.NAME.damping, flyback and frequency of the waveform",
        page: "how/waveform.md",
    },
    Term {
        names: &["wear", "archard", "adhesion", "temperature"],
        text: "not modelled",
        page: "theory/limits.md",
    },
    Term {
        names: &["contact stiffness", "tangential contact stiffness"],
        text: "2G*a of one contact, where all of it sticks: contacts.CONTACT.LOAD.tangential_stiffness_N_m of stickslip info --json",
        page: "theory/contact_mechanics.md",
    },
    Term {
        names: &["current limit", "slew rate", "driver limit"],
        text: "actuators.NAME.driver.current, A: the voltage changes no faster than I/C; drivers.ACTUATOR.at_limit gives the share of time",
        page: "how/driver.md",
    },
    Term {
        names: &["charge control"],
        text: "a driver that controls the charge: \"control\": \"charge\" in actuators.NAME.driver",
        page: "how/driver.md",
    },
    Term {
        names: &["prandtl-ishlinskii", "prandtl–ishlinskii", "bouc-wen", "bouc–wen", "piezo hysteresis"],
        text: "models of actuators.NAME.hysteresis: `loop`, `plays` and `bouc_wen`",
        page: "how/hysteresis.md",
    },
    Term {
        names: &["quality factor"],
        text: "Q = √(k m)/c of a stack; give actuators.NAME.damping = √(k m)/Q instead",
        page: "how/data_sheet.md",
    },
    Term {
        names: &[
            "limit cycle",
            "periodic orbit",
            "shooting",
            "poincaré map",
            "poincare map",
            "floquet multiplier",
            "monodromy matrix",
        ],
        text: "the periodic motion of a drive, found by shooting on its Poincaré map, with Floquet multipliers: stickslip steady FILE",
        page: "how/periodic_orbit.md",
    },
    Term {
        names: &[
            "bifurcation",
            "continuation",
            "pseudo-arclength",
            "period doubling",
            "neimark-sacker",
            "fold",
            "predictor",
            "corrector",
        ],
        text: "the periodic orbit is followed by pseudo-arclength continuation, a predictor and a corrector, while a parameter changes: stickslip branch FILE --vary PATH=FROM..TO",
        page: "how/branch.md",
    },
    Term {
        names: &[
            "event function",
            "zero crossing",
            "event location",
            "dense output",
            "step size",
            "tolerance",
        ],
        text: "the stepper `event` locates every event as a zero of its event function on the dense output; its step size follows one tolerance",
        page: "theory/event_detection.md",
    },
    Term {
        names: &["parameter sweep", "sweep", "design of experiments"],
        text: "many variants of a scenario, on a grid or by a design of experiments: stickslip study STUDY.json; one parameter: stickslip curve FILE --vary PATH=FROM..TO",
        page: "how/studies.md",
    },
    Term {
        names: &["stick", "full stick"],
        text: "no spring of the contact slips: `state` is `stick`, the stick radius equals the contact radius",
        page: "theory/contact_mechanics.md",
    },
    Term {
        names: &["friction energy", "dissipated energy", "friction work"],
        text: "the work of the friction forces along the slip: CONTACT.friction_J of trace.csv, dissipated_J of cycles.csv, the area of a closed loop",
        page: "theory/evaluation.md",
    },
    Term {
        names: &["back-step", "backstep", "backward motion"],
        text: "the displacement against the step direction during the flyback: steps.steady.back_step_m",
        page: "theory/evaluation.md",
    },
    Term {
        names: &["sliding mode", "zeno", "chattering"],
        text: "events of a contact accumulate; the stepper then integrates the full force law by step doubling: counts.step_doublings",
        page: "theory/event_detection.md",
    },
    Term {
        names: &["saltation", "saltation matrix", "variational equations"],
        text: "the jump of the variational equations at an event, part of the monodromy matrix of a periodic orbit",
        page: "theory/periodic_orbits.md",
    },
    Term {
        names: &["differential-algebraic", "index 1", "quasi-static"],
        text: "a coordinate without mass has the position at which the forces balance: \"x\": \"balanced\" in bodies.NAME",
        page: "theory/time_integration.md",
    },
    Term {
        names: &["sensitivity", "elasticity", "derivative"],
        text: "the change of a result with a parameter, absolute or relative (elasticity): stickslip sensitivity FILE",
        page: "how/sensitivity.md",
    },
    Term {
        names: &["sobol indices", "sobol", "global sensitivity", "variance-based sensitivity"],
        text: "the share of the variance of a result that a parameter causes: stickslip study indices STUDY.json",
        page: "how/studies.md",
    },
    Term {
        names: &["creep"],
        text: "slow drift of a piezo stack after a step of voltage: actuators.NAME.creep",
        page: "how/hysteresis.md",
    },
    Term {
        names: &["units"],
        text: "numbers without a unit are in SI, strings have a unit: \"0.5 mm\", \"10 us\", \"0.3 N\"",
        page: "how/units.md",
    },
];

/// Returns the Greek letter of a name: κ for `kappa`.
#[must_use]
pub fn letter(name: &str) -> Option<&'static str> {
    const LETTERS: [(&str, &str); 10] = [
        ("alpha", "α"),
        ("beta", "β"),
        ("delta", "δ"),
        ("kappa", "κ"),
        ("lambda", "λ"),
        ("mu", "μ"),
        ("nu", "ν"),
        ("omega", "ω"),
        ("rho", "ρ"),
        ("theta", "θ"),
    ];
    LETTERS.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).map(|(_, letter)| *letter)
}
