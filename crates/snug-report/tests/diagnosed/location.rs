//! Invented misfit: around the peak and at large targets before, nowhere in particular after; drift; a comparison.

use snug_campaign::words::remark::{Remark, Times};
use snug_campaign::{
    Aspect, CampaignResult, Comparison, Drift, ForceCurve, ForceMap, FrequencyResponse, Interval,
    Location, Misfit, Quantity, ResidualCorrelation, Response, Share, TighteningMisfit,
};

const ROWS: usize = 14;
const COLUMNS: usize = 12;
const BINS: usize = 30;

/// Where the study's own model fails: around the peak, at large targets.
pub fn before() -> Location {
    location(
        1.0,
        0.97,
        vec![
            Remark::Phase {
                phase: "peak".into(),
                share: 0.84,
                of_time: 0.2,
                error: times(9.6),
            },
            Remark::Condition {
                condition: "target_torque_nm".into(),
                value: "40 Nm".into(),
                share: 0.6,
                of_data: 0.25,
            },
        ],
    )
}

/// Where the final model fails: nowhere in particular.
pub fn after() -> Location {
    location(0.0, 0.004, vec![Remark::OnlyNoise(1.018)])
}

fn times(error: f64) -> Times {
    Times {
        error,
        of_noise: true,
    }
}

/// A hand of 2.3 kg, and what the model makes of it with a stiffness that is off by `size` tenths.
fn response(size: f64) -> FrequencyResponse {
    let frequency_hz: Vec<f64> = (0..30).map(|step| 4.0 * 1.15_f64.powi(step)).collect();
    let of = |stiffness: f64| -> Vec<Response> {
        let at = |frequency_hz: &f64| {
            let w = std::f64::consts::TAU * frequency_hz;
            let (real, imaginary) = (stiffness - 0.52 * w * w, 10.0 * w);
            Response {
                gain: w * w / real.hypot(imaginary),
                phase_rad: (-imaginary).atan2(-real) + std::f64::consts::PI,
            }
        };
        frequency_hz.iter().map(at).collect()
    };
    let measured = of(250.0);
    let interval = |one: &Response| Interval {
        low: 0.9 * one.gain,
        high: 1.1 * one.gain,
    };
    FrequencyResponse {
        quantity: Quantity::Acceleration,
        gain_interval: measured.iter().map(|one| Some(interval(one))).collect(),
        coherence: (0..30)
            .map(|step| Some(1.0 - 0.001 * f64::from(step * step) * 0.5))
            .collect(),
        simulated: of(250.0 * (1.0 + 0.1 * size)),
        measured,
        frequency_hz,
        resolution_hz: 3.33,
    }
}

fn location(size: f64, repeatable: f64, remarks: Vec<Remark>) -> Location {
    let aspect = |name: &str, parts: Vec<Share>| Aspect {
        aspect: name.into(),
        parts,
    };
    let bin = |from: f64, to: f64, unit: &str, excess: f64| Share {
        from: Some(from),
        to: Some(to),
        ..part(&format!("{from}..{to}{unit}"), size * excess)
    };
    let time = |step: usize| {
        let from = 0.02 * step as f64;
        bin(
            from,
            from + 0.02,
            " s",
            8.0 * (-(from - 0.06).powi(2) / 8e-4).exp(),
        )
    };
    let ringing = |lag_s: f64| 0.6 * size * (-lag_s / 0.03).exp() * (60.0 * lag_s).cos();
    let lags = |from: i32| (from..=60).map(|step| f64::from(step) * 1.5e-3);
    let correlation = ResidualCorrelation {
        lag_s: lags(1).collect(),
        own: lags(1).map(ringing).collect(),
        torque_lag_s: lags(-60).collect(),
        with_torque: lags(-60)
            .map(|lag_s| 0.5 * ringing((lag_s - 0.03).abs()))
            .collect(),
        half_width: 0.01,
    };
    Location {
        response: Some(response(size)),
        aspects: vec![
            aspect("time_since_onset_s", (0..15).map(time).collect()),
            aspect(
                "phase",
                vec![
                    part("rise", size * 2.2),
                    part("peak", size * 8.9),
                    part("release", size * 1.2),
                    part("rebound", size * 0.4),
                ],
            ),
            aspect(
                "frequency_hz",
                vec![
                    bin(0.0, 10.0, " Hz", 7.7),
                    bin(10.0, 30.0, " Hz", 3.0),
                    bin(30.0, 100.0, " Hz", 0.6),
                    bin(100.0, 5000.0, " Hz", 0.02),
                ],
            ),
            aspect(
                "amplitude_rad",
                vec![
                    bin(0.0, 0.02, " rad", 0.2),
                    bin(0.02, 0.05, " rad", 3.1),
                    bin(0.05, 0.1, " rad", 9.0),
                ],
            ),
            aspect(
                "target_torque_nm",
                vec![
                    part("15", size * 1.1),
                    part("25", size * 3.9),
                    part("40 Nm", size * 8.6),
                ],
            ),
            aspect(
                "participant",
                (1..=6)
                    .map(|n| part(&format!("TP{n}"), size * (4.0 + 0.4 * n as f64)))
                    .collect(),
            ),
        ],
        force_over_time: force_over_time(size),
        force_map: force_map(size),
        correlation: Some(correlation),
        repeatable_share: Some(repeatable),
        remarks,
    }
}

fn part(name: &str, excess: f64) -> Share {
    Share {
        part: name.into(),
        from: None,
        to: None,
        error_over_noise: 1.0 + excess,
        interval: Some(Interval {
            low: 1.0 + 0.85 * excess - 0.04,
            high: 1.0 + 1.15 * excess + 0.04,
        }),
        share_of_excess: (excess / 20.0).min(0.84),
        samples: 4800,
    }
}

fn force_over_time(size: f64) -> ForceCurve {
    let at: Vec<f64> = (0..BINS).map(|bin| 0.005 + 0.01 * bin as f64).collect();
    let force_n: Vec<f64> = at
        .iter()
        .map(|t| size * 41.0 * (-(t - 0.07).powi(2) / 6e-4).exp())
        .collect();
    ForceCurve {
        low_n: force_n.iter().map(|f| f - 1.1 - 0.07 * f).collect(),
        high_n: force_n.iter().map(|f| f + 1.1 + 0.07 * f).collect(),
        at,
        force_n,
    }
}

fn force_map(size: f64) -> ForceMap {
    let x_m: Vec<f64> = (0..ROWS).map(|row| -0.006 + 0.003 * row as f64).collect();
    let v_m_per_s: Vec<f64> = (0..COLUMNS).map(|v| -0.9 + 0.15 * v as f64).collect();
    let mut map = ForceMap::default();
    for x in &x_m {
        for v in &v_m_per_s {
            // The motion runs around an ellipse: its corners hold no sample.
            let seen = ((x - 0.014) / 0.022).powi(2) + (v / 0.85).powi(2) <= 1.0;
            map.force_n.push(seen.then(|| size * 9.9e5 * x.powi(3)));
            map.half_width_n.push(seen.then_some(1.2 + 3.0 * v.abs()));
        }
    }
    ForceMap {
        x_m,
        v_m_per_s,
        ..map
    }
}

/// Drift of the fitted parameters.
pub fn drift() -> Vec<Drift> {
    let row = |parameter: &str, against: &str, change: f64, half: f64, p: f64| Drift {
        parameter: parameter.into(),
        against: against.into(),
        change_percent: change,
        interval_percent: Some(Interval {
            low: change - half,
            high: change + half,
        }),
        p: Some(p),
        p_adjusted: Some((3.0 * p).min(1.0)),
    };
    vec![
        row("stiffness_n_per_m", "peak_angle_rad", 62.0, 7.0, 1e-5),
        row("stiffness_n_per_m", "target_torque_nm", 55.0, 9.0, 2e-4),
        row("damping_kg_per_s", "peak_velocity_rad_per_s", 6.0, 8.0, 0.2),
        Drift {
            interval_percent: None,
            p: None,
            p_adjusted: None,
            ..row("mass_kg", "trial_number", 1.0, 0.0, 1.0)
        },
    ]
}

/// Every quantity of every tightening, worst first.
pub fn comparison(result: &CampaignResult) -> Comparison {
    let misfits = |size: f64| {
        let misfit = |quantity: &str, unit: &str, rms: f64, fit: f64, over_noise| Misfit {
            quantity: quantity.into(),
            unit: unit.into(),
            rms: size * rms,
            largest: 3.4 * size * rms,
            fit_percent: Some(100.0 - size * fit),
            relative_percent: Some(size * 1.1 * fit),
            over_noise,
        };
        vec![
            misfit("acceleration", "rad/s^2", 5.778, 9.0, Some(6.42 * size)),
            misfit("displacement", "rad", 3.1e-3, 8.8, None),
            misfit("force", "N", 4.82, 7.1, None),
        ]
    };
    Comparison {
        pooled: misfits(1.0),
        tightenings: result
            .tightenings
            .iter()
            .enumerate()
            .map(|(index, tightening)| TighteningMisfit {
                id: tightening.id.clone(),
                misfits: misfits(1.6 - 0.05 * index as f64),
            })
            .collect(),
    }
}
