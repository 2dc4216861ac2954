//! The table of tests. A new one is an entry in `METHODS`, which also says whether it respects participants.

use super::conditions::interval;
use super::factor::Factor;
use super::quantity;
use snug_campaign::{EffectSize, SignalUnits, TestRow, TighteningResult};
use snug_statistics::clustered::{
    Design, PermutationSettings, fit_cluster_robust, fit_random_intercept, permutation_test,
};
use snug_statistics::{StatisticsError, TestResult, k_sample, multiplicity, two_sample};
use std::collections::BTreeMap;

/// Values of one quantity by level of one factor, with the participant of every value.
struct Sample {
    groups: Vec<Vec<f64>>,
    levels: Vec<usize>,
    participants: Vec<usize>,
    values: Vec<f64>,
}

/// One test's outcome, or why it could not be made.
type Outcome = Result<(TestResult, Option<EffectSize>), StatisticsError>;

/// A method of the table: its name, whether it respects participants, and the test itself.
struct Method {
    name: &'static str,
    respects_participants: bool,
    applies: fn(&Sample) -> bool,
    test: fn(&Sample, u64) -> Outcome,
}

/// Every method, in the order of the table.
const METHODS: [Method; 9] = [
    Method {
        name: "student_t",
        respects_participants: false,
        applies: two_groups,
        test: student,
    },
    Method {
        name: "welch_t",
        respects_participants: false,
        applies: two_groups,
        test: welch,
    },
    Method {
        name: "mann_whitney",
        respects_participants: false,
        applies: two_groups,
        test: mann_whitney,
    },
    Method {
        name: "one_way_anova",
        respects_participants: false,
        applies: |_| true,
        test: anova,
    },
    Method {
        name: "welch_anova",
        respects_participants: false,
        applies: |sample| !two_groups(sample),
        test: |sample, _| Ok((k_sample::welch_anova(&sample.groups)?, None)),
    },
    Method {
        name: "kruskal_wallis",
        respects_participants: false,
        applies: |sample| !two_groups(sample),
        test: kruskal_wallis,
    },
    Method {
        name: "mixed_model",
        respects_participants: true,
        applies: |_| true,
        test: mixed_model,
    },
    Method {
        name: "cluster_robust",
        respects_participants: true,
        applies: |_| true,
        test: cluster_robust,
    },
    Method {
        name: "participant_permutation",
        respects_participants: true,
        applies: |_| true,
        test: permutation,
    },
];

/// Every test of every quantity against every factor over the selected tightenings; p adjusted per method.
pub fn rows(tightenings: &[&TighteningResult], units: &SignalUnits, seed: u64) -> Vec<TestRow> {
    let selected: Vec<&TighteningResult> = tightenings
        .iter()
        .copied()
        .filter(|t| t.selection.selected())
        .collect();
    let mut rows = Vec::new();
    for name in quantity::names(&selected) {
        for factor in Factor::of(units) {
            let sample = Sample::of(&selected, &name, factor);
            if sample.groups.len() < 2 {
                continue;
            }
            for method in &METHODS {
                let itself = factor == Factor::Participant && method.respects_participants;
                if (method.applies)(&sample) && !itself {
                    rows.push(row(&name, factor, method, (method.test)(&sample, seed)));
                }
            }
        }
    }
    adjust(&mut rows);
    rows
}

impl Sample {
    fn of(tightenings: &[&TighteningResult], name: &str, factor: Factor) -> Self {
        let mut participants: BTreeMap<String, usize> = BTreeMap::new();
        let mut sample = Self {
            groups: Vec::new(),
            levels: Vec::new(),
            participants: Vec::new(),
            values: Vec::new(),
        };
        for (level, (_, group)) in factor.groups(tightenings).iter().enumerate() {
            let mut values = Vec::new();
            for tightening in group {
                let Some(value) = quantity::value(tightening, name) else {
                    continue;
                };
                // Files that name no participant are taken as one participant each.
                let who = Factor::Participant
                    .level(tightening)
                    .unwrap_or_else(|| tightening.id.file.clone());
                let next = participants.len();
                values.push(value);
                sample.levels.push(level);
                sample
                    .participants
                    .push(*participants.entry(who).or_insert(next));
                sample.values.push(value);
            }
            sample.groups.push(values);
        }
        sample
    }
}

fn two_groups(sample: &Sample) -> bool {
    sample.groups.len() == 2
}

fn student(sample: &Sample, _seed: u64) -> Outcome {
    let [first, second] = pair(sample);
    let t = two_sample::student_t(first, second, 0.95)?;
    Ok((t.test, hedges(first, second)))
}

fn welch(sample: &Sample, _seed: u64) -> Outcome {
    let [first, second] = pair(sample);
    let t = two_sample::welch_t(first, second, 0.95)?;
    Ok((t.test, hedges(first, second)))
}

fn mann_whitney(sample: &Sample, _seed: u64) -> Outcome {
    let [first, second] = pair(sample);
    let test = two_sample::mann_whitney(first, second)?;
    Ok((test.test, size("superiority", test.superiority)))
}

fn anova(sample: &Sample, _seed: u64) -> Outcome {
    let anova = k_sample::one_way_anova(&sample.groups)?;
    Ok((anova.test, size("eta_squared", anova.eta_squared)))
}

fn kruskal_wallis(sample: &Sample, _seed: u64) -> Outcome {
    let test = k_sample::kruskal_wallis(&sample.groups)?;
    Ok((test.test, size("epsilon_squared", test.epsilon_squared)))
}

/// Name of the one term of every design here.
const FACTOR: &str = "factor";

fn design(sample: &Sample) -> Result<Design, StatisticsError> {
    Design::intercept(sample.values.len()).factor(FACTOR, &sample.levels)
}

/// Participants differ in level.
fn mixed_model(sample: &Sample, _seed: u64) -> Outcome {
    let design = design(sample)?;
    let fit = fit_random_intercept(&design, &sample.participants, &sample.values)?;
    let test = fit.test_term(FACTOR)?;
    Ok((
        test,
        size("intraclass_correlation", fit.intraclass_correlation),
    ))
}

/// Participants may also respond differently to the factor.
fn cluster_robust(sample: &Sample, _seed: u64) -> Outcome {
    let fit = fit_cluster_robust(&design(sample)?, &sample.participants, &sample.values)?;
    Ok((fit.test_term(FACTOR)?, None))
}

fn permutation(sample: &Sample, seed: u64) -> Outcome {
    let settings = PermutationSettings {
        seed,
        ..PermutationSettings::default()
    };
    let test = permutation_test(
        &sample.values,
        &sample.levels,
        &sample.participants,
        &settings,
    )?;
    Ok((test.test, None))
}

fn pair(sample: &Sample) -> [&[f64]; 2] {
    [&sample.groups[0], &sample.groups[1]]
}

fn hedges(first: &[f64], second: &[f64]) -> Option<EffectSize> {
    let difference = two_sample::standardized_difference(first, second, 0.95).ok()?;
    Some(EffectSize {
        name: "hedges_g".to_owned(),
        value: difference.hedges_g,
        interval: Some(interval(difference.interval)),
    })
}

fn size(name: &str, value: f64) -> Option<EffectSize> {
    Some(EffectSize {
        name: name.to_owned(),
        value,
        interval: None,
    })
}

fn row(quantity: &str, factor: Factor, method: &Method, outcome: Outcome) -> TestRow {
    let (test, effect_size, note) = match outcome {
        Ok((test, size)) => (Some(test), size, None),
        Err(error) => (None, None, Some(error.to_string())),
    };
    TestRow {
        quantity: quantity.to_owned(),
        factor: factor.name().to_owned(),
        method: method.name.to_owned(),
        respects_participants: method.respects_participants,
        statistic_name: test
            .as_ref()
            .map_or_else(String::new, |test| test.statistic_name.to_owned()),
        statistic: test.as_ref().map(|test| test.statistic),
        degrees_of_freedom: test
            .as_ref()
            .map_or_else(Vec::new, |test| test.degrees_of_freedom.clone()),
        p: test.map(|test| test.p),
        p_adjusted: None,
        effect_size,
        note,
    }
}

/// Benjamini–Hochberg over all rows of one method.
fn adjust(rows: &mut [TestRow]) {
    for method in &METHODS {
        let members: Vec<usize> = (0..rows.len())
            .filter(|&index| rows[index].method == method.name && rows[index].p.is_some())
            .collect();
        let p: Vec<f64> = members.iter().filter_map(|&index| rows[index].p).collect();
        if let Ok(adjusted) = multiplicity::benjamini_hochberg(&p) {
            for (index, adjusted) in members.into_iter().zip(adjusted) {
                rows[index].p_adjusted = Some(adjusted);
            }
        }
    }
}
