//! What was found out about the model itself: where it fails, which effect is missing, and how the error falls.

use crate::diagnosis::comparison::Comparison;
use crate::diagnosis::location::{Drift, Location};
use crate::diagnosis::rung::Rung;
use crate::tightening::factor::Factor;
use crate::words::sentence::headline::Headline;
use crate::words::sentence::reason::Reason;
use crate::words::sentence::stopped::Stopped;
use serde::{Deserialize, Serialize};

/// What the campaign says about the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Nothing beyond the model is supported.
    Adequate,
    /// The ranking's first effect is supported by the data and not yet in the model.
    MissingEffect,
    /// Repeatable misfit remains that no effect of the catalogue explains.
    UnlistedEffect,
    /// Too little data to say.
    Undecided,
    /// No model was found that deserves the question.
    NotFitted,
}

impl Verdict {
    /// Stable snake-case name, as in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Adequate => "adequate",
            Self::MissingEffect => "missing_effect",
            Self::UnlistedEffect => "unlisted_effect",
            Self::Undecided => "undecided",
            Self::NotFitted => "not_fitted",
        }
    }
}

/// A parameter of an effect, estimated from all tightenings together.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EffectParameter {
    /// Name with unit suffix.
    pub name: String,
    /// What it is, in a few words, as its effect says it; empty where nothing says it.
    #[serde(default)]
    pub meaning: String,
    /// Unit as people write it.
    pub unit: String,
    /// Estimate; of a parameter that every tightening has of its own, the mean.
    pub value: f64,
    /// Lower end of its 95 % interval.
    pub low: Option<f64>,
    /// Upper end of its 95 % interval.
    pub high: Option<f64>,
    /// Standard error; `None` where the estimate lies on a bound.
    pub standard_error: Option<f64>,
    /// True when every tightening has its own.
    pub per_tightening: bool,
    /// Standard deviation between tightenings, of a parameter that every tightening has of its own.
    pub spread: Option<f64>,
    /// Smallest plausible value.
    pub minimum: f64,
    /// Largest plausible value.
    pub maximum: f64,
    /// The size of each group, of a parameter that differs from group to group; `value` is their mean then, `spread` the standard
    /// deviation between them beyond their own errors.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub by_group: Option<GroupSizes>,
}

/// The sizes of a parameter that differs between groups of tightenings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GroupSizes {
    /// What groups them.
    pub factor: Factor,
    /// In the order of the groups.
    pub groups: Vec<GroupSize>,
    /// Where it changes at a number or place: between which the later size begins, at 95 %.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub change: Option<ChangePoint>,
}

/// Where a size changes: the 95 % interval of the first tightening that has the later one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ChangePoint {
    /// It may be this one: a number within the file, or file and number.
    pub first: String,
    /// Or one of those up to this one.
    pub last: String,
}

/// The size of one group; numbers in the parameter's unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GroupSize {
    /// Which group, for example `TP3`.
    pub group: String,
    /// Its tightenings.
    pub tightenings: usize,
    /// Its own estimate.
    pub value: f64,
    /// Its standard error.
    pub standard_error: Option<f64>,
    /// The same, shrunk towards the mean of all groups as far as its error asks.
    pub shrunk: f64,
    /// Lower end of its own 95 % interval.
    pub low: Option<f64>,
    /// Upper end of its own 95 % interval.
    pub high: Option<f64>,
    /// Whether the effect is there: told from nothing, with one false discovery in twenty over the groups.
    pub present: bool,
}

/// How tightenings share the sizes of an effect: `shared`, `per tightening`, `per participant` and so on, or `before and from
/// number 13 on`.
pub fn sharing(parameters: &[EffectParameter]) -> String {
    let factor = parameters.iter().find_map(|one| one.by_group.as_ref());
    match factor {
        Some(sizes) => sizes.factor.sharing(),
        None if parameters.iter().any(|one| one.per_tightening) => "per tightening".to_owned(),
        None => "shared".to_owned(),
    }
}

impl EffectParameter {
    /// Whether its value lies where one expects it.
    pub fn is_plausible(&self) -> bool {
        (self.minimum..=self.maximum).contains(&self.value)
    }
}

/// An effect as a candidate for what the model lacks.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RankedEffect {
    /// Name in the catalogue, or of the study's custom effect.
    pub effect: String,
    /// `mechanical`, `muscular`, `measurement`, `trend` or `custom`.
    pub kind: String,
    /// True for a term that is in no catalogue and was tried to describe what is left.
    pub unlisted: bool,
    /// The expression of such a term.
    #[serde(default)]
    pub expression: Option<String>,
    /// Its size, refitted to all tightenings.
    pub parameters: Vec<EffectParameter>,
    /// T = Σ s_i / √Σ s_i² over tightenings, before any refit; no unit.
    pub score: f64,
    /// Share of all-effect sign flips whose largest T reaches this one.
    pub p_family: f64,
    /// Share of the misfit that it removes in tightenings that took no part in fixing it; negative when it does harm.
    pub heldout_gain: f64,
    /// Standard error of that share over tightenings.
    pub heldout_gain_error: f64,
    /// Error over noise with it, all tightenings pooled.
    pub error_over_noise: Option<f64>,
    /// Standard deviations by which the first of the ranking explains more, over tightenings; 0 for the first.
    pub behind_first: f64,
    /// Whether the data support it: beyond chance at the diagnosis' level, and a gain in held-out tightenings beyond its
    /// scatter.
    pub supported: bool,
    /// Effects that these data cannot tell from it.
    pub twins: Vec<String>,
    /// Whether its size is physically plausible: the fit settled, every estimate within its range.
    pub plausible: bool,
    /// What it is, how it shows, what to check at the bench: sentences for a tool engineer.
    pub explanation: Vec<String>,
}

impl RankedEffect {
    /// What speaks against it, whatever it explains.
    pub fn doubt(&self) -> Option<Doubt> {
        let mut sizes = self.parameters.iter();
        match (self.plausible, sizes.all(EffectParameter::is_plausible)) {
            (true, _) => None,
            (false, true) => Some(Doubt::NotSettled),
            (false, false) => Some(Doubt::ImplausibleSize),
        }
    }
}

/// Why a candidate may not be what it seems.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Doubt {
    /// Its fit did not settle.
    NotSettled,
    /// One of its sizes is beyond what is physically plausible.
    ImplausibleSize,
}

/// An effect in the model, with the evidence for it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct AddedEffect {
    /// Its name.
    pub effect: String,
    /// `mechanical`, `muscular`, `measurement`, `trend` or `custom`.
    pub kind: String,
    /// The expression of a custom effect.
    pub expression: Option<String>,
    /// Effects that these data cannot tell from it.
    pub twins: Vec<String>,
    /// `shared` by all tightenings, `per tightening`, or what differs in it: `per participant`, `per joint` and so on.
    #[serde(default)]
    pub size: String,
    /// Its size.
    pub parameters: Vec<EffectParameter>,
    /// Family-wise p at the rung where it was added; `None` when the study already had it.
    pub p_family: Option<f64>,
    /// Share of the misfit at that rung that it removed in held-out tightenings.
    pub heldout_gain: Option<f64>,
    /// Loss of fit when it alone is removed from the final model: growth of the pooled squared error over noise, as a
    /// share of it.
    pub needed: Option<f64>,
    /// Sentences for a tool engineer.
    pub explanation: Vec<String>,
    /// Whether its size differs between conditions and people.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub comparisons: Vec<SizeComparison>,
}

/// Whether the size of an effect differs between the groups of a factor, by the sizes that single tightenings ask for.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SizeComparison {
    /// What groups them.
    pub factor: Factor,
    /// `mixed_model` or `welch_anova`, as in statistics.json.
    pub method: String,
    /// Name of the statistic.
    pub statistic_name: String,
    /// The statistic; no unit.
    pub statistic: f64,
    /// Its degrees of freedom.
    pub degrees_of_freedom: Vec<f64>,
    /// Chance of as much where all groups are alike.
    pub p: f64,
    /// The same, adjusted over all comparisons of the model's effects (Benjamini and Hochberg).
    pub p_adjusted: f64,
}

/// An effect that preparation measured in the quiet part and took out before the fit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CorrectedEffect {
    /// Name in the catalogue.
    pub effect: String,
    /// Share of tightenings in which it is significant.
    pub share: f64,
    /// Its typical (root-mean-square) size.
    pub size: f64,
    /// Unit of the size.
    pub unit: String,
}

/// The noise that errors are compared with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NoiseStatement {
    /// `pre_roll`, `repeats`, `declared` or `residual`.
    pub source: String,
    /// Its standard deviation in the acceleration \[rad/s²\]; `None` when the acceleration is not what is compared.
    pub acceleration_rad_per_s2: Option<f64>,
}

/// How large an effect would have to be to be seen in these data.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Detectability {
    /// The effect.
    pub effect: String,
    /// The parameter whose size is meant.
    pub parameter: String,
    /// What that parameter is, in a few words, as its effect says it; empty where nothing says it.
    #[serde(default)]
    pub meaning: String,
    /// Its unit.
    pub unit: String,
    /// Absent or smaller than this (95 % power at the family-wise level).
    pub smallest_detectable: Option<f64>,
    /// The largest plausible size, to compare with.
    pub largest_plausible: f64,
    /// The same where only some people or tools have it; `None` where tightenings form no groups.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub in_some_groups: Option<InSomeGroups>,
    /// In words.
    pub statement: String,
}

/// How large an effect that only some groups have would have to be to be seen, and how few may have it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct InSomeGroups {
    /// What groups the tightenings.
    pub factor: Factor,
    /// How many groups there are.
    pub groups: usize,
    /// Size from which it is found in a single group, in the parameter's unit; `None` where that is not plausible.
    pub in_one: Option<f64>,
    /// Fewest groups in which it is found at its largest plausible size; `None` where even all are too few.
    pub fewest: Option<usize>,
}

/// The ranking on data that hide nothing: simulated from the accepted model with noise like the measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NegativeControl {
    /// Campaigns simulated.
    pub campaigns: usize,
    /// Of them those in which the ranking called an effect supported.
    pub false_alarms: usize,
    /// The share of campaigns with a false alarm that was meant.
    pub nominal_rate: f64,
    /// Wilson 95 % interval of the share reached, low end.
    pub rate_low: f64,
    /// Wilson 95 % interval of the share reached, high end.
    pub rate_high: f64,
}

/// The simplest term that describes what no effect of the catalogue explains.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct UnlistedTerm {
    /// Expression of a custom effect, for example `p*x^2*v`.
    pub expression: String,
    /// RON to paste into the study's `model.custom` list.
    pub ron: String,
    /// Share of the remaining misfit that it removes in held-out tightenings.
    pub heldout_gain: f64,
    /// In words.
    pub statement: String,
}

/// An experiment that would tell twins apart.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Experiment {
    /// The effects it separates.
    pub between: Vec<String>,
    /// Conditions of the tightenings to make, in words.
    pub conditions: String,
    /// How many of them; `None` when none of the tried conditions separates them.
    pub tightenings: Option<usize>,
    /// Smallest refitted distance over noise per tightening under these conditions; no unit.
    pub distance_per_tightening: f64,
    /// In words.
    pub statement: String,
}

/// What became of a term that was tried to be removed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Removal {
    /// The effect.
    pub effect: String,
    /// Whether it was removed.
    pub removed: bool,
    /// In words.
    pub statement: String,
}

/// How much work a diagnosis was: counts, no times, the same on every run and for any number of threads.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct WorkDone {
    /// Rankings of all candidates, those for looking ahead included.
    pub rankings: usize,
    /// Simulations of a tightening for how a candidate would push it.
    pub signatures: usize,
    /// Fits of tightenings together.
    pub pooled_fits: usize,
    /// Steps tried in them.
    pub steps: usize,
    /// Simulations of a tightening with sensitivities in them.
    pub linearizations: usize,
    /// Conic programs solved in them.
    pub conic_solves: usize,
}

/// Model against measurement, as far as a verb looked.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Diagnosis {
    /// `compare`, `diagnose`, `add` or `improve`.
    pub verb: String,
    /// The verdict.
    pub verdict: Verdict,
    /// The verdict, to be said in one sentence.
    pub headline: Headline,
    /// Why.
    pub reasons: Vec<Reason>,
    /// Why nothing more was added; `None` for verbs that add nothing.
    pub stopped: Option<Stopped>,
    /// Family-wise p up to which an effect is believed; no unit.
    pub level: f64,
    /// Whether whoever asked ended the climb: what is told is what was known by then.
    pub interrupted: bool,
    /// Tightenings that took part.
    pub tightenings: usize,
    /// What errors are compared with.
    pub noise: NoiseStatement,
    /// The quantity compared, for example `acceleration`.
    pub compared_output: String,
    /// Effects in the final model.
    pub added: Vec<AddedEffect>,
    /// Effects taken out by preparation.
    pub corrected: Vec<CorrectedEffect>,
    /// The ladder, the study's own model first.
    pub ladder: Vec<Rung>,
    /// Candidates for what the final model still lacks (`diagnose`: what the study's model lacks), best first.
    pub ranking: Vec<RankedEffect>,
    /// Attempts to do without an added term.
    pub removals: Vec<Removal>,
    /// Model against measurement per tightening and pooled, of the study's own model.
    pub comparison: Comparison,
    /// Where the study's own model fails.
    pub location: Location,
    /// Where the final model fails; `None` when it is the study's own.
    pub final_location: Option<Location>,
    /// Drift of fitted m, c, k of the study's own model.
    pub drift: Vec<Drift>,
    /// How large effects not found would have to be.
    pub detectability: Vec<Detectability>,
    /// The negative control; `None` where nothing was ranked.
    pub control: Option<NegativeControl>,
    /// The simplest term for what is unlisted.
    pub unlisted: Option<UnlistedTerm>,
    /// What would tell the winner from its twins.
    pub experiment: Option<Experiment>,
    /// How much work it was.
    pub work: WorkDone,
}

impl Diagnosis {
    /// The formula of a term that is in no catalogue, added or ranked; nothing for an effect that has a name of its own.
    pub fn expression(&self, effect: &str) -> Option<&String> {
        let added = self.added.iter().map(|one| (&one.effect, &one.expression));
        let earlier = self.ladder.iter().flat_map(|rung| &rung.ranking);
        let ranked = self.ranking.iter().chain(earlier);
        let mut known = added.chain(ranked.map(|one| (&one.effect, &one.expression)));
        known.find(|(name, _)| *name == effect)?.1.as_ref()
    }
}
