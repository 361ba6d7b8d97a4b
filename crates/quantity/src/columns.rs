//! Columns of all tables: the name of each with its unit, and what it is.

use super::Columns;

/// A table of columns: name and meaning of each.
macro_rules! columns {
    ($table:ident, $file:literal, $($name:literal: $text:literal,)*) => {
        #[doc = concat!("`", $file, "`.")]
        pub const $table: Columns = Columns { file: $file, names: &[$($name),*], texts: &[$($text),*] };
    };
}

columns! { TRACE, "trace.csv",
    "time_s": "time t since the start; a row at the moment of a jump shows what is before it, also the last row, where the end in summary.json is after it",
    "BODY.x_m": "displacement along the slide from the reference position",
    "BODY.vx_m_s": "its rate, dx/dt",
    "BODY.z_m": "displacement along the normal, up, from the reference position",
    "BODY.vz_m_s": "its rate, dz/dt",
    "BODY.pitch_rad": "angle θ, positive from x towards z",
    "BODY.vpitch_rad_s": "its rate, dθ/dt",
    "CONTACT.u_m": "tangential displacement u = x(first body) - x(second body) at the contact point, since the start",
    "CONTACT.d_m": "indentation d; of a coupled contact z(first) - z(second) - gap, negative while it is open",
    "CONTACT.fx_N": "tangential force on the second body, of all count contacts: count · 2∫₀^∞ q_x(x) dx of the springs; with damping those that stick bear βG*ṡ beside G*s, and F_x may exceed μF_N",
    "CONTACT.fn_N": "normal force of all count contacts: count · 2E*∫₀^a (d - g(x)) dx",
    "CONTACT.a_m": "contact radius a, where g(a) = d",
    "CONTACT.stick_m": "stick radius c: within it no spring slips; a while all stick, 0 in gross slip",
    "CONTACT.state": "`open`, `stick` (all of it), `partial` (a ring slips) or `slip` (all of it)",
    "CONTACT.elastic_J": "energy stored by the tangential springs, count · 2∫₀^a G*s²/2 dx, s their stretch; never below 0 but by the error of the steps: in full stick of a contact that is pressed deeper it is an integral of the run, less than a tolerance of μF_N u_c off",
    "CONTACT.friction_J": "work of friction since the start, the force of every slipping spring along its slip; never falls but by the error of the steps: about a tolerance of μF_N u_c of a contact whose indentation varies, such as on touching again, where u_c is small beside what it becomes",
    "ACTUATOR.voltage_V": "voltage V at a stack that has a driver; charge over C where that controls the charge",
    "ACTUATOR.current_A": "current C·dV/dt into the stack, with the charge of strain where the driver is reciprocal",
    "ACTUATOR.source_J": "work ∫f·I dt of the driver's source since the start, f what its output stage follows",
    "ACTUATOR.stored_J": "energy CV²/2 in the stack's capacitance; of a reciprocal driver less kαV(αV - e)",
    "ACTUATOR.lost_J": "work ∫(f - V)·I dt lost in the driver since the start: source less what the store has gained",
    "ACTUATOR.mechanical_J": "work ∫k(αV - e)α dV of a stack since the start that its reciprocal driver pays: source less lost less what the store has gained",
    "ACTUATOR.hysteresis.stroke_m": "free stroke behind the hysteresis of a stack",
    "ACTUATOR.creep.stroke_m": "free stroke behind its creep: what the stack follows",
    "ACTUATOR.inverse_creep.stroke_m": "stroke to be asked for so that creep makes the command of it",
    "ACTUATOR.inverse_hysteresis.stroke_m": "stroke to be asked for so that hysteresis makes that of it",
    "energy.input_J": "work of followers, loads, preloads and gravity since the start",
    "energy.kinetic_J": "Σ(m(vx² + vz²) + I·vpitch²)/2 of the free bodies",
    "energy.elastic_J": "energy stored by contacts (both directions), springs and stacks",
    "energy.friction_J": "work of friction of all contacts since the start",
    "energy.damping_J": "work of dampers and damped contacts since the start",
    "energy.error_J": "what the books miss: input - (kinetic + elastic - at the start) - friction - damping; 0 of an exact run",
}

columns! { EVENTS, "events.csv",
    "source": "the contact, waveform or block that the event belongs to; the columns after `kind` are those of trace.csv, after it",
    "kind": "`reversal` (u turns; where the indentation varies the edge of slip that drags does, a little after u, and none where the contact grows in full stick), `loop closed` (a turning point is forgotten), `gross slip`, `gross slip ends` (of a row of springs under a constant normal at the end of a step), `full stick` (grows without slip), `slip begins`, `touch`, `lift-off`, `corner` and `jump` of a waveform, `input turns`, `play taken up` and `lag turns` of hysteresis",
}

columns! { SPRINGS, "springs.csv",
    "time_s": "the moment",
    "contact": "the contact; forces are those of one of its count",
    "x_m": "place of the spring in the row, from the middle; both sides are listed",
    "stretch_m": "tangential stretch s of the spring",
    "state": "`open`, `stick`, `slip+` or `slip-` (the sense of the force)",
    "g_m": "height g(x) of the one-dimensional profile, g(x) = |x|∫₀^|x| f′(r)/√(x² - r²) dr (4.20)",
    "fx_N": "tangential force G*s·Δx",
    "fz_N": "normal force E*(d - g)·Δx",
    "limit_N": "what friction bears, μ·fz",
}

columns! { MEMORY, "memory.csv",
    "time_s": "the moment",
    "contact": "the contact; nothing while it is open",
    "d_m": "indentation d at the apex of the curve: now",
    "u_m": "displacement u at the apex",
    "h_m": "corner of the memory curve: height h of the springs it is about, from the centre to the edge",
    "p_m": "corner of the memory curve: place p to which those springs are tied; they are stretched by u - p",
}

columns! { FIELDS, "fields.csv",
    "time_s": "the moment",
    "contact": "the contact, one of its count",
    "r_m": "distance r from the axis",
    "p_Pa": "pressure p(r) = -(1/π)∫_r^∞ q_z′(x)/√(x² - r²) dx",
    "tau_Pa": "shear stress τ(r), the same of q_x (4.25)",
    "u_m": "tangential displacement of the surface at r against the far body (4.25)",
    "slip_m": "by how much the surface at r lags behind that in the centre: local slip, counted from how far the centre has slid, and, where the contact has grown on a slanting way, what the body had moved before r touched",
    "w_m": "normal displacement of the surface at r",
    "state": "`stick`, `slip` or `open` at r",
    "error_Pa": "estimated error of both stresses, of the quadrature alone: what a table leaves open between its points is not in it; 0 where closed forms hold",
    "error_m": "estimated error of the displacements; 0 where closed forms hold",
}

columns! { FRICTION, "friction.csv",
    "time_s": "the moment",
    "contact": "the contact, one of its count",
    "r_m": "distance r from the axis",
    "work_J_m2": "work of friction per area at r since the start, ∫τ·d(slip), of the smooth profile: of a contact on a row of few springs it adds up to less than friction takes, in one scenario with 32 springs by 29 %, with 128 by 6 %, with 1 024 by 0.2 %",
    "slip_path_m": "path that the surfaces have slid over each other at r since the start",
}

columns! { CYCLES, "cycles.csv",
    "contact": "the contact",
    "cycle": "number of the cycle, from 1",
    "start_s": "time at its start",
    "end_s": "time at its end",
    "closed": "`yes` where F_x comes back within a hundredth of its range: only then it is a loop",
    "displacement_amplitude_m": "δ* = (u_max - u_min)/2",
    "force_amplitude_N": "Q* = (F_max - F_min)/2",
    "half_opening_m": "δ₀, half of the way between the places where F_x passes the middle of its range",
    "dissipated_J": "E_d, all that the contact loses in the cycle, to friction and to its damping; empty where other parts lose energy as well as its damping",
    "damping_J": "damping's part of E_d; friction's is the rest",
    "mean_normal_force_N": "P, mean of F_N over the cycle: the integral of a waveform that presses, of other loads from moment to moment",
    "energy_ratio": "A = E_d/(4Q*δ*): 0 elastic, 1 a parallelogram as wide as the stroke",
    "system_free_ratio": "B = E_d/(4Q*δ₀), which no compliance of the rig enters; empty where δ₀ is rounding, as in full stick",
    "slip_ratio": "D = δ₀/δ*",
    "energy_coefficient_of_friction": "μ_e = E_d/(4Pδ₀)",
    "stiffness_after_maximum_N_m": "tangent dF_x/du right after the reversal at the largest u, where all sticks: count · 2G*a",
    "stiffness_after_minimum_N_m": "the same at the smallest u",
    "secant_after_maximum_N_m": "secant over the first tenth of the displacement range after the largest u, as a measured loop has it",
    "secant_after_minimum_N_m": "the same from the smallest u",
    "regime": "`still` where u moves by no more than can be told from rest, `gross` where F_x comes both ways to the limit of friction, `stick` where A is below 5e-4, else `partial`; but for `still` of a loop under a constant load without damping",
}

columns! { STEPS, "steps.csv",
    "period": "number of the period, from 1",
    "start_s": "time at its start",
    "end_s": "time at its end",
    "length_m": "length of the step: x of the body at the end of the period minus x at its start",
    "x_m": "x at the start of the period",
    "smallest_m": "smallest x within the period, both ends included",
    "largest_m": "largest x within it",
}

columns! { CONTACT_HISTORY, "contact: history.csv",
    "corner": "number of the corner that the leg leads to; 0 at the start",
    "share": "part of the way from the corner before, up to 1",
    "d_m": "d, indentation",
    "u_m": "u, displacement",
    "fn_N": "F_N, normal force (4.26)",
    "fx_N": "F_x, tangential force (4.39)",
    "a_m": "a, contact radius",
    "c_m": "c, stick radius: within it no spring slips",
    "state": "`open`, `stick`, `partial` or `slip`",
    "elastic_J": "elastic energy of the tangential deformation",
    "friction_J": "friction work so far (4.40)",
}

columns! { CONTACT_FIELDS, "contact: fields.csv",
    "corner": "number of the corner",
    "r_m": "r, distance from the axis",
    "pressure_Pa": "p(r) = -(1/π)∫_r^∞ q_z′(x)/√(x² - r²) dx, pressure",
    "shear_Pa": "τ(r), shear stress: the same of q_x (4.25)",
    "displacement_m": "tangential displacement of the surface at r (4.25)",
    "slip_m": "by how much the surface at r lags behind that in the centre: local slip beyond the centre's (in gross slip 0 there) and, where the contact has grown on a slanting way, what the body had moved before r touched",
    "deflection_m": "normal displacement of the surface at r",
    "state": "`stick`, `slip` or `open` at r",
}

columns! { CONTACT_LINE, "contact: line.csv",
    "corner": "number of the corner",
    "x_m": "x, place of the spring in the row, from the middle",
    "length_m": "Δx, the part of the row that it stands for",
    "g_m": "g(x), height of the one-dimensional profile (4.20)",
    "kz_N_m": "E*Δx, normal stiffness (4.21)",
    "kx_N_m": "G*Δx, tangential stiffness (4.21)",
    "qz_N_m": "q_z = E*(d - g), normal line load (4.24)",
    "qx_N_m": "q_x = G*s, tangential line load (4.31)",
    "limit_N_m": "μq_z, what friction bears (4.22)",
    "fz_N": "q_zΔx, normal force of the spring (4.23)",
    "fx_N": "q_xΔx, tangential force of the spring (4.23)",
    "stretch_m": "s, tangential stretch (4.29)",
    "state": "`open`, `stick`, `slip+` or `slip-` (the sense of the force)",
}

columns! { CONTACT_FRICTION, "contact: friction.csv",
    "corner": "number of the corner that the leg leads to",
    "share": "part of the way from the corner before",
    "r_m": "r, distance from the axis",
    "work_J_m2": "friction work per area at r so far, ∫τ·d(slip) (4.41)",
    "slip_path_m": "path slid at r so far",
}

columns! { CONTACT_NORMAL, "contact: normal.csv",
    "d_m": "d, indentation",
    "a_m": "a, contact radius (4.26)",
    "fn_N": "F_N, normal force (4.26)",
    "stiffness_N_m": "2E*a, ∂F_N/∂d",
    "u_c_m": "u_c = κd (4.28)",
}

columns! { CONTACT_UNIVERSAL, "contact: universal.csv",
    "c_a": "c/a, stick radius over contact radius",
    "u_uc": "u/u_c, displacement over that at which gross slip begins",
    "fx_mufn": "F_x/(μF_N) (4.37)",
    "c_m": "c, stick radius (4.27)",
    "u_m": "u, displacement",
    "fx_N": "F_x by superposition: μ[F_N(a) - F_N(c)] (4.38)",
    "fx_by_integral_N": "F_x by the integral of the line load (4.39)",
    "friction_J": "friction work of the loading (4.42)",
}

columns! { VALIDATE, "validate",
    "deviation": "what is held against what is known, in the words of its page",
    "asked: at most": "the largest deviation that counts as kept",
    "found": "the largest, or the root of the mean square where it says rms, of what the program computes",
    "page": "link to the page, with set-up, numbers and limits",
    "reference": "what it is held against: measurement, another program or closed form",
    "case": "which of the cases of the page",
    "program": "what this program computes",
    "known": "the reference's value",
    "formula": "the closed form's value",
    "off by": "how far the program's value lies from that, as a share where a % stands",
}

columns! { BRANCH, "branch.csv",
    "largest_multiplier": "|λ|, modulus of the largest Floquet multiplier",
    "oscillation_periods": "drive periods in which that disturbance oscillates once; none where it does not",
}

columns! { CURVE, "curve.csv",
    "stroke_m": "of `step-amplitude`: stroke of the figures' waveform",
    "amplitude_m": "the same of a sine or a sum of harmonics: its amplitude",
    "frequency_Hz": "of `speed-frequency`: one over the period of the figures' waveform",
    "load_N": "of `force-speed` and `step-load`: load on the figures' body, against its steps",
    "preload_N": "of `preload` and `holding-force`: normal force of the body's contacts, all together",
    "along_x_N": "of `holding-force`: the largest load along +x on the figures' body that the drive holds at rest",
    "along_x_half_width_N": "how far that may be off: half of the bracket in which it lies, and how far a balance is known",
    "along_x_gives_way": "what gives way beyond: a body that slides away, comes loose or, free to pitch, slides or tips over",
    "along_x_fault": "why there is no such force: the drive does not even hold what acts without the load, or something else than friction holds any",
    "against_x_N": "of `holding-force`: the same of loads along -x",
    "against_x_half_width_N": "how far that may be off: half of the bracket in which it lies, and how far a balance is known",
    "against_x_gives_way": "what gives way beyond: a body that slides away, comes loose or, free to pitch, slides or tips over",
    "against_x_fault": "why there is no such force: the drive does not even hold what acts without the load, or something else than friction holds any",
}

columns! { MAP, "map.csv",
    "x": "value of the number along the horizontal axis, SI",
    "y": "value of the number along the vertical axis, SI",
    "result": "the result there: a number in SI, or a word; empty where there is none",
}

columns! { SENSITIVITY, "sensitivity.csv",
    "figure": "name of the figure: a number of summary.json, a channel at the end of the run, or one of steady motion",
    "figure_unit": "its SI unit; empty of a plain number",
    "figure_value": "what it is in the scenario as it stands, by the tolerance of the derivatives",
}
