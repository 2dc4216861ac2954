//! Drawing tightenings, with replacement, to see how far a number would have come out otherwise.

use crate::locate::thresholds::{CAMPAIGNS, FEWEST};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use snug_campaign::{Interval, NORMAL_95};
use snug_statistics::distributions::student_t_quantile;

/// One tightening's part in a ratio Σ numerator / Σ denominator.
#[derive(Debug, Clone, Copy)]
pub struct Term {
    /// Index of the tightening.
    pub tightening: usize,
    pub numerator: f64,
    pub denominator: f64,
}

/// How often each tightening occurs in each drawn campaign.
pub struct Draws {
    counts: Vec<Vec<u16>>,
}

impl Draws {
    /// Campaigns of `tightenings` each; same seed, same draws.
    pub fn new(tightenings: usize, seed: u64) -> Self {
        let mut generator = ChaCha8Rng::seed_from_u64(seed);
        let counts = (0..CAMPAIGNS)
            .map(|_| {
                let mut counts = vec![0; tightenings];
                for _ in 0..tightenings {
                    counts[generator.random_range(0..tightenings)] += 1;
                }
                counts
            })
            .collect();
        Self { counts }
    }

    /// 95 % interval of Σ numerator / Σ denominator.
    ///
    /// The drawn ratios' 2.5 % and 97.5 % quantiles, both moved away from the ratio itself by
    /// t₀.₉₇₅(n − 1) √(n / (n − 1)) / 1.96: n tightenings drawn from themselves scatter too little (Hesterberg 2015).
    /// `None` with fewer than [`FEWEST`] tightenings.
    pub fn interval(&self, terms: &[Term]) -> Option<Interval> {
        if terms.len() < FEWEST {
            return None;
        }
        let ratio = |of: &dyn Fn(&Term) -> f64| {
            let (above, below) = terms.iter().fold((0.0, 0.0), |(above, below), term| {
                let count = of(term);
                (
                    above + count * term.numerator,
                    below + count * term.denominator,
                )
            });
            (below > 0.0).then(|| above / below)
        };
        let centre = ratio(&|_| 1.0)?;
        let mut drawn: Vec<f64> = self
            .counts
            .iter()
            .filter_map(|counts| ratio(&|term| f64::from(counts[term.tightening])))
            .collect();
        if drawn.len() < CAMPAIGNS / 2 {
            return None;
        }
        drawn.sort_by(f64::total_cmp);
        let tail = (0.025 * drawn.len() as f64) as usize;
        let (low, high) = (drawn[tail], drawn[drawn.len() - 1 - tail]);
        let n = terms.len() as f64;
        let wider = student_t_quantile(0.975, n - 1.0) * (n / (n - 1.0)).sqrt() / NORMAL_95;
        Some(Interval {
            low: centre - wider * (centre - low),
            high: centre + wider * (high - centre),
        })
    }
}
