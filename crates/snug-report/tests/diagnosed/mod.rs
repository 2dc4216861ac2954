//! An invented diagnosis of the invented campaign: a hardening spring and a small delay that no measurement ever had.

mod evidence;
mod location;

use crate::specimen;
use evidence::{effect, parameter, ranked};
use snug_campaign::words::effect_name::Named;
use snug_campaign::words::headline::{Fall, Headline, Left};
use snug_campaign::words::reason::{Cluster, Reason};
use snug_campaign::words::stopped::Stopped;
use snug_campaign::{
    AddedEffect, CampaignResult, CorrectedEffect, Diagnosis, Experiment, NoiseStatement, Removal,
    Rung, Traces, UnlistedTerm, Verdict, WorkDone,
};

/// An effect of the catalogue.
pub fn named(effect: &str) -> Named {
    Named::alone(effect.into(), None)
}

fn fall(before: f64, after: f64) -> Fall {
    let [before, after] = [before, after].map(Left::over_noise);
    Fall { before, after }
}

/// `improve` on 24 tightenings: two effects added, nothing left.
pub fn improve() -> CampaignResult {
    let mut result = specimen::campaign(24);
    with_before(&mut result);
    result.diagnosis = Some(Diagnosis {
        verb: "improve".into(),
        verdict: Verdict::Adequate,
        headline: Headline::Adequate {
            added: vec![named("cubic_stiffness"), named("torque_delay")],
            further: Vec::new(),
            fall: fall(6.42, 1.018),
            explained: None,
        },
        reasons: vec![Reason::Error {
            tightenings: 24,
            error: 1.018,
            is_at_floor: true,
            hardly_repeats: true,
        }],
        stopped: Some(Stopped::NothingSupported {
            best_p: 0.43,
            level: 0.05,
        }),
        added: added(),
        ladder: climbed(),
        ranking: evidence::leftovers(),
        removals: vec![Removal {
            effect: "torque_delay".into(),
            removed: false,
            statement:
                "Without torque_delay the error over noise rises from 1.018 to 1.38, so it stays."
                    .into(),
        }],
        work: WorkDone {
            rankings: 3,
            signatures: 4_512,
            pooled_fits: 123,
            steps: 1_234,
            linearizations: 29_616,
            conic_solves: 7,
        },
        final_location: Some(location::after()),
        experiment: None,
        ..diagnosis(&result)
    });
    result
}

/// `diagnose` on the same campaign: the ranking of the study's own model, nothing changed.
pub fn diagnose() -> CampaignResult {
    let mut result = specimen::campaign(24);
    result.diagnosis = Some(diagnosis(&result));
    result
}

/// A law that is in no catalogue.
pub fn unlisted() -> CampaignResult {
    let mut result = diagnose();
    let diagnosis = result.diagnosis.as_mut().expect("just made");
    diagnosis.verdict = Verdict::UnlistedEffect;
    diagnosis.headline = Headline::Unexplained(fall(6.42, 1.02).before);
    diagnosis.ranking[0] = ranked("p*x^2*v", "custom", 0.0, 0.71, 0.04, 0.001);
    diagnosis.ranking[0].unlisted = true;
    diagnosis.ranking[0].parameters = vec![parameter("p", "N s/m^3", 812.0, 31.0)];
    diagnosis.unlisted = Some(UnlistedTerm {
        expression: "p*x^2*v".into(),
        ron: "(name: \"x2v\", kind: force, expression: \"p*x^2*v\", parameters: [(name: \"p\", unit: \"N s/m^3\")])".into(),
        heldout_gain: 0.71,
        statement: "A damping that grows with the square of the displacement removes 71 % of what is left.".into(),
    });
    result
}

fn diagnosis(result: &CampaignResult) -> Diagnosis {
    Diagnosis {
        verb: "diagnose".into(),
        verdict: Verdict::MissingEffect,
        headline: Headline::Lacks {
            effect: named("cubic_stiffness"),
            fall: fall(6.42, 1.38),
        },
        reasons: vec![
            Reason::Error {
                tightenings: 24,
                error: 6.42,
                is_at_floor: false,
                hardly_repeats: false,
            },
            Reason::Removes {
                effect: named("cubic_stiffness"),
                heldout_gain: 0.83,
                p_family: 0.001,
                cluster: Cluster::Tightening,
                is_beyond_noise: true,
            },
        ],
        level: 0.05,
        stopped: None,
        interrupted: false,
        tightenings: 24,
        noise: NoiseStatement {
            source: "pre_roll".into(),
            acceleration_rad_per_s2: Some(0.9),
        },
        compared_output: "acceleration".into(),
        added: vec![],
        corrected: vec![CorrectedEffect {
            effect: "acceleration_bias".into(),
            share: 0.875,
            size: 0.31,
            unit: "rad/s^2".into(),
        }],
        ladder: ladder()[..1].to_vec(),
        ranking: evidence::candidates(),
        removals: vec![],
        comparison: location::comparison(result),
        location: location::before(),
        final_location: None,
        drift: location::drift(),
        detectability: evidence::detectability(),
        control: Some(evidence::control()),
        unlisted: None,
        experiment: Some(Experiment {
            between: vec!["cubic_stiffness".into(), "quadratic_stiffness".into()],
            conditions: "soft joint, targets 15 and 40 Nm, strategy QS".into(),
            tightenings: Some(9),
            distance_per_tightening: 2.3,
            statement:
                "9 tightenings on the soft joint with targets 15 and 40 Nm would tell them apart."
                    .into(),
        }),
        work: WorkDone::default(),
    }
}

fn added() -> Vec<AddedEffect> {
    let mut cubic = effect(
        "cubic_stiffness",
        parameter("k3_n_per_m3", "N/m^3", 9.9e5, 1.5e4),
    );
    cubic.p_family = Some(0.001);
    cubic.heldout_gain = Some(0.83);
    cubic.needed = Some(36.2);
    cubic.explanation = vec![
        "The hand's spring becomes stiffer the further it is pushed.".into(),
        "In these data the misfit stands around the peak and grows with the third power of the displacement.".into(),
        "Check at the bench: whether the arm runs into a stop, or the grip tightens, at large targets.".into(),
    ];
    let mut delay = effect("torque_delay", parameter("delay_s", "s", 1.6e-3, 1.5e-4));
    delay.kind = "measurement".into();
    delay.twins = vec!["torque_lag".into()];
    delay.p_family = Some(0.002);
    delay.heldout_gain = Some(0.47);
    delay.explanation = vec!["The torque channel runs ahead of the acceleration.".into()];
    vec![cubic, delay]
}

/// The ladder with what was ranked beside its models.
fn climbed() -> Vec<Rung> {
    let mut ladder = ladder();
    ladder[0].ranking = evidence::candidates();
    ladder[1].ranking = evidence::beside_the_spring();
    ladder
}

fn ladder() -> Vec<Rung> {
    let rung =
        |effects: &[&str], errors: [f64; 4], rms: f64, displacement: f64, fit, selected| Rung {
            effects: effects.iter().map(|name| (*name).into()).collect(),
            error_over_noise: Some(errors[0]),
            heldout_error_over_noise: Some(errors[1]),
            heldout_target_error_over_noise: Some(errors[2]),
            heldout_participant_error_over_noise: Some(errors[3]),
            rms_fitted_output: rms,
            rms_displacement_rad: Some(displacement),
            fit_percent_median: Some(fit),
            selected_fraction: selected,
            ranking: vec![],
        };
    vec![
        rung(&[], [6.42, 6.51, 7.93, 6.64], 5.778, 3.1e-3, 91.2, 0.4167),
        rung(
            &["cubic_stiffness"],
            [1.38, 1.39, 1.45, 1.41],
            1.242,
            4.6e-4,
            97.9,
            0.875,
        ),
        rung(
            &["cubic_stiffness", "torque_delay"],
            [1.018, 1.021, 1.034, 1.026],
            0.9162,
            1.4e-4,
            98.8,
            0.9583,
        ),
    ]
}

/// What the study's own model simulated of every example.
fn with_before(result: &mut CampaignResult) {
    for (_, traces) in &mut result.examples {
        let mut before = traces.clone();
        spoil(&mut before);
        traces.before = before.simulated;
    }
}

/// Takes a cubic spring's share out of the simulated motion.
fn spoil(traces: &mut Traces) {
    let angle = traces
        .simulated
        .displacement_rad
        .clone()
        .expect("simulated");
    let peak = angle.iter().fold(0.0_f64, |peak, x| peak.max(x.abs()));
    for (sample, x) in angle.iter().enumerate() {
        let share = (x / peak).powi(3);
        if let Some(displacement) = &mut traces.simulated.displacement_rad {
            displacement[sample] += 0.12 * peak * share;
        }
        if let Some(acceleration) = &mut traces.simulated.acceleration_rad_per_s2 {
            acceleration[sample] += 14.0 * share;
        }
    }
}
