//! Whether the tightenings of one group agree on the size of an effect that only some groups have.
//!
//! A sum over all tightenings hardly sees what eight of forty-eight have: the others are as likely to gain as to lose. Within the group
//! every tightening asks for the size by itself. With g_i and S_i their gradients and curvatures over the effect's sizes at the optimum,
//! the group's size has the variance V = n/(n − p) S⁻¹ (Σ g_i g_iᵀ) S⁻¹, S = Σ S_i (the sandwich of White 1980 with whole tightenings as
//! clusters), and t = size/√V is Student's with n − p degrees of freedom where there is nothing of it, whatever the noise.

use crate::pooled::fitted::Fitted;
use crate::pooled::groups::nothing::Nothing;
use crate::pooled::parameter_place::effect_of;
use crate::pooled::thresholds::FEWEST_OF_GROUP;
use snug_least_squares::matrix::{SymmetricMatrix, inner_product as dot};
use snug_model::{Effect, Law};
use statrs::distribution::{ContinuousCDF, StudentsT};

impl Fitted {
    /// The smallest chance, of any group, of a size so far from nothing where the group has nothing of `effect`; times the number of
    /// groups (Bonferroni). `None` where sizes do not differ between groups, or nothing is known of any.
    pub fn chance_of_groups(&self, effect: Effect) -> Option<f64> {
        let specs = effect.description().parameters;
        let sizes = self.shared_sizes().iter().enumerate();
        let chances: Vec<f64> = sizes
            .filter(|(_, size)| size.level.is_some())
            .filter_map(|(place, size)| {
                let (of, offset) = effect_of(&self.effects, size.index)?;
                let spec = (of == effect).then(|| &specs[offset])?;
                let nothing = Nothing::of(Some(spec.vanishes_at?), spec.limits);
                self.chance_of_group(place, effect, nothing.distance(self.shared[place]))
            })
            .collect();
        let smallest = chances.iter().copied().reduce(f64::min)?;
        Some((smallest * chances.len() as f64).min(1.0))
    }

    /// That of the group whose size stands at `place` and is `size` from nothing.
    fn chance_of_group(&self, place: usize, effect: Effect, size: f64) -> Option<f64> {
        let members: Vec<usize> = (0..self.own.len())
            .filter(|&member| self.shared_of(member).contains(&place))
            .collect();
        let first = *members.first()?;
        let is_of_effect = |place: &usize| {
            let index = self.shared_sizes()[*place].index;
            effect_of(&self.effects, index).is_some_and(|(of, _)| of == effect)
        };
        let mut places: Vec<usize> = self.shared_of(first).to_vec();
        places.retain(is_of_effect);
        let at = places.iter().position(|known| *known == place)?;
        let (count, sizes) = (members.len(), places.len());
        if count < FEWEST_OF_GROUP.max(sizes + 2) {
            return None;
        }
        let curvature: SymmetricMatrix = self.of_sizes(&members, &places)?.0;
        let inverse = curvature.inverse()?;
        let row: Vec<f64> = (0..sizes).map(|j| inverse.at(at, j)).collect();
        let mut variance = 0.0;
        for member in members {
            variance += dot(&row, &self.of_sizes(&[member], &places)?.1).powi(2);
        }
        let freedom = (count - sizes) as f64;
        let t = size.abs() / (variance * count as f64 / freedom).sqrt();
        let student = StudentsT::new(0.0, 1.0, freedom).ok()?;
        t.is_finite().then(|| 2.0 * student.sf(t))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::tests::made_up::{close, exact};
    use snug_campaign::Factor;
    use snug_model::BASE_PARAMETERS;
    use snug_model::Effect::CubicStiffness;

    /// A fit of which each tightening by itself would ask for a size as given, all as plainly.
    fn asked_for(sizes: &[f64]) -> Fitted {
        let mean = sizes.iter().sum::<f64>() / sizes.len() as f64;
        let evidence: Vec<(f64, f64)> = sizes.iter().map(|one| (1.0, mean - one)).collect();
        let mut fitted = Fitted::made_up(&[CubicStiffness], &vec![1.0; sizes.len()], 100)
            .with_own(&["m", "c", "k"], vec![vec![1.0; 3]; sizes.len()], 0)
            .with_shared(("k3", BASE_PARAMETERS.len(), mean), &evidence);
        let mut case = exact(0, &[], &[]);
        case.tightening.to_mut().conditions.participant = Some("TP4".to_owned());
        fitted.shared_sizes[0].level = Factor::Participant.level(&case.tightening);
        fitted
    }

    /// SciPy 1.17.1: `ttest_1samp([1.2, 0.8, 1.1, 0.9, 1.3, 0.7], 0)` has p = 1.44850e-4.
    #[test]
    fn of_one_size_it_is_student_s_test() {
        let fitted = asked_for(&[1.2, 0.8, 1.1, 0.9, 1.3, 0.7]);
        let chance = fitted.chance_of_groups(CubicStiffness).unwrap();
        close(chance, 1.448_499_753_539_48e-4, 1e-9);
    }

    #[test]
    fn three_that_agree_say_nothing_and_many_that_do_not_say_little() {
        assert!(
            asked_for(&[1.0, 1.01, 0.99])
                .chance_of_groups(CubicStiffness)
                .is_none()
        );
        let scattered = asked_for(&[5.0, -4.0, 3.0, -2.0, 4.0, -3.0]);
        assert!(scattered.chance_of_groups(CubicStiffness).unwrap() > 0.5);
    }
}
