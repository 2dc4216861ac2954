//! Thresholds of how tightenings are cut and simulated side by side.
//! Each stands once, with its unit and how it was found: "chosen" is chosen, not measured.

/// Fewer tightenings than this are cut into stretches. Chosen.
pub(crate) const FEWEST_WHOLE: usize = 8;
/// Samples from which on a window is no tightening but a long record \[samples\], which is cut however many there are: a tightening has
/// some hundred. Chosen.
pub(crate) const LONG_RECORD: usize = 5000;
/// Stretches wanted where tightenings are cut. Chosen.
pub(crate) const STRETCHES_WANTED: usize = 24;
/// Shortest stretch \[samples\]. Chosen.
pub(crate) const SHORTEST_STRETCH: usize = 40;
/// Tightenings that are simulated together, as many as the widest vector registers hold. One group comes after the other, and
/// threads share out each, which bounds the memory: a thread that waits in one group would begin another.
pub(crate) const SIMULATED_TOGETHER: usize = 8;
/// Columns of a score up to which groups are worked on side by side: so few do not keep every processor at work, and take little memory
/// in each group. Chosen: an effect has no more.
pub(crate) const FEW_COLUMNS: usize = 4;
