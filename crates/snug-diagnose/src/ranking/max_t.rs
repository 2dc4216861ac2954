//! Family-wise p: how often the largest statistic of all candidates reaches as far when whole clusters flip their sign
//! (Westfall and Young's max-T).

use crate::ranking::sensitivity::Column;
use rand::{RngCore, SeedableRng};
use rand_chacha::ChaCha8Rng;
use snug_model::Effect;

/// Sign flips of the clusters, the same for all columns.
pub(crate) struct Family {
    /// Largest statistic over all columns of each flip, ascending.
    largest: Vec<f64>,
    columns: usize,
}

impl Family {
    pub fn new(columns: &[Column], flips: usize, seed: u64) -> Self {
        let clusters = columns.first().map_or(0, |column| column.scores.len());
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut signs = vec![1.0; clusters];
        let mut largest = vec![0.0_f64; flips];
        let shared: Vec<&Column> = columns.iter().filter(|column| !column.is_own()).collect();
        for largest in &mut largest {
            for chunk in signs.chunks_mut(64) {
                let bits = random.next_u64();
                for (index, sign) in chunk.iter_mut().enumerate() {
                    *sign = if bits >> index & 1 == 1 { 1.0 } else { -1.0 };
                }
            }
            for column in &shared {
                *largest = largest.max(column.flipped_statistic(&signs));
            }
        }
        largest.sort_by(f64::total_cmp);
        Self {
            largest,
            columns: columns.len(),
        }
    }

    /// The p of one effect: its best column against the largest of the family.
    pub fn p(&self, columns: &[Column], effect: Effect) -> f64 {
        let own = columns.iter().filter(|column| column.effect == effect);
        own.map(|column| match column.chance_p() {
            // Sizes of their own have no common sign to flip: their energy against the noise, every column counted.
            Some(p) => (p * self.columns as f64).min(1.0),
            None => {
                let statistic = column.statistic();
                let below = self.largest.partition_point(|largest| *largest < statistic);
                (self.largest.len() - below + 1) as f64 / (self.largest.len() + 1) as f64
            }
        })
        .fold(1.0, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_distr::{Distribution, StandardNormal};

    const EFFECTS: [Effect; 3] = [
        Effect::CubicStiffness,
        Effect::QuadraticStiffness,
        Effect::TorqueDelay,
    ];

    fn columns(random: &mut ChaCha8Rng, shift: f64) -> Vec<Column> {
        // Some tightenings are far louder than others; the effects' scores go together.
        let common: Vec<f64> = (0..24).map(|_| StandardNormal.sample(random)).collect();
        EFFECTS
            .iter()
            .map(|&effect| {
                let scores = common.iter().enumerate().map(|(cluster, common)| {
                    let own: f64 = StandardNormal.sample(random);
                    let loud = if cluster % 6 == 0 { 8.0 } else { 1.0 };
                    loud * (0.8 * common + 0.6 * own + shift)
                });
                Column::with_scores(effect, scores.collect())
            })
            .collect()
    }

    /// Without any effect, at most the level of campaigns has a candidate at or below it, however loud single clusters are.
    #[test]
    fn false_alarms_stay_at_the_level() {
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let campaigns = 400;
        let alarms = (0..campaigns)
            .filter(|&campaign| {
                let columns = columns(&mut random, 0.0);
                let family = Family::new(&columns, 199, campaign);
                EFFECTS
                    .iter()
                    .any(|&effect| family.p(&columns, effect) <= 0.05)
            })
            .count();
        // 5 % of 400 is 20, its standard deviation 4.4.
        assert!((7..=33).contains(&alarms), "{alarms}");
    }

    /// Standard deviations of a share p of 4000 flips, five of them.
    fn is_share(found: f64, expected: f64) {
        let scatter = (expected * (1.0 - expected) / 4000.0).sqrt();
        assert!(
            (found - expected).abs() < 5.0 * scatter,
            "{found}, not {expected}"
        );
    }

    fn p(columns: &[Column], effect: Effect) -> f64 {
        Family::new(columns, 3999, 3).p(columns, effect)
    }

    /// Of 2⁴ patterns of signs two reach T = 2 of four equal scores where the sign is free, one where physics fixes it.
    #[test]
    fn p_is_the_share_of_sign_patterns_that_reach_as_far() {
        let free = [Column::with_scores(Effect::CubicStiffness, vec![1.0; 4])];
        is_share(p(&free, Effect::CubicStiffness), 1.0 / 8.0);
        let one_sided = [Column::with_scores(Effect::Backlash, vec![1.0; 4])];
        is_share(p(&one_sided, Effect::Backlash), 1.0 / 16.0);
        let against = [Column::with_scores(Effect::Backlash, vec![-1.0; 4])];
        assert_eq!(p(&against, Effect::Backlash), 1.0, "a gap is not negative");
    }

    /// A second effect reaches T = 2 with two other patterns: four of sixteen. One that pushes alike reaches with the same.
    #[test]
    fn every_other_effect_is_another_chance_to_reach_as_far() {
        let first = Column::with_scores(Effect::CubicStiffness, vec![1.0; 4]);
        let other = |scores: [f64; 4]| {
            let second = Column::with_scores(Effect::TorqueDelay, scores.to_vec());
            p(&[first.clone(), second], Effect::CubicStiffness)
        };
        is_share(other([1.0, 1.0, -1.0, -1.0]), 4.0 / 16.0);
        is_share(other([1.0; 4]), 2.0 / 16.0);
    }

    #[test]
    fn an_effect_is_judged_by_its_best_column() {
        let weak = Column::with_scores(Effect::CubicStiffness, vec![1.0, -1.0, 1.0, -1.0]);
        let strong = Column::with_scores(Effect::CubicStiffness, vec![1.0; 4]);
        is_share(p(&[weak, strong], Effect::CubicStiffness), 4.0 / 16.0);
    }

    /// Σ s²/v = 14 of three: `chi2.sf(14, 3)` = 0.0029052, SciPy 1.17.1; there are two columns, and no sign to flip.
    #[test]
    fn sizes_of_every_tightening_s_own_are_judged_by_their_energy() {
        let own = Column::with_scores(Effect::AccelerationBias, vec![1.0, -2.0, 3.0]);
        let shared = Column::with_scores(Effect::CubicStiffness, vec![1.0; 3]);
        let columns = [own, shared];
        let found = p(&columns, Effect::AccelerationBias);
        assert!(
            (found - 2.0 * 0.002_905_152_774_267_437).abs() < 1e-12,
            "{found}"
        );
        is_share(p(&columns, Effect::CubicStiffness), 2.0 / 8.0);
    }

    #[test]
    fn the_same_seed_flips_the_same_signs() {
        let columns = [Column::with_scores(
            Effect::CubicStiffness,
            vec![1.0, 2.0, 3.0, 4.0],
        )];
        let of = |seed| Family::new(&columns, 199, seed).largest;
        assert_eq!(of(1), of(1));
        assert_ne!(of(1), of(2));
    }

    #[test]
    fn what_all_tightenings_agree_on_is_found() {
        let mut random = ChaCha8Rng::seed_from_u64(6);
        let columns = columns(&mut random, 1.5);
        let family = Family::new(&columns, 999, 1);
        assert!(family.p(&columns, Effect::CubicStiffness) < 0.01);
    }
}
