//! `/verdict`, `/ladder` and `/ranking`: what is missing in the model, and how the error fell.

use crate::encoding::schema::{
    Field, Message, count, flag, group, list, number, pure_number, text,
};
use serde::Serialize;
use snug_campaign::words::remark::Remark;
use snug_campaign::{Became, Diagnosis, DiagnosisSummary, Misfit, RankedEffect};

/// The message of `/verdict`: the diagnosis without ladder and ranking, which have topics of their own, and without maps
/// and signals.
#[derive(Serialize)]
pub(crate) struct VerdictMessage<'a> {
    #[serde(flatten)]
    summary: DiagnosisSummary<'a>,
    comparison: &'a [Misfit],
    where_it_fails: &'a [Remark],
    where_the_final_model_fails: &'a [Remark],
    repeatable_share: Option<f64>,
}

pub(crate) fn verdict(diagnosis: &Diagnosis) -> VerdictMessage<'_> {
    let last = diagnosis.final_location.as_ref();
    VerdictMessage {
        summary: diagnosis.summary(),
        comparison: &diagnosis.comparison.pooled,
        where_it_fails: &diagnosis.location.remarks,
        where_the_final_model_fails: last.map_or(&[], |location| &location.remarks),
        repeatable_share: diagnosis.location.repeatable_share,
    }
}

/// A rung with its place, counted from 1. Its ranking has a topic of its own.
#[derive(Serialize)]
pub(crate) struct PlacedRung<'a> {
    place: usize,
    step: String,
    effects: &'a [String],
    error_over_noise: Option<f64>,
    heldout_error_over_noise: Option<f64>,
    heldout_target_error_over_noise: Option<f64>,
    heldout_participant_error_over_noise: Option<f64>,
    rms_fitted_output: f64,
    rms_displacement_rad: Option<f64>,
    fit_percent_median: Option<f64>,
    selected_fraction: f64,
}

/// Every rung of the ladder.
pub(crate) fn rungs(diagnosis: &Diagnosis) -> impl Iterator<Item = PlacedRung<'_>> {
    let rungs = diagnosis.ladder.iter().zip(diagnosis.rung_names());
    rungs.zip(1..).map(|((rung, step), place)| PlacedRung {
        place,
        step,
        effects: &rung.effects,
        error_over_noise: rung.error_over_noise,
        heldout_error_over_noise: rung.heldout_error_over_noise,
        heldout_target_error_over_noise: rung.heldout_target_error_over_noise,
        heldout_participant_error_over_noise: rung.heldout_participant_error_over_noise,
        rms_fitted_output: rung.rms_fitted_output,
        rms_displacement_rad: rung.rms_displacement_rad,
        fit_percent_median: rung.fit_percent_median,
        selected_fraction: rung.selected_fraction,
    })
}

/// A candidate with its place in the ranking beside the model of a rung, both counted from 1, and what became of it.
#[derive(Serialize)]
pub(crate) struct PlacedCandidate<'a> {
    rung: usize,
    place: usize,
    added_next: bool,
    gain_beside_next: Option<f64>,
    supported_beside_next: Option<bool>,
    #[serde(flatten)]
    entry: &'a RankedEffect,
}

/// The candidates of every rung, those of the last model at the end.
pub(crate) fn candidates(diagnosis: &Diagnosis) -> Vec<PlacedCandidate<'_>> {
    let last = diagnosis.ladder.len().saturating_sub(1);
    let earlier = diagnosis.ladder.iter().map(|rung| &rung.ranking);
    let rankings = (0..).zip(earlier).chain([(last, &diagnosis.ranking)]);
    rankings
        .flat_map(|(rung, ranking)| {
            let entries = ranking.iter().zip(1..);
            entries.map(move |(entry, place)| placed(diagnosis, rung, place, entry))
        })
        .collect()
}

fn placed<'a>(
    diagnosis: &Diagnosis,
    rung: usize,
    place: usize,
    entry: &'a RankedEffect,
) -> PlacedCandidate<'a> {
    let became = diagnosis.became(rung, &entry.effect);
    let (gain, supported) = match became {
        Became::Ranked { share, supported } => (Some(share), Some(supported)),
        Became::Added | Became::NotRanked => (None, None),
    };
    PlacedCandidate {
        rung: rung + 1,
        place,
        added_next: became == Became::Added,
        gain_beside_next: gain,
        supported_beside_next: supported,
        entry,
    }
}

/// The table of `/ladder`.
pub(crate) const LADDER: Message = Message {
    name: "snug.Rung",
    about: "One model of the error ladder and what it leaves",
    fields: &[
        count("place", "Place on the ladder, the study's own model 1"),
        text("step", "What this model has that the one before has not"),
        list(text("effects", "Effects in the model")),
        pure_number(
            "error_over_noise",
            "Error over noise; 1 = nothing but noise",
        ),
        pure_number(
            "heldout_error_over_noise",
            "Error over noise, tightenings held out",
        ),
        pure_number(
            "heldout_target_error_over_noise",
            "Error over noise, target torques held out",
        ),
        pure_number(
            "heldout_participant_error_over_noise",
            "Error over noise, participants held out",
        ),
        number(
            "rms_fitted_output",
            "the fitted output's",
            "Root mean square residual of the fitted output",
        ),
        number(
            "rms_displacement_rad",
            "rad",
            "Root mean square residual of the displacement",
        ),
        number("fit_percent_median", "%", "Median fit of the displacement"),
        pure_number("selected_fraction", "Share of tightenings selected"),
    ],
};

const PARAMETER: &[Field] = &[
    text("name", "Name with unit suffix"),
    text("meaning", "What it is, in a few words"),
    text("unit", "Unit"),
    number("value", "the parameter's", "Estimate"),
    number("low", "the parameter's", "Lower end of the 95 % interval"),
    number("high", "the parameter's", "Upper end of the 95 % interval"),
    number("standard_error", "the parameter's", "Standard error"),
    flag("per_tightening", "Every tightening has its own"),
    number(
        "spread",
        "the parameter's",
        "Standard deviation between tightenings",
    ),
    number("minimum", "the parameter's", "Smallest plausible value"),
    number("maximum", "the parameter's", "Largest plausible value"),
];

/// The table of `/ranking`.
pub(crate) const RANKING: Message = Message {
    name: "snug.RankedEffect",
    about: "One candidate for what the model lacks",
    fields: &[
        count(
            "rung",
            "Rung of the ladder beside whose model it was tried, the study's own 1",
        ),
        count("place", "Place in the ranking, the best 1"),
        flag("added_next", "It is in the model of the next ranking"),
        pure_number(
            "gain_beside_next",
            "Share of the same misfit that it removes once the next effects are in the model",
        ),
        flag("supported_beside_next", "The data support it then"),
        text("effect", "Effect"),
        text("kind", "Kind of the effect"),
        flag("unlisted", "In no catalogue"),
        text("expression", "Expression of a term that is in no catalogue"),
        list(group("parameters", PARAMETER, "Its size")),
        pure_number("score", "Score before any refit"),
        pure_number(
            "p_family",
            "How often chance alone does as well, over all candidates",
        ),
        pure_number(
            "heldout_gain",
            "Share of the misfit removed in held-out tightenings",
        ),
        pure_number("heldout_gain_error", "Standard error of that share"),
        pure_number("error_over_noise", "Error over noise with it"),
        pure_number("behind_first", "Standard deviations behind the first"),
        flag("supported", "The data support it"),
        list(text("twins", "Effects that these data cannot tell from it")),
        flag("plausible", "Its size is physically plausible"),
        list(text(
            "explanation",
            "What it is, how it shows, what to check",
        )),
    ],
};
