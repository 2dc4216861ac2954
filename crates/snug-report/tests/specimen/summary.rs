//! Tables over the invented tightenings: presets, groups, and p-values among which some tests could not be made.

use snug_campaign::{
    AssumptionCheck, ConditionSummary, EffectSize, Interval, Moments, PresetSummary,
    QuantitySummary, Rejection, RejectionCount, TestRow, TighteningId, TighteningResult,
};

pub fn presets(tightenings: &[TighteningResult]) -> Vec<PresetSummary> {
    let snug = tightenings
        .iter()
        .map(|t| (t.id.clone(), t.selection.rejections.clone()));
    let thesis = tightenings.iter().enumerate().map(|(index, t)| {
        let reasons = match index % 5 {
            0 | 3 => vec![Rejection::GoesDown],
            1 => vec![Rejection::NotLightlyDamped, Rejection::PoorFit],
            _ => vec![],
        };
        (t.id.clone(), reasons)
    });
    vec![
        preset("snug", snug.collect()),
        preset("thesis", thesis.collect()),
    ]
}

fn preset(name: &str, outcomes: Vec<(TighteningId, Vec<Rejection>)>) -> PresetSummary {
    let mut rejections: Vec<RejectionCount> = Vec::new();
    for reason in outcomes.iter().flat_map(|(_, reasons)| reasons) {
        match rejections.iter_mut().find(|row| row.rejection == *reason) {
            Some(row) => row.tightenings += 1,
            None => rejections.push(RejectionCount {
                rejection: *reason,
                tightenings: 1,
            }),
        }
    }
    PresetSummary {
        preset: name.into(),
        tightenings: outcomes.len(),
        selected: outcomes.iter().filter(|(_, r)| r.is_empty()).count(),
        rejections,
        outcomes,
    }
}

pub fn conditions(tightenings: &[TighteningResult]) -> Vec<ConditionSummary> {
    type Level = fn(&TighteningResult) -> Option<String>;
    let factors: [(&str, Level); 6] = [
        ("all", |_| Some("all".into())),
        ("strategy", |t| t.conditions.strategy.clone()),
        ("joint", |t| t.conditions.joint.clone()),
        ("pace_per_min", |t| {
            t.conditions.pace_per_min.map(|p| p.to_string())
        }),
        ("participant", |t| t.conditions.participant.clone()),
        ("target_torque_nm", |t| Some(t.target_torque_nm.to_string())),
    ];
    let mut summaries = Vec::new();
    for (factor, read) in factors {
        let mut levels: Vec<String> = tightenings.iter().filter_map(read).collect();
        levels.sort();
        levels.dedup();
        for level in levels {
            let group: Vec<&TighteningResult> = tightenings
                .iter()
                .filter(|t| read(t).as_ref() == Some(&level))
                .collect();
            summaries.push(condition(factor, level, &group));
        }
    }
    summaries
}

fn condition(factor: &str, level: String, group: &[&TighteningResult]) -> ConditionSummary {
    let selected = group.iter().filter(|t| t.selection.selected()).count();
    let share = selected as f64 / group.len() as f64;
    let half = 1.96 * (share * (1.0 - share) / group.len() as f64).sqrt();
    ConditionSummary {
        factor: factor.into(),
        level,
        tightenings: group.len(),
        selected,
        selected_share_interval: Some(Interval {
            low: (share - half).max(0.0),
            high: (share + half).min(1.0),
        }),
        quantities: [
            "mass_kg",
            "damping_kg_per_s",
            "stiffness_n_per_m",
            "natural_frequency_hz",
            "k3_n_per_m3",
        ]
        .map(|name| QuantitySummary {
            quantity: name.into(),
            selected: moments(name, group, true),
            rejected: moments(name, group, false),
        })
        .into(),
    }
}

fn moments(name: &str, group: &[&TighteningResult], selected: bool) -> Option<Moments> {
    let mut values: Vec<f64> = group
        .iter()
        .filter(|t| t.selection.selected() == selected)
        .filter_map(|t| match name {
            "natural_frequency_hz" => t.measures.natural_frequency_hz,
            parameter => t.estimate.as_ref()?.value(parameter),
        })
        .collect();
    values.sort_by(f64::total_cmp);
    let count = values.len();
    let mean = values.iter().sum::<f64>() / count as f64;
    let deviation = (count > 1).then(|| {
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        (squares / (count as f64 - 1.0)).sqrt()
    });
    (count > 0).then(|| Moments {
        count,
        mean,
        standard_deviation: deviation,
        mean_interval: deviation.map(|deviation| Interval {
            low: mean - 2.1 * deviation / (count as f64).sqrt(),
            high: mean + 2.1 * deviation / (count as f64).sqrt(),
        }),
        median: values[count / 2],
    })
}

const METHODS: &[(&str, &str)] = &[
    ("student_t", "t"),
    ("welch_t", "t"),
    ("mann_whitney", "U"),
    ("one_way_anova", "F"),
    ("welch_anova", "F"),
    ("kruskal_wallis", "H"),
    ("mixed_model", "t"),
    ("participant_permutation", "t"),
];

/// What a method presumes, against strategy, joint, pace and participant: sound, unequal variances, residuals not normal,
/// and both.
fn presumed(method: &str, factor: usize) -> Vec<AssumptionCheck> {
    let normal = AssumptionCheck {
        assumption: "normal_residuals".into(),
        method: "shapiro_wilk".into(),
        statistic_name: "W".into(),
        statistic: Some(0.9812),
        degrees_of_freedom: vec![],
        p: Some([0.62, 0.213, 0.004, 0.00002][factor]),
        values: 20,
        groups: 2,
        tied: if factor == 2 { 6 } else { 0 },
        note: None,
    };
    let variances = AssumptionCheck {
        assumption: "equal_variances".into(),
        method: "brown_forsythe".into(),
        statistic_name: "F".into(),
        statistic: Some(1.2),
        degrees_of_freedom: vec![1.0, 18.0],
        p: Some([0.33, 0.021, 0.75, 0.0004][factor]),
        tied: 0,
        ..normal.clone()
    };
    match method {
        "student_t" | "one_way_anova" => vec![normal, variances],
        "welch_t" | "welch_anova" => vec![normal],
        _ => vec![],
    }
}

pub fn tests() -> Vec<TestRow> {
    let mut rows = Vec::new();
    let quantities = [
        "mass_kg",
        "damping_kg_per_s",
        "stiffness_n_per_m",
        "natural_frequency_hz",
    ];
    for (q, quantity) in quantities.into_iter().enumerate() {
        for (f, factor) in ["strategy", "joint", "pace_per_min", "participant"]
            .into_iter()
            .enumerate()
        {
            for (m, (method, statistic)) in METHODS.iter().copied().enumerate() {
                if (factor == "participant") != (m == 4 || m == 5) && m != 3 {
                    continue;
                }
                let respects = m >= 6;
                let made = !(m == 7 && f == 2);
                let p = [0.0002, 0.031, 0.87, 0.012][f] * (1.0 + q as f64) / 4.0
                    * if respects { 3.0 } else { 1.0 };
                let p = p.min(0.9995);
                rows.push(TestRow {
                    quantity: quantity.into(),
                    factor: factor.into(),
                    method: method.into(),
                    respects_participants: respects,
                    statistic_name: statistic.into(),
                    statistic: made.then_some(2.31 + q as f64),
                    degrees_of_freedom: if m == 2 { vec![] } else { vec![17.4] },
                    p: made.then_some(p),
                    p_adjusted: made.then_some((2.0 * p).min(1.0)),
                    effect_size: matches!(m, 1 | 3 | 6).then_some(EffectSize {
                        name: if m == 3 { "eta_squared" } else { "hedges_g" }.into(),
                        value: 0.62,
                        interval: (m != 3).then_some(Interval {
                            low: 0.11,
                            high: 1.13,
                        }),
                    }),
                    assumptions: presumed(method, f),
                    note: (!made).then(|| "each participant has one pace only".into()),
                });
            }
        }
    }
    rows
}
