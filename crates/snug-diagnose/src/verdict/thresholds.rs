//! Thresholds of what is said.
//! Each stands once, with its unit and how it was found: "chosen" is chosen, not measured.

/// Error over noise below which what repeats beside effects that were added is their own \[–\]: the instants at which the grip
/// sets in are never quite right. Chosen.
pub(crate) const BESIDE_EFFECTS: f64 = 1.05;
/// Share of the misfit that must repeat before it is called an effect \[–\]. Chosen.
pub(crate) const REPEATS: f64 = 0.2;
/// z that the largest of the family exceeds by chance in about 5 % of campaigns. Of 40 candidates: 40 · P(z > 3) = 0.054.
pub(crate) const FAMILY_Z: f64 = 3.0;
/// Normal quantile of 95 % power.
pub(crate) const POWER_Z: f64 = 1.645;
/// Tightenings at hand from which the new ones are made. Chosen.
pub(crate) const PATTERNS: usize = 6;
/// Squared distance over noise that tells two models apart with 95 % power at 95 % confidence: (2 · (1.645 + 1.96))².
pub(crate) const TELLING: f64 = 52.0;

/// More tightenings than anybody makes to tell two effects apart; chosen, not measured.
pub(crate) const MOST_TIGHTENINGS: usize = 10_000;
/// Least share of the fitted output's power about its mean that a model must explain before anything is said of effects \[–\]:
/// less than half, and most of what happens is something else. Chosen.
pub(crate) const LEAST_EXPLAINED: f64 = 0.5;
/// The same below which it is not called adequate where what it leaves is a motion and no noise \[–\]. Chosen: two motors that turn one
/// way are explained to 78 %, turned both ways to 94 %.
pub(crate) const MOSTLY_EXPLAINED: f64 = 0.9;
/// The same where it took several effects \[–\]. Chosen: of four made-up rigs whose missing effect the catalogue does
/// not have, others explained 99.0 to 99.84 % in its place; where they were the right ones, 99.95 % and more.
pub(crate) const ALL_BUT_EXPLAINED: f64 = 0.999;
/// By how much less than m, c, k alone, where the spectra put them, a model may explain and still be called adequate \[–\].
/// Chosen.
pub(crate) const SHORTFALL: f64 = 0.05;
/// By how much more m, c, k must explain with a sign, a column or a derivative changed before that is suspected \[–\]. Chosen.
pub(crate) const FAR_BETTER: f64 = 0.2;
/// Share of the measured acceleration's power that a regression must explain before a simulated fit that falls short of it is called
/// failed \[–\]: where an effect is missing from both, they may well part (the base model of a motor with friction: 0.26 promised, less
/// than nothing kept). Chosen.
pub(crate) const PLAIN_PROMISE: f64 = 0.95;
/// Times as much of that power as a regression leaves, that one without a negative stiffness must leave, before a rig is said to push itself
/// away \[–\]: where friction or an offset is missing from both, the stiffness may come out a little below 0. Chosen.
pub(crate) const NEEDS_IT: f64 = 4.0;
/// The same where the square and the cube of the angle are beside it \[–\], with which play of any width leaves up to 3.4 times as much. Chosen.
pub(crate) const NEEDS_IT_BESIDE_LAWS: f64 = 10.0;
/// Share of an output's root mean square below which it is near 0 \[–\]. Chosen.
pub(crate) const NEAR_ZERO: f64 = 0.15;
/// How many times the error of any other a recording must leave to stand apart from them \[–\], ... Chosen: recordings of one rig that
/// are driven alike leave within a factor of two of one another.
pub(crate) const APART: f64 = 5.0;
/// ... and which share of what there is to explain in it \[–\]: less is a good model of it all the same. Chosen.
pub(crate) const APART_SHARE: f64 = 0.01;
/// How much smoother an output must be with its sign changed where it turns about near 0 \[–\], ... Chosen.
pub(crate) const SMOOTHER: f64 = 10.0;
/// ... and at how many places of all recordings, for it to have lost its sign: one turns about like that by chance. Chosen.
pub(crate) const TURNS: usize = 5;
/// Share of what a stiffness below 0 leaves of the measured acceleration, below which the sine of the angle tells a weight on an arm \[–\].
/// Chosen.
pub(crate) const IS_A_WEIGHT: f64 = 0.5;
/// Times in which a rig falls away to e times as far that may pass from one restart to the next \[–\]. Chosen: with 1, which is advised, the
/// limit of a magnet's amplifier was found to half a per cent, with 1.6 the friction of an armature, with 2.3 the limit six per cent too high and
/// two lags with it that there were not.
pub(crate) const FALLEN_AWAY: f64 = 2.0;
/// Least change from beginning to end of the recordings, over the larger of both, that is told as one \[–\]. Chosen: what a bearing that warms
/// up loses in a minute.
pub(crate) const CHANGES: f64 = 0.1;
/// How often the averages in which a change is looked for are made twice as wide. Chosen: noise in an acceleration falls by a factor of 30
/// each time.
pub(crate) const WIDER: usize = 2;
/// Share of what a plain regression with the study's own model leaves that a change must take for nothing else to be looked for \[–\]. Chosen:
/// of rigs that lack nothing else it takes 95 to 99 %, 85 where a friction falls off ever slower; of one that lacks a cubic spring, too, 1.
pub(crate) const ABOVE_ALL: f64 = 0.9;
/// Factor between two files' masses, dampings and stiffnesses that is one of units, or of another load \[–\]: people differ tenfold.
/// Chosen.
pub(crate) const NO_RIG_DIFFERS: f64 = 100.0;
/// The same that is more than any two units that are mixed up \[–\]: one of the two was not determined at all. Chosen: a million, and as
/// much again as people differ.
pub(crate) const NO_UNIT_DIFFERS: f64 = 1e7;
/// Factor within which those of two sizes are the same \[–\]: a bearing that is warm damps half as much. Chosen.
pub(crate) const SAME_FACTOR: f64 = 3.0;
/// What a unit's prefix changes numbers by \[–\]: milli and micro, of torque, motion or time.
pub(crate) const UNIT_PREFIXES: [f64; 2] = [1e3, 1e6];
/// Share of a group's tightenings that must stand that far apart from as many of another's \[–\]: one that is fitted badly is no unit.
/// Chosen.
pub(crate) const THREE_QUARTERS: f64 = 0.75;
/// Whole tightenings from which a file or a person is judged by them: one is fitted badly at times. Chosen.
pub(crate) const FEWEST_OF_GROUP: usize = 2;
/// Share of all samples \[–\] ... Chosen.
pub(crate) const FEW_SAMPLES: f64 = 0.01;
/// ... that hold more than this share of the squared error where spikes or dropouts do: those of a normal distribution hold 0.08, of one
/// with tails as heavy as t of three degrees 0.3. Chosen.
pub(crate) const MOST_IN_FEW: f64 = 0.6;
