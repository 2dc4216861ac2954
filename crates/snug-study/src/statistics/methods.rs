//! Every test of the table of p values: one entry of [`METHODS`] each.

use super::assumptions::Assumption::{self, EqualVariances, NormalResiduals};
use super::conditions::interval;
use super::sample::Sample;
use snug_campaign::EffectSize;
use snug_statistics::clustered::{
    Design, PermutationSettings, fit_cluster_robust, fit_random_intercept, permutation_test,
};
use snug_statistics::{StatisticsError, TestResult, k_sample, two_sample};

/// One test's outcome, or why it could not be made.
pub type Outcome = Result<(TestResult, Option<EffectSize>), StatisticsError>;

/// A method of the table.
pub struct Method {
    /// Name as in files.
    pub name: &'static str,
    /// Whether it respects that tightenings of one participant resemble each other.
    pub respects_participants: bool,
    /// What it presumes of the groups and is checked beside it.
    pub presumes: &'static [Assumption],
    /// Whether it compares so many groups.
    pub compares: fn(groups: usize) -> bool,
    /// The test itself, with a seed where it draws.
    pub test: Test,
}

/// In the order of the table.
pub const METHODS: &[Method] = &[
    two_groups("student_t", student, &[NormalResiduals, EqualVariances]),
    two_groups("welch_t", welch, &[NormalResiduals]),
    two_groups("mann_whitney", mann_whitney, &[]),
    any_groups("one_way_anova", anova, &[NormalResiduals, EqualVariances]),
    more_groups("welch_anova", welch_anova, &[NormalResiduals]),
    more_groups("kruskal_wallis", kruskal_wallis, &[]),
    per_participant("mixed_model", mixed_model),
    per_participant("cluster_robust", cluster_robust),
    per_participant("participant_permutation", permutation),
];

type Test = fn(&Sample, seed: u64) -> Outcome;

/// A method for any number of groups that takes every tightening for independent.
const fn any_groups(name: &'static str, test: Test, presumes: &'static [Assumption]) -> Method {
    Method {
        name,
        respects_participants: false,
        presumes,
        compares: |_| true,
        test,
    }
}

const fn two_groups(name: &'static str, test: Test, presumes: &'static [Assumption]) -> Method {
    Method {
        compares: |groups| groups == 2,
        ..any_groups(name, test, presumes)
    }
}

const fn more_groups(name: &'static str, test: Test, presumes: &'static [Assumption]) -> Method {
    Method {
        compares: |groups| groups > 2,
        ..any_groups(name, test, presumes)
    }
}

/// A method that respects participants: residuals about the groups' means are not what it presumes something of.
const fn per_participant(name: &'static str, test: Test) -> Method {
    Method {
        respects_participants: true,
        ..any_groups(name, test, &[])
    }
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

fn welch_anova(sample: &Sample, _seed: u64) -> Outcome {
    Ok((k_sample::welch_anova(&sample.groups)?, None))
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
