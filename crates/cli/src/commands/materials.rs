//! `stickslip materials`: table of named materials.

use stickslip_console::answer::say;
use stickslip_console::verdict::Verdict;
use stickslip_scenario::MATERIALS;

/// Prints one material per line.
pub(crate) fn list() -> Verdict {
    say(format_args!("{:<14} {:>7}  {:>5}  source", "name", "E, GPa", "nu"));
    for material in MATERIALS {
        let (modulus, ratio) = (material.youngs_modulus / 1e9, material.poisson_ratio);
        say(format_args!("{:<14} {modulus:>7}  {ratio:>5.2}  {}", material.name, material.source));
    }
    Verdict::Done
}
