//! Eigenvalues of the states of blocks.
//!
//! A block reads earlier blocks only, so each block alone determines its eigenvalues. Forces of blocks on bodies are neglected.

use super::eigenvalues as all;
use crate::component::{Block, Moment, Standing};
use crate::model::MOST_OF_A_BLOCK;
use crate::{Model, Sample};
use nalgebra::{Complex, ComplexField, DMatrix};

impl Model {
    /// Returns the nonzero eigenvalues of the states of all blocks, 1/s.
    pub(super) fn block_eigenvalues(&self) -> Vec<Complex<f64>> {
        let signals = self.signals();
        let with_states = self.blocks.iter().filter(|wired| wired.count() > 0);
        let of = with_states.flat_map(|wired| wired.block().eigenvalues(&signals.first_inputs(wired)));
        of.map(|(re, im)| Complex { re, im }).filter(|rate| rate.modulus() > 0.0).collect()
    }
}

/// Returns the eigenvalues of the Jacobian of a block's slopes at the start, for given inputs, 1/s.
pub(crate) fn eigenvalues(block: &(impl Block + ?Sized), inputs: &[Sample]) -> Vec<(f64, f64)> {
    let scales = block.states().scales;
    let (start, memory) = block.start(inputs);
    let slopes = |states: &[f64]| {
        let mut slopes = vec![0.0; scales.len()];
        let at = Moment { t: 0.0, inputs, states, located: true };
        // Efforts are ignored.
        block.slopes(Standing { law: &0, memory: &memory }, &at, &mut slopes, &mut [0.0; MOST_OF_A_BLOCK]);
        slopes
    };
    let first = slopes(&start);
    let n = scales.len();
    let mut gradient = DMatrix::zeros(n, n);
    // Scaling by natural scales gives entries of similar size, for accurate eigenvalues.
    for (j, scale) in scales.iter().enumerate() {
        let mut moved = start.clone();
        moved[j] += scale;
        for (i, (slope, rest)) in slopes(&moved).iter().zip(&first).enumerate() {
            gradient[(i, j)] = (slope - rest) / scales[i];
        }
    }
    all(gradient).iter().map(|rate| (rate.re, rate.im)).collect()
}
