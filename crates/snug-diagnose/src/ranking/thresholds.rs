//! Thresholds of the ranking: scores, refits of candidates, and what is chance.
//! Each stands once, with its unit and how it was found: "chosen" is chosen, not measured.

use snug_least_squares::PooledSettings;

/// Squared share of a signal below which what is new in it is rounding \[–\]: 10⁻¹⁰ of its length. Chosen.
pub(crate) const ROUNDING: f64 = 1e-20;
/// Squared residuals, in units of the noise's variance, below which a cluster's difference is within chance. Chosen.
pub(crate) const CHANCE: f64 = 4.0;
/// How many times stricter the chance of a gain is judged, so that the score remains what decides as a rule. Chosen.
pub(crate) const STRICTER: usize = 10;
/// Share of what stretches that took no part leave \[–\] beyond which a gain in them is judged as it is: no score sees a wave whose length
/// is read off the data. Chosen: a ripple took 92 % of what eight recordings left, by a chance of 0.06 were it judged as others.
pub(crate) const MOST_OF_ALL: f64 = 0.5;
/// Shapes among which one is read off the data, as good as independent of each other: a wavelength or a resonance. Chosen; a
/// pendulum that lacks gravity had a mode of 1 in 29 beside it.
pub(crate) const SHAPES_TRIED: f64 = 8.0;
/// Candidates that are followed to the end: one of them is what is missing, if anything is. Chosen.
pub(crate) const BEST: usize = 3;
/// The same of records that take long to simulate, where the others have taken a few steps only. Chosen.
pub(crate) const BEST_OF_LONG: usize = 6;
/// Pairs of effects that are tried where none is justified alone. Chosen.
pub(crate) const PAIRS: usize = 6;
/// How many times as much as the better of them alone two must promise together to be tried \[–\]. Chosen.
pub(crate) const BEYOND_BOTH: f64 = 1.5;
/// Share of its own power \[–\] that a signature must keep beside another for both to be two. Chosen.
pub(crate) const UNLIKE: f64 = 1e-3;
/// Factors, the most promising, by which the size of one effect is tried to differ. Chosen.
pub(crate) const GROUPINGS_TRIED: usize = 2;
/// Tightenings at least before and after a change of a size. Chosen: one or two are an exception, not a change.
pub(crate) const FEWEST_BESIDE_A_CHANGE: usize = 3;
/// Standard deviations of a group's mean squared residual, by how its tightenings scatter, by which it must lie above that of the group
/// that leaves least for an effect to show in it: the least of six lies 1.3 below their mean, the largest as much above. Chosen; with
/// 0.03 of the noise in its place two who had nothing were asked beside the one whose grip had play, which was not found then.
pub(crate) const BEYOND_THE_QUIET: f64 = 4.5;
/// Standard deviations, of the mean squared residuals of those that are left at the noise, by which that of a tightening must lie above
/// their mean for it not to be one of them. Chosen: one in a thousand does by chance.
pub(crate) const BEYOND_QUIET_ONES: f64 = 3.0;
/// Tightenings in which it must show for an effect to be looked for in them alone. Chosen.
pub(crate) const FEWEST_WHERE_IT_SHOWS: usize = 4;
/// Candidates, the best, whose sizes are tried to differ between groups. Chosen.
pub(crate) const BEST_BY_GROUP: usize = 6;
/// Standard deviations of the held-out gain from which sizes are said to differ: about 95 %.
pub(crate) const CLEARLY: f64 = 2.0;
/// Squared residual over the noise by which a change in time must beat groups of a condition: χ² of one degree of freedom, chance one
/// in a thousand.
pub(crate) const LIKELIER: f64 = 10.83;
/// Sign flips behind a p in the negative control: a p of 0.05 is then the tenth of 200. Chosen.
pub(crate) const CONTROL_FLIPS: usize = 199;
/// Samples on either side over which the torque is averaged for the signatures. Chosen.
pub(crate) const NOISE_REACH: usize = 5;
/// Samples on either side over which the signatures themselves are averaged. A model without a gap in the grip knows the
/// instant at which the grip crosses it to a millisecond only, and there the acceleration jumps. Chosen; with it, and
/// refits that come nearer step by step, a gap of 14 µm is named and 1.016 times the noise is left in place of 1.121.
pub(crate) const INSTANT_REACH: usize = 10;
/// When the refit of a candidate stops: its gain is then known to a fraction of what chance does. An effect that is not
/// there leaves its timing undetermined, and a strict fit would follow that for long. Chosen.
pub(crate) const CANDIDATE: PooledSettings = PooledSettings {
    max_iterations: 40,
    cost_tolerance: 1e-6,
};
/// The same of records that take long: which effect comes in is known by then, and that one is fitted to the end. Chosen; a mode that is
/// not there took 19 s of Silverbox.
pub(crate) const CANDIDATE_OF_LONG: PooledSettings = PooledSettings {
    max_iterations: 15,
    cost_tolerance: 1e-5,
};
/// Where nothing of an effect lies beyond its limits, its value at the limit is tried, and this share of it \[–\], ... Chosen.
pub(crate) const FARTHER: f64 = 0.1;
/// ... each with the other parameters at their limits and between, for so many steps. Chosen.
pub(crate) const GLANCE: PooledSettings = PooledSettings {
    max_iterations: 2,
    cost_tolerance: 1e-2,
};
/// When a fit to a few tightenings stops. Chosen.
pub(crate) const ROUGH_REFIT: PooledSettings = PooledSettings {
    max_iterations: 20,
    cost_tolerance: 1e-4,
};
/// Tightenings on which starts are tried. Chosen.
pub(crate) const FEW: usize = 8;
/// Starts, the most promising, that are tried freely, whatever the measured motion says. Chosen.
pub(crate) const FREELY: usize = 2;
/// When a fit along the measured motion stops: a place to go on from is all it has to be. Chosen.
pub(crate) const LED: PooledSettings = PooledSettings {
    max_iterations: 12,
    cost_tolerance: 1e-3,
};
/// Samples to either side over which residuals are averaged where starts are led along the measured motion. Chosen.
pub(crate) const LED_REACH: usize = 8;
/// Root mean square of a tightening's residual, and what it kept of it, over the median of all \[–\] from which it is left behind:
/// it ended in a minimum of its own, where the others found theirs. Chosen.
pub(crate) const LEFT_BEHIND: f64 = 1.15;
/// Share of the cost that is not worth fetching them for \[–\]: a wrong model leaves behind whom it explains worst. Chosen.
pub(crate) const LITTLE: f64 = 1e-3;
/// Times that those who were left behind are fetched: with them the shared sizes move, and others may see the way. Chosen.
pub(crate) const MOST_ROUNDS: usize = 3;
/// Turns, from the smallest angle to the largest, up to which a weight on an arm is told by its angle \[–\]: over more it is a ripple of
/// one turn, and gearing as likely as gravity; of a wheel that coasts to a stop it stood in for what air and bearing do. Chosen.
pub(crate) const FEW_TURNS: f64 = 5.0;
/// Samples to either side over which balances of torques are averaged to read off wavelengths: the shortest does not average
/// out what comes fast, the longest takes most noise off a second derivative. Chosen.
pub(crate) const HALF_WIDTHS_OF_BALANCE: [usize; 4] = [3, 9, 27, 81];
/// Places of all tightenings together at which that balance is drawn up. Chosen.
pub(crate) const SAMPLES_OF_BALANCE: usize = 6000;
/// Samples of all tightenings together of whose output a force is read off. Chosen.
pub(crate) const SAMPLES_OF_RESPONSE: usize = 12_000;
/// Wavelengths that are tried, at most, the longest first. Chosen.
pub(crate) const WAVELENGTHS: usize = 2000;
/// Steps of the wave number while one more wave fits into the way: a peak is about two of half waves wide \[–\]. Chosen.
pub(crate) const PER_WAVE: f64 = 5.0;
/// Parts of such a step in which the place of a peak is looked up. Chosen.
pub(crate) const FINER: usize = 8;
/// Wavelengths that are read off, the most promising. Chosen.
pub(crate) const PEAKS: usize = 3;
/// Parts of a wave between which its force is taken as straight, where wavelengths are read off. Chosen.
pub(crate) const PARTS_OF_A_WAVE: usize = 128;
/// Frequencies, spaced evenly in their logarithm, at which a further resonance is looked for. Chosen.
pub(crate) const RESONANCES: usize = 600;
/// Damping ratios with which it is looked for \[–\]. Chosen.
pub(crate) const DAMPING_RATIOS: [f64; 3] = [0.005, 0.03, 0.15];
/// Lines of the spectra that are looked at, from the lowest on. Chosen.
pub(crate) const LINES: usize = 20_000;
/// Ratio of two frequencies from which they are two resonances to begin with \[–\]. Chosen.
pub(crate) const APART: f64 = 1.1;
/// Samples of all records from which the first ranking is made, whole records, one at least. Chosen.
pub(crate) const MOST_OF_FIRST_RANKING: usize = 60_000;
/// Shapes of an effect that are looked at there. Chosen.
pub(crate) const MOST_SHAPES: usize = 12;
/// Share of the damper's work that it keeps where dry friction is begun with in its place \[–\]. Chosen: of a valve that friction holds still half
/// of the time (250 N of 900 N), a model without it has fifteen times the damping.
pub(crate) const DAMPER_LEFT: f64 = 0.1;
/// Share of the equation error from which the sizes that take it are one more start of a refit \[–\]. Chosen.
pub(crate) const WORTH_A_START: f64 = 0.05;
/// Effects, of those that promise most, with which a model is run freely before it is restarted. Chosen.
pub(crate) const RUN_FREELY: usize = 3;
/// c h/m with which a model with effects begins at most \[–\]: half of the 2.79 from which the classical method of Runge and Kutta grows
/// without bounds (Hairer and Wanner 1996), and a step decays to 0.28 where 0.25 would be exact.
pub(crate) const DECAYS_OF_A_STEP: f64 = 1.4;
/// h √(k/m) with which it begins at most \[–\]: half of the 2.83 from which the same grows without bounds.
pub(crate) const RADIANS_OF_A_STEP: f64 = 1.4;
/// Times as much squared error as a model leaves, from which on it misses an effect without which that is left, though the interval of its
/// size holds nothing \[–\]: an interval knows of no bound. Beside a stiffness that may not be below 0 the weight of an upright pendulum
/// may be anything by its interval, and without it 16 to 60 times as much was left. Chosen.
pub(crate) const PLAINLY_MISSED: f64 = 4.0;
/// Share of the output's power that a model leaves of long records below which it is not asked whether it has been led astray \[–\]. Chosen;
/// with it Silverbox takes nine tenths of the time, a ripple of it a fourth.
pub(crate) const NEARLY_NONE: f64 = 0.001;
