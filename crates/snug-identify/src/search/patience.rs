/// When a search rests because the cost does not follow its derivatives, as where a kink or the noise of the input makes it
/// rugged.
pub(super) struct Patience {
    /// A trial promises little when it promises no more than this share of the cost, ...
    pub promise: f64,
    /// ... and is idle when it keeps less than this share of that.
    pub gain: f64,
    /// A trial that keeps this share of a little promise is hope: idle ones are counted anew.
    pub hope: f64,
    /// Idle trials after which the search rests; one that has to find its damping anew makes fewer.
    pub trials: usize,
    /// Share of the cost that an undamped step may still promise at an optimum when the search has to rest.
    pub optimum: f64,
    /// The same where a search that was rejected before crawls.
    pub crawling: f64,
}

/// For as many digits as the cost can tell.
pub(super) const THOROUGH: Patience = Patience {
    promise: 1e-8,
    gain: 0.1,
    hope: 0.1,
    trials: 12,
    optimum: 1e-10,
    crawling: 0.0,
};
/// For what can be told from chance: 1e-7 of the cost is two hundredths of a standard error in 3000 samples.
pub(super) const SHORT: Patience = Patience {
    promise: 1e-6,
    gain: 0.5,
    hope: f64::INFINITY,
    trials: 8,
    optimum: 1e-6,
    crawling: 1e-6,
};
