//! One way of looking: its parts, and what each tightening has in them.

use super::bootstrap::{Draws, Term};
use super::residual::{Residuals, White};
use rayon::prelude::*;
use snug_campaign::{Aspect, Interval, Share};

/// What a part is called and where it lies.
#[derive(Debug, Clone)]
pub struct Part {
    pub name: String,
    pub from: Option<f64>,
    pub to: Option<f64>,
}

/// Σ w² and the number of w² in it.
#[derive(Debug, Clone, Copy, Default)]
pub struct Sum {
    pub square: f64,
    pub count: f64,
}

/// The misfit along one way of looking: per tightening one sum a part.
pub struct View {
    pub aspect: &'static str,
    pub parts: Vec<Part>,
    pub sums: Vec<Vec<Sum>>,
}

/// Adds up w² of one tightening over the parts its samples fall in.
pub fn sums(one: &White<'_>, parts: usize, part_of: impl Fn(usize) -> Option<usize>) -> Vec<Sum> {
    let mut sums = vec![Sum::default(); parts];
    for (index, value) in one.samples().zip(&one.values) {
        if let Some(part) = part_of(index) {
            sums[part].square += value * value;
            sums[part].count += 1.0;
        }
    }
    sums
}

impl View {
    /// Error, interval and share of every part that holds something.
    pub fn aspect(&self, residuals: &Residuals<'_>, draws: &Draws) -> Aspect {
        let parts = self
            .parts
            .par_iter()
            .enumerate()
            .filter_map(|(index, part)| self.share(index, part, residuals, draws))
            .collect();
        Aspect {
            aspect: self.aspect.to_owned(),
            parts,
        }
    }

    fn share(
        &self,
        index: usize,
        part: &Part,
        residuals: &Residuals<'_>,
        draws: &Draws,
    ) -> Option<Share> {
        let terms: Vec<Term> = self
            .sums
            .iter()
            .enumerate()
            .filter(|(_, sums)| sums[index].count > 0.0)
            .map(|(tightening, sums)| Term {
                tightening,
                numerator: sums[index].square,
                denominator: sums[index].count,
            })
            .collect();
        let square: f64 = terms.iter().map(|term| term.numerator).sum();
        let count: f64 = terms.iter().map(|term| term.denominator).sum();
        let floor = if residuals.noise_known { count } else { 0.0 };
        (count > 0.0).then(|| Share {
            part: part.name.clone(),
            from: part.from,
            to: part.to,
            error_over_noise: (square / count).sqrt(),
            interval: draws.interval(&terms).map(|interval| Interval {
                low: interval.low.max(0.0).sqrt(),
                high: interval.high.max(0.0).sqrt(),
            }),
            share_of_excess: if residuals.beyond_noise && residuals.excess > 0.0 {
                (square - floor) / residuals.excess
            } else {
                0.0
            },
            samples: count.round() as usize,
        })
    }
}
