//! The crate against certified values, closed forms and other programs.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod assumptions;
mod clustered;
mod invariance;
mod mixed_model_exact;
mod nist_anova;
mod permutation;
mod reference;
mod samples;
mod size_of_tests;
mod soundness;
mod tails;
