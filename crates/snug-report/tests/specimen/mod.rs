//! An invented campaign: damped oscillators with noise, some rejected, some without an estimate. It stands for no
//! measurement; it only has the shape of one.

mod oscillator;
mod summary;

use oscillator::{Noise, Oscillator};
use snug_campaign::words::vocabulary::Vocabulary;
use snug_campaign::{
    CampaignResult, Conditions, Correction, Estimate, Finding, FitMeasures, FitStatus,
    Identifiability, Interval, NoiseFloor, NoiseSource, ParameterEstimate, ParameterMeaning,
    Quantity, Rejection, Rig, Selection, Severity, SignalUnits, TighteningId, TighteningResult,
    Traces,
};

/// Signals are kept of the first tightenings only.
const EXAMPLES: usize = 32;

/// `count` tightenings of six participants.
pub fn campaign(count: usize) -> CampaignResult {
    let mut noise = Noise::new(7);
    let pairs: Vec<(TighteningResult, Traces)> = (0..count)
        .map(|index| tightening(index, &mut noise))
        .collect();
    let examples = pairs
        .iter()
        .take(EXAMPLES)
        .enumerate()
        .map(|(index, (_, traces))| (index, traces.clone()))
        .collect();
    let tightenings: Vec<TighteningResult> = pairs.into_iter().map(|pair| pair.0).collect();
    CampaignResult {
        title: "Quick Step and Turbo Tight, six participants (invented)".into(),
        study_ron: "Study(\n    title: \"Specimen\",\n    rig: (lever_arm_m: 0.330),\n)\n".into(),
        preset: "snug".into(),
        fitted_output: "acceleration".into(),
        units: SignalUnits::default(),
        vocabulary: Vocabulary::Hand,
        effects: vec!["cubic_stiffness".into()],
        meanings: vec![ParameterMeaning {
            name: "k3_n_per_m3".into(),
            effect: "cubic_stiffness".into(),
            meaning: "cubic stiffness".into(),
        }],
        presets: summary::presets(&tightenings),
        conditions: summary::conditions(&tightenings),
        tests: summary::tests(),
        findings: findings(),
        tightenings,
        examples,
        diagnosis: None,
    }
}

/// A campaign without tightenings, presets, conditions or signals.
pub fn empty() -> CampaignResult {
    CampaignResult {
        examples: vec![],
        diagnosis: None,
        ..campaign(0)
    }
}

fn tightening(index: usize, noise: &mut Noise) -> (TighteningResult, Traces) {
    let participant = index / 4 % 6;
    let quick_step = index % 4 < 2;
    let soft = (index / 8).is_multiple_of(2);
    let pace = if index % 8 < 4 { 8.0 } else { 12.0 };
    let target = [15.0, 25.0, 40.0][index % 3];
    let conditions = Conditions {
        participant: Some(format!("TP{}", participant + 1)),
        strategy: Some(if quick_step { "QS" } else { "TT" }.into()),
        joint: Some(if soft { "Soft" } else { "Hard" }.into()),
        pace_per_min: (index != 5).then_some(pace),
    };
    let file = format!(
        "TP{}_{}_{}_{pace}.mat",
        participant + 1,
        if quick_step { "QS" } else { "TT" },
        if soft { "Soft" } else { "Hard" },
    );
    let rig = Rig {
        lever_arm_m: 0.33,
        known_inertia_kg_m2: if quick_step { 0.275 } else { 0.15 },
    };
    let oscillator = Oscillator {
        mass_kg: 1.9 + 0.15 * participant as f64 + 0.1 * noise.normal(),
        damping_kg_per_s: 95.0 + 6.0 * participant as f64 + 5.0 * noise.normal(),
        stiffness_n_per_m: 2200.0 + 90.0 * participant as f64 + 120.0 * noise.normal(),
        peak_torque_nm: target + 1.2 + 0.8 * noise.normal(),
        rise_s: if soft { 0.11 } else { 0.05 },
        rig,
        grip_force: quick_step,
    };
    let rejections = match index {
        3 => vec![Rejection::PoorFit],
        9 => vec![Rejection::PoorFit, Rejection::AtConstraint],
        13 => vec![Rejection::NotIdentified],
        18 => vec![Rejection::DataQuality],
        _ => vec![],
    };
    let traces = oscillator.traces(noise, if rejections.is_empty() { 0.0 } else { 6.0 });
    let result = TighteningResult {
        started_at_s: None,
        id: TighteningId {
            file,
            number: (index % 2 + index / 24 * 2) as u32 + 1,
        },
        conditions,
        rig,
        peak_torque_nm: oscillator.peak_torque_nm,
        target_torque_nm: 5.0 * (oscillator.peak_torque_nm / 5.0).round(),
        estimate: (index != 18).then(|| estimate(&oscillator, index, noise)),
        measures: measures(&oscillator, &traces, index, rejections.is_empty()),
        selection: Selection { rejections },
        validation: None,
        corrections: vec![correction(noise)],
        noise: (index != 18).then(|| NoiseFloor {
            source: NoiseSource::PreRoll,
            quantity: Quantity::Acceleration,
            standard_deviation: oscillator::ACCELERATION_NOISE,
            autoregression: vec![],
            innovation_sd: oscillator::ACCELERATION_NOISE,
            samples: 14_800,
        }),
    };
    (result, traces)
}

fn correction(noise: &mut Noise) -> Correction {
    let value = 0.06 * noise.normal();
    Correction {
        constant_of: Some(snug_campaign::Quantity::Acceleration),
        effect: "acceleration_bias".into(),
        value,
        standard_error: 0.012,
        unit: "rad/s²".into(),
        significant: value.abs() > 1.96 * 0.012,
    }
}

fn estimate(oscillator: &Oscillator, index: usize, noise: &mut Noise) -> Estimate {
    let mut parameter = |name: &str, unit: &str, truth: f64, relative: f64| {
        let standard_error = relative * truth;
        let value = truth + standard_error * noise.normal();
        ParameterEstimate {
            name: name.into(),
            unit: unit.into(),
            value,
            standard_error: Some(standard_error),
            interval: Some(Interval {
                low: value - 1.96 * standard_error,
                high: value + 1.96 * standard_error,
            }),
            fixed: false,
        }
    };
    let mut parameters = vec![
        parameter("mass_kg", "kg", oscillator.mass_kg, 0.02),
        parameter(
            "damping_kg_per_s",
            "kg/s",
            oscillator.damping_kg_per_s,
            0.008,
        ),
        parameter(
            "stiffness_n_per_m",
            "N/m",
            oscillator.stiffness_n_per_m,
            0.012,
        ),
        parameter("k3_n_per_m3", "N/m³", 9.9e5, 0.03),
    ];
    let at_constraint = index == 9;
    if at_constraint {
        parameters[0].interval = None;
        parameters[0].standard_error = None;
    }
    Estimate {
        parameters,
        covariance: vec![0.0; 16],
        status: match index {
            9 => FitStatus::ConvergedAtConstraint,
            13 => FitStatus::Stalled,
            _ => FitStatus::Converged,
        },
        active_constraints: if at_constraint {
            vec!["light_damping".into()]
        } else {
            vec![]
        },
        identifiability: Identifiability {
            rank: 4,
            free: 4,
            condition: 11.0 + index as f64,
            strongest_correlation: Some((
                "stiffness_n_per_m".into(),
                "k3_n_per_m3".into(),
                -0.93 + 0.001 * index as f64,
            )),
        },
        iterations: 7,
        evaluations: 9,
        conic_solves: usize::from(at_constraint),
    }
}

fn measures(oscillator: &Oscillator, traces: &Traces, index: usize, good: bool) -> FitMeasures {
    let peak = |signal: &[f64]| Some(signal.iter().fold(0.0, |peak: f64, x| peak.max(x.abs())));
    let lean = index as f64 * 0.01;
    let identified = index != 18;
    FitMeasures {
        fit_percent: identified.then_some(if good { 98.3 - lean } else { 84.0 + lean }),
        fit_percent_fitted_output: identified.then_some(if good { 96.0 + lean } else { 71.0 }),
        error_over_noise: identified.then_some(if good { 1.0 + 0.3 * lean } else { 7.5 }),
        rms_displacement_rad: Some(1.4e-4),
        euler_accuracy_percent: Some(98.9),
        natural_frequency_hz: identified.then(|| {
            (oscillator.stiffness_n_per_m / oscillator.mass_kg).sqrt() / std::f64::consts::TAU
        }),
        natural_frequency_low_hz: identified.then_some(4.9),
        natural_frequency_high_hz: identified.then_some(5.3),
        damped_frequency_hz: Some(3.1),
        damped_frequency_low_hz: Some(3.0625),
        damped_frequency_high_hz: Some(3.1375),
        damping_ratio: Some(0.36),
        damping_ratio_low: Some(0.348),
        damping_ratio_high: Some(0.372),
        thesis_damping_ratio: Some(0.5),
        peak_force_f1_n: peak(&traces.force_f1_n),
        peak_force_f2_n: peak(&traces.force_f2_n),
        peak_force_f3_n: peak(&traces.force_f3_n),
        peak_grip_force_n: traces.grip_force_n.as_deref().and_then(peak),
    }
}

fn findings() -> Vec<Finding> {
    let finding =
        |severity, code: &str, tightening, channel: Option<&str>, message: &str| Finding {
            severity,
            code: code.into(),
            file: "TP5_QS_Hard_8.mat".into(),
            tightening,
            channel: channel.map(Into::into),
            message: message.into(),
        };
    vec![
        finding(
            Severity::Repaired,
            "missing_samples",
            Some(2),
            Some("Inline_Torque"),
            "3 of 3000 samples were NaN, at most 1 in a row; they were interpolated.",
        ),
        finding(
            Severity::LeftOut,
            "saturation",
            Some(3),
            Some("angle_acc_Acc_FIR150"),
            "41 samples lie at the sensor's limit of 250 rad/s²; at most 5 are allowed; the tightening was left out.",
        ),
        finding(
            Severity::Note,
            "borderline_torque",
            Some(1),
            None,
            "The peak torque of 17.4 Nm lies 0.1 Nm below the next group.",
        ),
    ]
}
