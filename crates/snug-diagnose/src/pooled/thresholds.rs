//! Thresholds of fits to all tightenings together.
//! Each stands once, with its unit and how it was found: "chosen" is chosen, not measured.

use snug_least_squares::PooledSettings;

/// Share of a parameter's size beside other effects that is hardly anything \[–\]. Chosen.
pub(crate) const HARDLY: f64 = 0.1;
/// Share of the groups said to have an effect that may be without it \[–\]. Chosen: with the usual 0.05 people who had nothing of an
/// effect were named beside those who had in 3 of 24 drawn campaigns; five standard errors lie far beyond either.
pub const FALSE_DISCOVERIES: f64 = 0.005;
/// Growth of the squared residual, over its mean, up to which a change may also lie elsewhere \[–\]: −2 ln(1 − √0.95), the 95 %
/// interval of a place from which a size is another (Siegmund 1988).
pub(crate) const CHANGE_POINT: f64 = 7.35;
/// Error over noise (root mean square) below which nothing but noise is left to look for \[–\]. Chosen.
pub(crate) const AT_FLOOR: f64 = 1.02;
/// Share of the squared error with one mass, damping and stiffness for all recordings that is left where each has its own, below
/// which they are not of one machine in one state \[–\]. Chosen: four tests of a motor that lacks friction leave 0.86, torque steps of
/// a rig that turns harder one way than the other 0.36.
pub(crate) const ONE_MACHINE: f64 = 0.6;
/// Squared error, over the output's about its mean, below which it is rounding and nothing of the rig \[–\]: an error of 10⁻⁷ of the motion,
/// where a converter of 24 bits resolves no better than 0.6 · 10⁻⁷ of its range. Chosen.
pub const ROUNDING: f64 = 1e-14;
/// Mean squared residual, without what the torque's noise makes of it and in units of the noise's variance, that is the noise and a
/// little: half as much beyond the noise as `AT_FLOOR`, which is of the root mean square. Chosen.
pub(crate) const NOISE_AND_A_LITTLE: f64 = 1.02;
/// Samples of all records together up to which they are soon simulated. Chosen.
pub(crate) const SOON: usize = 30_000;
/// Share of a record's squared output that its beginning holds, where records take long to simulate \[–\]. Chosen; with it
/// Silverbox takes three fifths of the time.
pub(crate) const BEGINNING: f64 = 0.125;
/// Fewest scored samples of a beginning. Chosen.
pub(crate) const SHORTEST_BEGINNING: usize = 1000;
/// Parts of a record of which the first is fitted, one after the other, before the whole is \[–\]. Chosen.
pub(crate) const GROWN: [usize; 4] = [16, 8, 4, 2];
/// Fewest scored samples of such a part. Chosen.
pub(crate) const SHORTEST_GROWN: usize = 100;
/// When the trial of one start on a long record stops. Chosen.
pub(crate) const TRIAL_OF_A_START: PooledSettings = PooledSettings {
    max_iterations: 15,
    cost_tolerance: 1e-3,
};
/// When many starts are sieved. Chosen.
pub(crate) const SIEVE: PooledSettings = PooledSettings {
    max_iterations: 4,
    cost_tolerance: 1e-2,
};
/// Share of its squared error by which what one start led to lies above another's, and may be the same place \[–\]. Chosen.
pub(crate) const SAME_END: f64 = 1e-3;
/// Starts that pass the sieve. Chosen.
pub(crate) const SIEVED: usize = 3;
/// When a candidate that comes from beginnings stops on whole records that take long: enough to rank it. Chosen.
pub(crate) const A_FEW_STEPS: PooledSettings = PooledSettings {
    max_iterations: 4,
    cost_tolerance: 1e-4,
};
/// Samples of all records together that are enough to look for effects in, where they are decimated. Chosen; with it twelve records of
/// 20 000 samples take a fifth of the time.
pub(crate) const ENOUGH_TO_SEARCH: usize = 15_000;
/// Samples of all records together, as they are searched, of which no more are needed where the beginnings say the same. Chosen; with it a
/// vibration test of 108 000 samples and twelve modes takes 146 s of processor time.
pub(crate) const MOST_TO_SEARCH: usize = 40_000;
/// Factor within which beginnings must hold their share of the motion's squares, and of what the study's own model leaves of them \[–\]. Chosen.
pub(crate) const AS_MUCH: f64 = 1.25;
/// Share of the largest motion that they must reach \[–\]. Chosen.
pub(crate) const AS_FAR: f64 = 0.9;
/// Fewest samples of a decimated record. Chosen.
pub(crate) const SHORTEST_DECIMATED: usize = 500;
/// Fewest samples of a decimated record from one restart to the next. Chosen.
pub(crate) const FEWEST_BETWEEN_RESTARTS: usize = 16;
/// Share of the squared error that may be lost of the output between decimated samples \[–\]. Chosen.
pub(crate) const LOST: f64 = 0.01;
/// Grid points a sample that are tried for a band-limited input, where none is decimated. Chosen; with it Silverbox takes 75 s in place of 200.
pub(crate) const GRIDS: [usize; 2] = [2, 4];
/// Share of the squared error by which the simulated output may differ on a coarser grid \[–\]: of what effects take, which may be
/// far less than all, a shift of m, c and k makes up for most of it. Chosen: of Silverbox 5e-8 differs with two grid points in place of eight.
pub(crate) const LOST_OF_GRID: f64 = 1e-6;
/// Correlation of neighbouring samples below which what is lost is noise \[–\]. Chosen.
pub(crate) const WHITE: f64 = 0.1;
/// Share of the measured acceleration's power that a regression must explain before a simulated fit that falls short of it is begun
/// again from its numbers \[–\]: with less, most of what is averaged is noise. Chosen.
pub(crate) const PROMISES: f64 = 0.8;
/// Times as much of that power as the regression leaves, taken as no less than a hundredth, from which a simulated fit falls short of
/// it \[–\]. Of good fits (motor, drive, pendulum, oscillator, in angle, velocity or acceleration) the worst leaves 1.1 times as much.
pub(crate) const FALLS_SHORT: f64 = 4.0;
/// Equation error of one machine with dry friction and an offset, over that of several without, below which they are one \[–\]: as
/// far below as several must leave of the simulated error to be several. Four tests of a motor that lacks friction leave 0.008, torque
/// steps of a rig that turns harder one way than the other 0.92.
pub(crate) const ONE_WITH_FRICTION: f64 = ONE_MACHINE;
/// Tightenings of a group from which they are asked whether they agree on a size. Chosen: of three an accident may be alike.
pub(crate) const FEWEST_OF_GROUP: usize = 4;
/// Share of what is known of a size (1/variance) that is left without the noise of the torque, from which it is told without it \[–\].
/// Chosen: half is left of a lag of the accelerometer, nothing of a gap.
pub(crate) const STILL_KNOWN: f64 = 0.2;
