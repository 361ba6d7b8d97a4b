//! Natural scales: one tolerance suits every scene because errors are measured against these.

use super::{Contact, Free, Link, Place};
use crate::Waveform;

/// Sets the scales of contacts and free coordinates: u_c, and the velocities it makes with the stuck stiffness.
///
/// `deepest` is the largest indentation of each contact.
pub(super) fn assign(
    contacts: &mut [Contact],
    free: &mut [Free],
    links: &[Link],
    waveforms: &[Waveform],
    deepest: &[f64],
) {
    let mut springs = vec![(0.0, f64::INFINITY); free.len()];
    let mut add = |place: Place, stiffness: f64, length: f64| {
        if let Place::Free(i) = place {
            springs[i].0 += stiffness;
            springs[i].1 = springs[i].1.min(if length > 0.0 { length } else { f64::INFINITY });
        }
    };
    for (c, &d) in contacts.iter().zip(deepest) {
        for place in [c.first, c.second] {
            add(place, c.count * c.law.stick_stiffness(d), c.law.gross_slip_displacement(d));
        }
    }
    for link in links {
        add(link.first, link.stiffness, 0.0);
        add(link.second, link.stiffness, 0.0);
    }
    let (stroke, slow) = slowest(waveforms);
    // With high friction u_c lies far above anything that moves.
    let widest = waveforms.iter().map(|w| w.range().1 - w.range().0).fold(0.0, f64::max);
    let reach = if widest > 0.0 { widest } else { f64::INFINITY };
    let mut frequency = vec![slow; free.len()];
    for (i, f) in free.iter_mut().enumerate() {
        let (stiffness, length) = springs[i];
        let length = if length.is_finite() { length.min(reach) } else { stroke };
        if stiffness > 0.0 {
            frequency[i] = (stiffness / f.mass).sqrt();
        }
        f.scale = (length, length * frequency[i]);
    }
    for (c, &d) in contacts.iter_mut().zip(deepest) {
        let fastest = [c.first, c.second].into_iter().fold(0.0_f64, |fastest, place| match place {
            Place::Free(i) => fastest.max(frequency[i]),
            Place::Held(_) | Place::Driven(_) => fastest,
        });
        c.natural = (c.law.gross_slip_displacement(d), if fastest > 0.0 { fastest } else { slow });
    }
}

/// Smallest stroke (m; 1 µm without any) and highest angular frequency (rad/s; 1 without any) of the waveforms.
fn slowest(waveforms: &[Waveform]) -> (f64, f64) {
    let spans = waveforms.iter().map(|w| w.range().1 - w.range().0).filter(|span| *span > 0.0);
    let stroke = spans.fold(f64::INFINITY, f64::min);
    let period = waveforms.iter().filter_map(Waveform::period).fold(f64::INFINITY, f64::min);
    (
        if stroke.is_finite() { stroke } else { 1e-6 },
        if period.is_finite() { std::f64::consts::TAU / period } else { 1.0 },
    )
}
