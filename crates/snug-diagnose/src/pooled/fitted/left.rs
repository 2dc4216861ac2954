//! What a fit leaves of the measured output, sample by sample.

use crate::data::cases::Cases;
use crate::data::neighbours::correlation;
use crate::data::white_noise::is_white_noise;
use crate::pooled::equation::values;
use crate::pooled::fitted::Fitted;
use snug_campaign::words::explained::is_a_motion;
use snug_identify::FitTask;

impl Fitted {
    /// Whether that is a motion rather than noise, by its neighbouring samples.
    pub fn leaves_a_motion(&self, cases: Cases<'_>) -> bool {
        let left = self.left(cases);
        left.is_some_and(|left| is_a_motion(correlation(&left)))
    }

    /// Whether that is white noise, however long it is looked at.
    pub fn leaves_white_noise(&self, cases: Cases<'_>) -> bool {
        let left = self.left(cases);
        left.is_some_and(|left| is_white_noise(&left))
    }

    /// Measured less simulated of each of `cases`, scored samples only, in the output's unit; `None` where it cannot be simulated.
    pub fn left(&self, cases: Cases<'_>) -> Option<Vec<Vec<f64>>> {
        let of_one = |(case, values): (&FitTask<'_>, Vec<f64>)| {
            let model = case.model_with(&self.effects).ok()?;
            let simulated = case.simulated(&model, &values).ok()?;
            let pairs = case.measured().iter().zip(&simulated);
            Some(pairs.skip(case.unscored()).map(|(y, s)| y - s).collect())
        };
        let values = values(cases, self)?;
        cases.iter().zip(values).map(of_one).collect()
    }
}
