//! Whose effect a campaign hides: everyone's alike, larger for some, or of some only.

use crate::plan::file::{FilePlan, Joint, Strategy};
use crate::random::Stream;
use rand_distr::{Distribution, StandardNormal};
use serde::{Deserialize, Serialize};

/// Who has the hidden effects, and how much of them.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Whose {
    /// Everyone alike.
    #[default]
    Everyone,
    /// Everyone, the logarithm of the strength scattering from participant to participant by this much, without unit.
    Scattering(f64),
    /// Participants of these numbers only.
    Participants(Vec<u32>),
    /// Only under this joint.
    Joint(Joint),
    /// Only with this strategy.
    Strategy(Strategy),
    /// Only from this 1-based number of each file on.
    FromNumber(usize),
    /// Only from this tightening of the campaign on: 1-based numbers of its file and within it.
    Since(usize, usize),
    /// Everyone, the strength growing evenly from number to number: by what it is multiplied at the first tightening of each
    /// file, and by what at its last, without unit.
    Growing(f64, f64),
}

impl Whose {
    /// What the strength is multiplied by in the tightening number `index` (from 0) of file number `number` (from 0).
    pub(crate) fn factor(&self, file: &FilePlan, number: usize, index: usize, seed: u64) -> f64 {
        let has = match self {
            Self::Everyone => true,
            Self::FromNumber(first) => index + 1 >= *first,
            Self::Since(first_file, first) => (number + 1, index + 1) >= (*first_file, *first),
            Self::Growing(first, last) => {
                let way = index as f64 / (file.tightenings.max(2) - 1) as f64;
                return first + (last - first) * way;
            }
            Self::Scattering(spread) => {
                // Number 0 of a participant's draws is the hand–arm.
                let mut rng = Stream::Person.rng(seed, 1, file.participant as usize);
                let standard: f64 = StandardNormal.sample(&mut rng);
                return (spread * standard).exp();
            }
            Self::Participants(those) => those.contains(&file.participant),
            Self::Joint(joint) => file.joint == *joint,
            Self::Strategy(strategy) => file.strategy == *strategy,
        };
        f64::from(u8::from(has))
    }
}
