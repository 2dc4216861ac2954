//! When a fit rests because the cost does not follow its derivatives, as where a kink or the noise of the input makes it rugged.

/// Shares of the cost and of predictions at which trials count as idle.
pub(super) struct StallCriteria {
    /// A trial predicts little when it predicts no more than this share of the cost, ...
    pub predicted: f64,
    /// ... and is idle when it keeps less than this share of that.
    pub gain: f64,
    /// A trial that keeps this share of a little prediction begins the count of idle ones anew.
    pub recovery: f64,
    /// Idle trials after which the fit rests; one that has to find its damping anew makes fewer.
    pub trials: usize,
    /// Share of the cost that an undamped step may still predict at an optimum when the fit has to rest.
    pub optimum: f64,
    /// The same where a fit that was rejected before crawls.
    pub crawling: f64,
}

/// For as many digits as the cost can tell.
pub(super) const TO_ROUNDING: StallCriteria = StallCriteria {
    predicted: 1e-8,
    gain: 0.1,
    recovery: 0.1,
    trials: 12,
    optimum: 1e-10,
    crawling: 0.0,
};
/// For what can be told from chance: 1e-7 of the cost is two hundredths of a standard error in 3000 samples.
pub(super) const TO_CHANCE: StallCriteria = StallCriteria {
    predicted: 1e-6,
    gain: 0.5,
    recovery: f64::INFINITY,
    trials: 8,
    optimum: 1e-6,
    crawling: 1e-6,
};
