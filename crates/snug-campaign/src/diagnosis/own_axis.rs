//! A diagnosis about the rig's own axis: Nm where it turns, N where it slides.

use crate::diagnosis::result::Diagnosis;
use crate::effect::size::EffectParameter;
use crate::words::sentence::reason::Reason;
use crate::words::sentence::statement;
use crate::words::vocabulary::Vocabulary;

impl Vocabulary {
    /// A diagnosis with its sizes about the rig's own axis.
    pub fn told(self, diagnosis: &Diagnosis) -> Diagnosis {
        let mut told = diagnosis.clone();
        let Self::Machine(Some(axis)) = self else {
            return told;
        };
        let all = |sizes: &mut Vec<EffectParameter>| {
            for size in sizes {
                *size = axis.size(size);
            }
        };
        let earlier = told.ladder.iter_mut().flat_map(|rung| &mut rung.ranking);
        for one in earlier.chain(&mut told.ranking) {
            all(&mut one.parameters);
        }
        for one in &mut told.added {
            all(&mut one.parameters);
        }
        for reason in &mut told.reasons {
            match reason {
                Reason::Size(parameters) | Reason::Drifts { parameters, .. } => all(parameters),
                Reason::Whose { parameter, .. } => **parameter = axis.size(parameter),
                Reason::TakenOut { corrected, .. } => {
                    let (factor, unit) = axis.about(&corrected.unit);
                    corrected.size *= factor;
                    corrected.unit = unit;
                }
                _ => {}
            }
        }
        for one in &mut told.detectability {
            let (factor, unit) = axis.about(&one.unit);
            one.smallest_detectable = one.smallest_detectable.map(|size| size * factor);
            one.largest_plausible *= factor;
            if let Some(some) = &mut one.in_some_groups {
                some.in_one = some.in_one.map(|size| size * factor);
            }
            one.statement = statement::detectability(
                &one.effect,
                one.smallest_detectable,
                &unit,
                one.in_some_groups.as_ref(),
            );
            one.unit = unit;
        }
        told
    }
}
