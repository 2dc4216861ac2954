//! Thresholds of where a model fails: bins, what is beyond the noise, and what is worth a sentence.
//! Each stands once, with its unit and how it was found: "chosen" is chosen, not measured.

/// Excess over the noise beyond which it is not chance \[standard deviations\]: 0.1 % one-sided. Chosen.
pub(crate) const BEYOND_CHANCE: f64 = 3.0;
/// A noise floor is not known better than this; a smaller excess in root mean square means nothing \[–\]. Chosen.
pub(crate) const SMALLEST_EXCESS: f64 = 0.005;
/// Campaigns drawn: 2.5 % of them are a dozen on each side. Chosen.
pub(crate) const CAMPAIGNS: usize = 499;
/// Fewer tightenings say nothing about their scatter. Chosen.
pub(crate) const FEWEST: usize = 3;
/// Width of a bin over time \[s\]. Chosen.
pub(crate) const WIDTH_S: f64 = 0.02;
/// Windows longer than this get wider bins \[bins\]. Chosen.
pub(crate) const MOST_TIME_BINS: f64 = 40.0;
/// Most over the angle \[bins\]. Chosen.
pub(crate) const MOST_AMPLITUDE_BINS: f64 = 10.0;
/// Width of the narrowest band \[frequencies\]. Chosen.
pub(crate) const NARROWEST: f64 = 1.5;
/// Positions this little below an edge are meant to be on it \[bins\]. Chosen.
pub(crate) const EDGE: f64 = 1e-6;
/// Bins of the missing force over time. Chosen.
pub(crate) const TIME_BINS: usize = 60;
/// Share of the shortest window up to which a residual is correlated with what comes later \[–\]: beyond, few products are left. Chosen.
pub(crate) const CORRELATED_SHARE: f64 = 0.3;
/// Steps from a lag of one sample to the longest, each longer than the one before by the same factor. Chosen.
pub(crate) const CORRELATION_LAGS: usize = 60;
/// Coherence \[–\] of the last frequency at which a response is told: half of the motion's power follows from the torque. Chosen.
pub(crate) const COHERENT: f64 = 0.5;
/// Overlapping stretches into which records without an onset are cut, all together at least: as is usual (Welch). Chosen.
pub(crate) const STRETCHES: usize = 8;
/// Bins of the missing force's map along x, and along v. Chosen.
pub(crate) const MAP_BINS: usize = 16;
/// A pulse lasts while the torque is above this share of its peak \[–\]. Chosen.
pub(crate) const PULSE: f64 = 0.1;
/// Length of a bin of the mean residual \[s\]. Chosen.
pub(crate) const BIN_S: f64 = 0.005;
/// From this many files on, a tightening's own file predicts nothing for it. Chosen.
pub(crate) const ENOUGH_FILES: usize = 3;
/// From this many others under the same conditions on, only they predict \[tightenings\]. Chosen.
pub(crate) const ENOUGH_ALIKE: f64 = 2.0;
/// Speed below which friction fades \[m/s\]. Chosen.
pub(crate) const FADING_M_PER_S: f64 = 0.01;
/// Directions this much shorter than they were are in the span of the others \[–\]. Chosen.
pub(crate) const SPANNED: f64 = 1e-9;
/// Share of a shape that the others do not already say, below which it says nothing \[–\]. Chosen.
pub(crate) const NO_NEWS: f64 = 1e-4;
/// Fewer show no drift \[degrees of freedom\]. Chosen.
pub(crate) const FEWEST_FREEDOM: f64 = 3.0;
/// Farther off their group's median estimates are not of this population \[robust standard deviations\]. Chosen.
pub(crate) const FARTHEST: f64 = 5.0;
/// A covariate whose spread is below this share of its size does not vary \[–\]. Chosen.
pub(crate) const CONSTANT: f64 = 1e-9;
/// Share of the misfit that counts as most of it \[–\]. Chosen.
pub(crate) const MOST: f64 = 0.6;
/// Share of the misfit from which on a shape of the force is told \[–\]. Chosen.
pub(crate) const RESEMBLES: f64 = 0.5;
/// Share of the misfit from which on the force is said to have that shape \[–\]. Chosen.
pub(crate) const FOLLOWS: f64 = 0.8;
/// A part with less of the misfit is not worth a sentence \[–\]. Chosen.
pub(crate) const WORTH: f64 = 0.2;
/// Share of the misfit over share of the data that is more than its due \[–\]. Chosen.
pub(crate) const MORE_THAN_DUE: f64 = 1.5;
/// Errors over noise up to this are told as nothing but noise \[–\]. Chosen.
pub(crate) const QUIET: f64 = 1.05;
/// Share of the misfit that repeats above which that is said \[–\]. Chosen.
pub(crate) const MOSTLY_REPEATS: f64 = 0.7;
/// Share of the misfit that repeats below which that is said \[–\]. Chosen.
pub(crate) const HARDLY_REPEATS: f64 = 0.25;
/// Shapes of the missing force whose shares differ by less are told together \[–\]. Chosen.
pub(crate) const NEARLY_AS_WELL: f64 = 0.1;
/// Lines of a spectrum on each side of a tone that it lies within: as far as the window's edges spread it. Chosen.
pub(crate) const LINES: usize = 2;
/// Fewest cycles in a recording that make a tone: two lines are a band of a twenty-fifth of its frequency then. Chosen.
pub(crate) const FEWEST_CYCLES: f64 = 50.0;
/// Parts of a recording in which a tone is as loud. Chosen.
pub(crate) const QUARTERS: usize = 4;
/// Standard deviation over mean of a tone's loudness \[–\]: of a lightly damped mode under chance forces it is 0.5 (Rayleigh). Chosen.
pub(crate) const AS_LOUD: f64 = 0.25;
/// Lines on each side of one of the input's that it is compared with. Chosen.
pub(crate) const SURROUNDINGS: usize = 20;
/// Power over the median about it from which a line of the input stands out \[–\]: of three lines of chance one does in one case of 300. Chosen.
pub(crate) const OUTSTANDING: f64 = 10.0;
/// Share of the input's power up to which a line of the mains may not drive the rig \[–\], ... Chosen.
pub(crate) const FAINT: f64 = 0.01;
/// ... where within this share of its frequency \[–\] ... Chosen.
pub(crate) const NEAR: f64 = 0.1;
/// ... no other has as much of its power \[–\]: of two hundred lines of a multisine each has half a hundredth of all. Chosen.
pub(crate) const AS_LOUD_AS_IT: f64 = 0.1;
