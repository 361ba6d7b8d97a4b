//! Many runs of one scene: variants side by side, steady motion found directly, the curves of a machine.
//!
//! Knows no terminal and draws nothing, so that any door can stand on it. What it computes does not depend on the number of
//! threads.
