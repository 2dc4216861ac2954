//! How large a sample has to be; every number without a unit unless it says one.

/// Standard normal z that an effect must reach to be supported: of a family of some 40 effects the largest z by chance exceeds 3.0 once
/// in twenty, as `improve` counts it.
pub const FAMILY_Z: f64 = 3.0;

/// How strong an effect is that must not be missed: what it takes from one tightening that has it, in standard deviations of what
/// chance does there. Chosen: weaker ones a person would not feel.
pub const SHOWN_SD: f64 = 1.0;

/// Rows of one tool in one part of the time: two, so that what differs between them shows.
pub const EACH: usize = 2;

/// Share of a sample that is taken where the model at first leaves more than elsewhere, if it does somewhere. Chosen: as many as of all
/// others, which say what is usual.
pub const WHERE_IT_SHOWS: f64 = 0.5;

/// What is taken off every day's distance from the usual before it is added up: half of a shift of two standard deviations (Page 1954).
pub const ALLOWANCE_SD: f64 = 1.0;

/// Sum of these from which a run of days stands out: by chance exp(-2 · 1 · 10), 2 in 10^9 (Wald), begins such a run on a day.
pub const DECISION_SD: f64 = 10.0;

/// Most that one day counts: two at least make a run.
pub const CLIPPED_SD: f64 = 8.0;

/// Fewest rows of a sample. Chosen: with fewer `improve` cuts tightenings into stretches.
pub const FEWEST: usize = 24;

/// Most rows of a sample: what is ranked in a few minutes on two cores. Chosen.
pub const MOST: usize = 2000;
