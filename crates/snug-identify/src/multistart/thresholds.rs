//! Thresholds of the search for the lowest minimum.
//! Each stands once, with its unit and how it was found: "chosen" is chosen, not measured.

/// Share of the way up from an end by which a cost may differ from what the end predicts \[–\], ... Chosen.
pub(crate) const ALIKE: f64 = 0.1;
/// ... and share of the cost itself that says nothing \[–\]. Chosen.
pub(crate) const RESOLUTION: f64 = 1e-6;
/// Multiple of the decrease that its derivatives predict which a fit may still come to \[–\]: down the side of a narrow valley, as
/// contacts make, the cost falls up to three times faster than they say (seen in such fits).
pub(crate) const OVERACHIEVEMENT: f64 = 4.0;
/// Ends are worth a fit of every sample up to this multiple of the lowest decimated cost \[–\]. Chosen.
pub(crate) const COST_RATIO_LIMIT: f64 = 1.2;
/// Most ends on the decimated record that are. Chosen.
pub(crate) const MOST_DECIMATED_ENDS: usize = 2;
/// Most ends along the measured motion that go on freely. Chosen.
pub(crate) const MOST_LED_ENDS: usize = 3;
/// Samples that a decimated record should have: its noise is then still small beside a whole tightening's motion. Chosen.
pub(crate) const ENOUGH_SAMPLES: usize = 375;
/// Longest interval between decimated samples \[s\], on a hand: a shut-off, the fastest event of a tightening, takes several of them. Chosen.
pub(crate) const LONGEST_INTERVAL_S: f64 = 1e-3;
/// Decimated samples from one restart to the next, some 3 ms: enough for a law to show in the velocity. Chosen.
pub(crate) const APART: usize = 4;
/// Most steps of any fit that need not go far: what takes longer crawls. Chosen.
pub(crate) const MOST_STEPS: usize = 20;
/// Decimated costs that agree to this share are those of one minimum \[–\]. Chosen.
pub(crate) const SAME_MINIMUM: f64 = 1e-3;
/// A decimated or smoothed fit has gone far enough when this share of the residual could still be removed \[–\]. Chosen.
pub(crate) const SMOOTHED_TOLERANCE: f64 = 1e-2;
/// A fit along the measured motion has gone far enough when this share of the residual could still be removed \[–\]. Chosen.
pub(crate) const LED_TOLERANCE: f64 = 0.1;
/// Steps that every start along the measured motion makes before any is stopped. Chosen.
pub(crate) const WARM_UP_STEPS_LED: usize = 8;
/// Steps that every other start makes before any is stopped. Chosen.
pub(crate) const WARM_UP_STEPS: usize = 12;
/// Samples to either side over which the residual is averaged on the way to where it is not: less than a millisecond. Chosen.
pub(crate) const NEAR: usize = 8;
/// Mean square of a whitened residual beyond which a fit may have ended in the wrong minimum \[–\]. Chosen.
pub(crate) const FAR_OFF: f64 = 2.0;
/// Mean square of a whitened residual up to which it is hardly more than noise \[–\]. Chosen.
pub(crate) const CLOSE: f64 = 1.1;
/// Standard errors that an effect's parameter is away from zero when the effect is surely there. Chosen; of 1344 fits that trust
/// it, 44 end lower than before and one higher.
pub(crate) const SURE: f64 = 8.0;
/// Every this many samples enter the regression: a start need not be better, and the integrals know them all. Chosen.
pub(crate) const SCORED: usize = 8;
/// Times that the fit to the spectra is weighted anew: after five hardly anything changes (seen on six rigs).
pub(crate) const SPECTRAL_ROUNDS: usize = 12;
/// What the spectra do not show of m, c, k starts at this share of what stands before the output at its mean frequency \[–\].
/// Chosen.
pub(crate) const LEAST_SHARE: f64 = 1e-3;
