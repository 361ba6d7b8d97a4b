//! Many runs of one scene: variants side by side, steady motion found directly, the curves of a machine.
//!
//! Knows no terminal and draws nothing, so that any door can stand on it. What it computes does not depend on the number of
//! threads.
//!
//! In reading order: [`steady`], the motion that repeats itself every period, and how it comes back when it is disturbed.

pub mod steady;
