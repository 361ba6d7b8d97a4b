//! Columns of all tables: name with unit, and definition.

use super::Columns;

/// Declares a table of columns from pairs of a name and a definition.
macro_rules! columns {
    ($table:ident, $file:literal, $($name:literal: $text:literal,)*) => {
        #[doc = concat!("`", $file, "`.")]
        pub const $table: Columns = Columns { file: $file, names: &[$($name),*], texts: &[$($text),*] };
    };
}

columns! { TRACE, "trace.csv",
    "time_s": "time t since the start. At a jump of a waveform, the row has the values before the jump. If the run ends at a jump, the results at the end in summary.json have the values after it.",
    "BODY.x_m": "displacement x of the body along the slide, from the reference position",
    "BODY.vx_m_s": "velocity of the body along the slide, dx/dt",
    "BODY.z_m": "displacement z of the body normal to the slide, from the reference position, positive upwards",
    "BODY.vz_m_s": "velocity of the body normal to the slide, dz/dt",
    "BODY.pitch_rad": "rotation θ of the body, positive from x towards z",
    "BODY.vpitch_rad_s": "angular velocity of the body, dθ/dt",
    "CONTACT.u_m": "relative tangential displacement u of the two bodies at the contact point since the start: x of the first body minus x of the second",
    "CONTACT.d_m": "indentation d. For a coupled contact: z of the first body minus z of the second minus the gap, negative while the contact is open.",
    "CONTACT.fx_N": "tangential force F_x on the second body, total of all identical contacts: `count · 2∫₀^∞ q_x(x) dx` with the tangential line load q_x. With contact damping β, springs carry `q_x = G*(s + βu̇)` within their friction limit.",
    "CONTACT.fn_N": "normal force F_N, total of all identical contacts: `count · 2E*∫₀^a (d - g(x)) dx`",
    "CONTACT.a_m": "contact radius a, where g(a) = d",
    "CONTACT.stick_m": "stick radius c: springs within it do not slip. c = a in full stick, c = 0 in gross slip.",
    "CONTACT.state": "state of the contact: `open`, `stick` (full stick), `partial` (partial slip: springs at the edge slip) or `slip` (gross slip)",
    "CONTACT.elastic_J": "elastic energy of the tangential springs with stretch s, total of all identical contacts: `count · 2∫₀^a G*s²/2 dx`. In full stick with growing indentation it is integrated in time, with an error below tolerance · μF_N u_c, so it may be slightly negative.",
    "CONTACT.friction_J": "friction work since the start, total of all identical contacts: force of each slipping spring times its slip. With a varying indentation it may decrease by the integration error, about tolerance · μF_N u_c.",
    "ACTUATOR.voltage_V": "voltage V at a piezo stack that has a driver. Under charge control: charge divided by the capacitance C.",
    "ACTUATOR.current_A": "current C·dV/dt into the stack. With a reciprocal driver it includes the charge caused by strain.",
    "ACTUATOR.source_J": "energy supplied by the source of the driver since the start: ∫f·I dt, with the current I and the voltage f that the output stage follows",
    "ACTUATOR.stored_J": "energy stored in the capacitance of the stack: CV²/2. With a reciprocal driver: CV²/2 - kαV(αV - e), with stiffness k, stroke per volt α and elongation e.",
    "ACTUATOR.lost_J": "energy lost in the driver since the start: ∫(f - V)·I dt. Without a reciprocal driver it equals source_J minus the change of stored_J.",
    "ACTUATOR.mechanical_J": "work of the stack that a reciprocal driver supplies, since the start: ∫k(αV - e)α dV = source_J - lost_J - change of stored_J",
    "ACTUATOR.hysteresis.stroke_m": "free stroke of the stack after the hysteresis model",
    "ACTUATOR.creep.stroke_m": "free stroke of the stack after the hysteresis and creep models. It acts in the equations of motion.",
    "ACTUATOR.inverse_creep.stroke_m": "free stroke after inverse compensation of creep. The creep model turns it into the commanded stroke.",
    "ACTUATOR.inverse_hysteresis.stroke_m": "free stroke after inverse compensation of hysteresis: the command of the driver. The hysteresis model turns it into the input of this block.",
    "energy.input_J": "work done on the model since the start by prescribed motions and strokes, loads, preloads and gravity",
    "energy.kinetic_J": "kinetic energy of the free bodies: Σ(m(vx² + vz²) + I·vpitch²)/2",
    "energy.elastic_J": "energy stored in contacts (normal and tangential), springs and stacks",
    "energy.friction_J": "friction work of all contacts since the start",
    "energy.damping_J": "energy dissipated since the start by dampers and contact damping",
    "energy.error_J": "error of the energy balance: input - (kinetic + elastic - elastic at the start) - friction - damping. 0 for an exact run.",
}

columns! { EVENTS, "events.csv",
    "source": "name of the contact, waveform or block to which the event belongs. The columns after `kind` are those of trace.csv, with the values after the event.",
    "kind": "kind of the event. Contacts: `reversal` (the direction of slip reverses), `loop closed` (an inner hysteresis loop closes, its reversals are erased), `gross slip` (begins), `gross slip ends`, `breaks loose` and `sticks again` (the same with static and kinetic friction), `full stick` (the contact begins to grow without slip), `slip begins` (after such growth), `touch`, `lift-off`. Waveforms: `corner`, `jump`. Drivers: `current limit up`, `current limit down`, `current in limits`, `voltage at lower end`, `voltage at upper end`, `voltage in window`. Piezo hysteresis: `input turns`, `play taken up`, `lag turns` (Bouc–Wen: z crosses zero). Under a constant indentation, a `reversal` is a reversal of u. If the indentation varies, it comes slightly later, and not at all if the contact grows in full stick. A row of springs under constant normal force reports `gross slip ends` at the end of a time step.",
}

columns! { SPRINGS, "springs.csv",
    "time_s": "time of the snapshot",
    "contact": "name of the contact. Forces are those of one of the identical contacts.",
    "x_m": "position x of the spring in the row, from the middle. Springs of both sides are listed.",
    "stretch_m": "tangential stretch s of the spring",
    "state": "state of the spring: `open`, `stick`, `slip+` or `slip-` (sign of its force)",
    "g_m": "substitute profile g at the spring: `g(x) = |x|∫₀^|x| f′(r)/√(x² - r²) dr` (4.20)",
    "fx_N": "tangential force of the spring, G*s·Δx, with the spacing Δx of the springs",
    "fz_N": "normal force of the spring, E*(d - g)·Δx",
    "limit_N": "friction limit of the spring, μ·fz",
}

columns! { MEMORY, "memory.csv",
    "time_s": "time of the snapshot",
    "contact": "name of the contact. An open contact has no rows.",
    "d_m": "indentation d at this time",
    "u_m": "tangential displacement u at this time",
    "h_m": "height h of a corner of the memory curve p(h), from the centre to the edge. It belongs to the springs with g(x) = h.",
    "p_m": "position p(h) at this corner: the displacement u at which these springs carry no tangential force. Their stretch is u - p.",
}

columns! { FIELDS, "fields.csv",
    "time_s": "time of the snapshot",
    "contact": "name of the contact. Values are those of one of the identical contacts.",
    "r_m": "distance r from the axis of the contact",
    "p_Pa": "pressure at r: p(r) = -(1/π)∫_r^∞ q_z′(x)/√(x² - r²) dx, with the normal line load q_z",
    "tau_Pa": "shear stress τ at r: the integral of p_Pa with the tangential line load q_x instead of q_z (4.25)",
    "u_m": "tangential displacement of the surface at r relative to points far from the contact (4.25)",
    "slip_m": "local slip at r: lag of the surface at r behind the surface at the centre. It is 0 at the centre, also in gross slip. If u changed while the contact grew, it includes the motion before r came into contact.",
    "w_m": "normal displacement of the surface at r",
    "state": "state of the surface at r: `stick`, `slip` or `open`",
    "error_Pa": "estimated quadrature error of p_Pa and tau_Pa. It does not include the interpolation between the points of a tabulated profile. 0 if closed forms are used.",
    "error_m": "estimated quadrature error of u_m and w_m. 0 if closed forms are used.",
}

columns! { FRICTION, "friction.csv",
    "time_s": "time of the snapshot",
    "contact": "name of the contact. Values are those of one of the identical contacts.",
    "r_m": "distance r from the axis of the contact",
    "work_J_m2": "friction work per area at r since the start, ∫τ d(slip), computed for the smooth profile. With a row of few springs, its integral over the area is below the friction work of the contact: by 29 % with 32 springs, 6 % with 128 and 0.2 % with 1 024 in one scenario.",
    "slip_path_m": "slip path at r since the start: total distance that the surfaces have slid over each other",
}

columns! { CYCLES, "cycles.csv",
    "contact": "name of the contact",
    "cycle": "number of the cycle, from 1",
    "start_s": "time at the start of the cycle",
    "end_s": "time at the end of the cycle",
    "closed": "`yes` if F_x returns within 1 % of its range. Only then the cycle is evaluated as a hysteresis loop.",
    "displacement_amplitude_m": "δ*, displacement amplitude: (u_max - u_min)/2",
    "force_amplitude_N": "Q*, tangential force amplitude: (F_max - F_min)/2",
    "half_opening_m": "δ₀, half the width of the loop at the middle of the range of F_x",
    "dissipated_J": "E_d, energy dissipated by the contact in the cycle, by friction and contact damping. Empty if the contact is damped and other parts of the model dissipate, too.",
    "damping_J": "part of E_d that contact damping dissipates. Friction dissipates the rest.",
    "mean_normal_force_N": "P, mean of F_N over the cycle. Exact if a waveform prescribes F_N, otherwise the mean of samples.",
    "energy_ratio": "A, energy ratio: `A = E_d/(4Q*δ*)`. 0 for an elastic contact, 1 for a rectangular loop.",
    "system_free_ratio": "B, system-free ratio: B = E_d/(4Q*δ₀), independent of the compliance of the rig. Empty if δ₀ is 0 within rounding, as in full stick.",
    "slip_ratio": "D, slip ratio: D = δ₀/δ*",
    "energy_coefficient_of_friction": "μ_e, energy coefficient of friction: μ_e = E_d/(4Pδ₀), with the mean normal force P. Empty if δ₀ is 0 within rounding.",
    "stiffness_after_maximum_N_m": "tangent stiffness dF_x/du immediately after the reversal at the largest u, in full stick: count · 2G*a",
    "stiffness_after_minimum_N_m": "tangent stiffness dF_x/du immediately after the reversal at the smallest u, in full stick: count · 2G*a",
    "secant_after_maximum_N_m": "secant stiffness over the first tenth of the displacement range after the largest u, as evaluated in experiments",
    "secant_after_minimum_N_m": "secant stiffness over the first tenth of the displacement range after the smallest u, as evaluated in experiments",
    "regime": "slip regime: `still` (u does not move within the resolution), `gross` (F_x reaches +μF_N and -μF_N), `stick` (A below 5e-4), otherwise `partial`. Except for `still`, empty if the normal force varies or the contact is damped.",
}

columns! { STEPS, "steps.csv",
    "period": "number of the period, from 1",
    "start_s": "time at the start of the period",
    "end_s": "time at the end of the period",
    "length_m": "step length: x of the body at the end of the period minus x at its start",
    "x_m": "position x of the body at the start of the period",
    "smallest_m": "smallest x of the body in the period, both ends included",
    "largest_m": "largest x of the body in the period, both ends included",
}

columns! { PULSES, "pulses.csv",
    "pulse": "number of the pulse, a single cycle of a burst or a sequence, from 1",
    "start_s": "time at the start of the pulse",
    "end_s": "time at the end of the pulse",
    "direction": "1, or -1 for a pulse that is reversed in time",
    "step_m": "x of the body at the end of the pulse minus x at its start",
    "first_after_turn": "`true` if the pulse before had the other direction. Such a pulse first turns the contact, so its step differs.",
}

columns! { CONTACT_HISTORY, "contact: history.csv",
    "corner": "number of the corner of the history at which the straight section ends, 0 for the start",
    "share": "fraction of the section between the previous corner and this one, up to 1",
    "d_m": "d, indentation",
    "u_m": "u, tangential displacement",
    "fn_N": "F_N, normal force (4.26)",
    "fx_N": "F_x, tangential force (4.39)",
    "a_m": "a, contact radius",
    "c_m": "c, stick radius: springs within it do not slip",
    "state": "state of the contact: `open`, `stick`, `partial` or `slip`",
    "elastic_J": "elastic energy of the tangential deformation",
    "friction_J": "friction work since the start (4.40)",
}

columns! { CONTACT_FIELDS, "contact: fields.csv",
    "corner": "number of the corner of the history, 0 for the start",
    "r_m": "r, distance from the axis of the contact",
    "pressure_Pa": "p, pressure at r: p(r) = -(1/π)∫_r^∞ q_z′(x)/√(x² - r²) dx, with the normal line load q_z",
    "shear_Pa": "τ, shear stress at r: the integral of the pressure with the tangential line load q_x instead of q_z (4.25)",
    "displacement_m": "tangential displacement of the surface at r relative to points far from the contact (4.25)",
    "slip_m": "local slip at r: lag of the surface at r behind the surface at the centre. It is 0 at the centre, also in gross slip. If u changed while the contact grew, it includes the motion before r came into contact.",
    "deflection_m": "normal displacement of the surface at r",
    "state": "state of the surface at r: `stick`, `slip+`, `slip-` (direction of the slip) or `open`",
}

columns! { CONTACT_LINE, "contact: line.csv",
    "corner": "number of the corner of the history, 0 for the start",
    "x_m": "x, position of the spring in the row, from the middle",
    "length_m": "Δx, length of the row that the spring represents",
    "g_m": "g(x), substitute profile at the spring (4.20)",
    "kz_N_m": "normal stiffness of the spring, E*Δx (4.21)",
    "kx_N_m": "tangential stiffness of the spring, G*Δx (4.21)",
    "qz_N_m": "q_z, normal line load: E*(d - g) (4.24)",
    "qx_N_m": "q_x, tangential line load: G*s (4.31)",
    "limit_N_m": "friction limit of the line load, μq_z (4.22)",
    "fz_N": "normal force of the spring, q_zΔx (4.23)",
    "fx_N": "tangential force of the spring, q_xΔx (4.23)",
    "stretch_m": "s, tangential stretch of the spring (4.29)",
    "state": "state of the spring: `open`, `stick`, `slip+` or `slip-` (sign of its force)",
}

columns! { CONTACT_FRICTION, "contact: friction.csv",
    "corner": "number of the corner of the history at which the straight section ends",
    "share": "fraction of the section between the previous corner and this one, up to 1",
    "r_m": "r, distance from the axis of the contact",
    "work_J_m2": "friction work per area at r since the start, ∫τ d(slip) (4.41)",
    "slip_path_m": "slip path at r since the start: total distance that the surfaces have slid over each other",
}

columns! { CONTACT_NORMAL, "contact: normal.csv",
    "d_m": "d, indentation",
    "a_m": "a, contact radius (4.26)",
    "fn_N": "F_N, normal force (4.26)",
    "stiffness_N_m": "normal stiffness ∂F_N/∂d: 2E*a",
    "u_c_m": "u_c, gross slip displacement: u_c = κd (4.28)",
}

columns! { CONTACT_UNIVERSAL, "contact: universal.csv",
    "c_a": "c/a, stick radius divided by contact radius",
    "u_uc": "u/u_c, tangential displacement divided by the gross slip displacement",
    "fx_mufn": "F_x/(μF_N), tangential force divided by the friction limit (4.37)",
    "c_m": "c, stick radius (4.27)",
    "u_m": "u, tangential displacement",
    "fx_N": "F_x, tangential force by superposition: μ[F_N(a) - F_N(c)] (4.38)",
    "fx_by_integral_N": "tangential force F_x by integration of the line load (4.39)",
    "friction_J": "friction work of the first loading (4.42)",
}

columns! { VALIDATE, "validate",
    "deviation": "deviation between this program and the reference, as named on the page",
    "asked: at most": "largest permitted deviation",
    "found": "largest deviation that the program has, or the root mean square if the row says rms",
    "page": "link to the page with set-up, numbers and limits of the comparison",
    "reference": "reference of the comparison: a measurement, another program or a closed form",
    "case": "case of the comparison, as named on the page",
    "program": "value that this program computes",
    "known": "value of the reference",
    "formula": "value of the closed form",
    "off by": "difference between the program and the reference or closed form. Relative if it ends with %.",
}

columns! { BRANCH, "branch.csv",
    "largest_multiplier": "|λ|, modulus of the largest Floquet multiplier",
    "oscillation_periods": "number of drive periods in one oscillation of the disturbance with the largest multiplier. Empty if it does not oscillate.",
}

columns! { CURVE, "curve.csv",
    "stroke_m": "parameter of the curve `step-amplitude`: stroke of the waveform named in `figures`",
    "amplitude_m": "parameter of the curve `step-amplitude` for a sine or a sum of harmonics: amplitude of the waveform named in `figures`",
    "frequency_Hz": "parameter of the curve `speed-frequency`: drive frequency, 1 / period of the waveform named in `figures`",
    "load_N": "parameter of the curves `force-speed` and `step-load`: load on the body named in `figures`, positive against its steps",
    "preload_N": "parameter of the curves `preload` and `holding-force`: sum of the normal forces of all contacts of the body named in `figures`",
    "along_x_N": "holding force along +x, of the curve `holding-force`: largest additional load in this direction on the body named in `figures` at which the drive stays at rest",
    "along_x_half_width_N": "uncertainty of the holding force: half of the bracket in which it lies, plus the accuracy of the equilibrium",
    "along_x_gives_way": "what fails above the holding force: a body slides away, lifts off or, if free to pitch, slides or tips over",
    "along_x_fault": "why there is no holding force: the drive does not hold even without the additional load, or something other than friction holds any load",
    "against_x_N": "holding force along -x, of the curve `holding-force`: largest additional load in this direction on the body named in `figures` at which the drive stays at rest",
    "against_x_half_width_N": "uncertainty of the holding force: half of the bracket in which it lies, plus the accuracy of the equilibrium",
    "against_x_gives_way": "what fails above the holding force: a body slides away, lifts off or, if free to pitch, slides or tips over",
    "against_x_fault": "why there is no holding force: the drive does not hold even without the additional load, or something other than friction holds any load",
}

columns! { MAP, "map.csv",
    "x": "value of the parameter along the horizontal axis, SI",
    "y": "value of the parameter along the vertical axis, SI",
    "result": "result at the point (x, y): a number in SI or a word. Empty if there is none.",
}

columns! { SENSITIVITY, "sensitivity.csv",
    "figure": "name of the result: a number of summary.json, a channel at the end of the run, or a result of the periodic orbit",
    "figure_unit": "SI unit of the result, empty for a plain number",
    "figure_value": "value of the result in the unchanged scenario, computed with the tolerance of the derivatives",
}
