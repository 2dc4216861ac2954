//! What changes from tightening to tightening: fatigue shows in the fitted m, c, k, not in the misfit of any one.

use crate::locate::drift::{number_range, per_tightening};
use crate::pooled::sizes::described;
use crate::verdict::reasons::{Held, described as explanation};
use snug_campaign::{Drift, EffectParameter, RankedEffect};
use snug_identify::FitTask;
use snug_model::{BASE_PARAMETERS, Description, TRENDS};

/// The catalogue's trends as candidates, as far as they could be tested.
pub(crate) fn trends(
    drifts: &[Drift],
    cases: &[FitTask<'_>],
    level: f64,
) -> impl Iterator<Item = RankedEffect> {
    TRENDS
        .iter()
        .filter_map(move |trend| candidate(trend, drifts, cases, level))
}

/// One trend as a candidate: slopes of m, c, k over the tightening's number, tested within files.
///
/// A slope is the relative change from one tightening to the next \[1/tightening\], exp(b) − 1 where ln p grows by b. It removes
/// no misfit, since every tightening has its own m, c, k; its p is that of the clearest of the three slopes,
/// times three. `None` where no slope could be tested.
fn candidate(
    description: &'static Description,
    drifts: &[Drift],
    cases: &[FitTask<'_>],
    level: f64,
) -> Option<RankedEffect> {
    let range = number_range(cases.iter().map(|case| &*case.tightening));
    let over_number = |parameter: &str| {
        let mut all = drifts.iter();
        all.find(|drift| drift.parameter == parameter && drift.against == "trial_number")
    };
    let tested: Vec<&Drift> = BASE_PARAMETERS
        .iter()
        .filter_map(|name| over_number(name))
        .collect();
    let smallest = tested.iter().filter_map(|drift| drift.p).reduce(f64::min)?;
    let per_tightening = |percent: f64| per_tightening(percent, range);
    let parameters: Vec<EffectParameter> = (description.parameters.iter().zip(BASE_PARAMETERS))
        .filter_map(|(spec, name)| {
            let drift = over_number(name)?;
            let interval = (drift.interval_percent)
                .map(|one| (per_tightening(one.low), per_tightening(one.high)));
            Some(EffectParameter {
                value: per_tightening(drift.change_percent),
                low: interval.map(|(low, _)| low),
                high: interval.map(|(_, high)| high),
                standard_error: interval.map(|(low, high)| (high - low) / 3.92),
                ..described(spec)
            })
        })
        .collect();
    let p_family = (smallest * tested.len() as f64).min(1.0);
    Some(RankedEffect {
        effect: description.name.to_owned(),
        kind: description.kind.name().to_owned(),
        unlisted: false,
        expression: None,
        score: 0.0,
        p_family,
        supported: p_family <= level,
        heldout_gain: 0.0,
        heldout_gain_error: 0.0,
        error_over_noise: None,
        behind_first: 0.0,
        twins: Vec::new(),
        plausible: parameters.iter().all(EffectParameter::is_plausible),
        explanation: explanation(description, Held::of(cases)),
        parameters,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::made_up::{close, exact};
    use snug_campaign::Interval;

    fn drift(parameter: &str, against: &str, change_percent: f64, p: Option<f64>) -> Drift {
        Drift {
            parameter: parameter.to_owned(),
            against: against.to_owned(),
            change_percent,
            interval_percent: Some(Interval {
                low: change_percent - 9.8,
                high: change_percent + 9.8,
            }),
            p,
            p_adjusted: None,
        }
    }

    /// Five tightenings of one file, numbers 1 to 5: four steps.
    fn fatigue(drifts: &[Drift]) -> Option<RankedEffect> {
        let cases: Vec<FitTask> = (0..5).map(|number| exact(number, &[], &[])).collect();
        trends(drifts, &cases, 0.05).next()
    }

    /// 1.03⁴ − 1 = 12.55 % over four steps are 0.03 per tightening; so 2.75 % are 1.0275^¼ − 1 and 22.35 % are 1.2235^¼ − 1, which
    /// are 3.92 standard errors apart.
    #[test]
    fn a_drift_is_told_as_a_slope_per_tightening() {
        let percent = 100.0 * (1.03_f64.powi(4) - 1.0);
        let told = fatigue(&[drift(
            "stiffness_n_per_m",
            "trial_number",
            percent,
            Some(0.01),
        )]);
        let told = told.expect("a slope was tested");
        assert_eq!(
            (told.effect.as_str(), told.kind.as_str()),
            ("fatigue", "trend")
        );
        let [slope] = told.parameters.as_slice() else {
            panic!("only the stiffness was tested")
        };
        assert_eq!(slope.name, "stiffness_slope_per_tightening");
        close(slope.value, 0.03, 1e-12);
        close(slope.low.expect("low"), 0.006807376, 1e-6);
        close(slope.high.expect("high"), 0.051723978, 1e-6);
        close(slope.standard_error.expect("an error"), 0.011458317, 1e-6);
    }

    /// Two files of five, numbered on: a file's tightenings are four steps apart, all ten are nine.
    #[test]
    fn a_slope_does_not_depend_on_how_files_are_numbered() {
        let drifts = [drift("mass_kg", "trial_number", 12.550_881, Some(0.01))];
        let mut cases: Vec<FitTask> = (0..10).map(|number| exact(number, &[], &[])).collect();
        for case in &mut cases[5..] {
            case.tightening.to_mut().id.file = "another.mat".to_owned();
        }
        let told = trends(&drifts, &cases, 0.05)
            .next()
            .expect("a slope was tested");
        close(told.parameters[0].value, 0.03, 1e-8);
    }

    /// Three slopes were tried, so the clearest counts three times (Bonferroni), and never above 1.
    #[test]
    fn its_p_is_that_of_the_clearest_slope_times_those_tried() {
        let with = |p: [f64; 3]| {
            let names = BASE_PARAMETERS.iter().zip(p);
            let drifts: Vec<Drift> = names
                .map(|(name, p)| drift(name, "trial_number", 1.0, Some(p)))
                .collect();
            fatigue(&drifts).expect("slopes were tested").p_family
        };
        close(with([0.3, 0.02, 0.5]), 0.06, 1e-12);
        assert_eq!(with([0.6, 0.5, 0.9]), 1.0);
    }

    #[test]
    fn a_drift_with_anything_but_the_number_is_no_fatigue() {
        let with_target = drift("stiffness_n_per_m", "target_torque_nm", 12.0, Some(1e-6));
        assert!(fatigue(std::slice::from_ref(&with_target)).is_none());
        let both = [
            with_target,
            drift("mass_kg", "trial_number", 1.0, Some(0.2)),
        ];
        let told = fatigue(&both).expect("one slope was tested");
        close(told.p_family, 0.2, 1e-12);
    }

    #[test]
    fn a_slope_without_a_p_is_no_candidate() {
        assert!(fatigue(&[drift("mass_kg", "trial_number", 12.0, None)]).is_none());
    }

    /// A third per tightening is no hand that tires.
    #[test]
    fn a_slope_that_no_hand_has_is_told_as_implausible() {
        let of = |percent| fatigue(&[drift("mass_kg", "trial_number", percent, Some(0.01))]);
        assert!(of(12.0).expect("tested").plausible);
        assert!(!of(120.0).expect("tested").plausible);
    }
}
