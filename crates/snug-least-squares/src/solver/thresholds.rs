//! Thresholds of single fits; when a fit rests because it stalls stands with its type in `stall`. Damping is relative to the scaled
//! curvature.
//! Each stands once, with its unit and how it was found: "chosen" is chosen, not measured.

/// Share of the cost below which a decrease, predicted or found, drowns in its rounding \[–\]: some thousand roundings.
pub(crate) const RESOLUTION: f64 = 1e-13;
/// Share of the predicted decrease that a step must keep to be accepted \[–\]. Chosen, as is usual (Nocedal & Wright).
pub(crate) const SUFFICIENT: f64 = 1e-4;
/// Damping at which no parameter moves any more \[–\]. Chosen.
pub(crate) const MOST_DAMPING: f64 = 1e30;
/// Where damping that was as good as none begins to grow again \[–\]. Chosen.
pub(crate) const FIRST_DAMPING: f64 = 1e-12;
/// Damping below this cannot be told from none \[–\]. Chosen.
pub(crate) const NO_DAMPING: f64 = 1e-22;
/// Below this much damping a step is as good as undamped for the optimality tests \[–\]. Chosen.
pub(crate) const LITTLE_DAMPING: f64 = 1e-9;
/// Part of the damping that a step goes on with when less of it would have shown more to gain \[–\]. Chosen.
pub(crate) const LESS_DAMPING: f64 = 1e-3;
/// Gain beyond which the model is good enough to relax much \[–\]. Chosen.
pub(crate) const GOOD_GAIN: f64 = 0.9;
/// Factor of the damping then \[–\]. Chosen.
pub(crate) const GOOD_RELIEF: f64 = 0.05;
/// The smallest factor otherwise \[–\]. Chosen.
pub(crate) const LEAST_RELIEF: f64 = 0.2;
/// Steps taken on trust, because the cost cannot resolve them, before the fit rests. Chosen.
pub(crate) const TRUSTED_STEPS: usize = 20;
/// A fit crawls when a step leaves more than this share of what the one before had left \[–\]; near a smooth optimum steps leave
/// far less. Chosen.
pub(crate) const CRAWL: f64 = 0.1;
/// Relative change of the parameters accepted when rounding forbids a smaller one \[–\]. Chosen.
pub(crate) const ROUGH_TOLERANCE: f64 = 1e-5;
/// Steps after which the scale of the parameters no longer remembers the start: the way to the optimum may lead through a
/// valley where they matter a thousand times less than there. Chosen.
pub(crate) const LONG_FIT: usize = 400;
/// Share of its scale that a parameter keeps per step then \[–\]. Chosen.
pub(crate) const SHORT_MEMORY: f64 = 0.5;
/// Share of a vector's length below which what is orthogonal to others is rounding \[–\]. Chosen.
pub(crate) const DEPENDENT: f64 = 1e-9;
/// Largest acceleration a step may have, relative to its length \[–\] (Transtrum & Sethna: 2‖a‖ ≤ 0.75 ‖d‖).
pub(crate) const LARGEST_ACCELERATION: f64 = 0.375;
/// Share of the cost by which an end that is no optimum must lie lower to be more useful than one that is \[–\]: a hundredth is
/// far more than chance, and such an optimum is not the lowest minimum. Chosen.
pub(crate) const CLEARLY_LOWER: f64 = 0.01;
