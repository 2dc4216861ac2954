//! `/verdict`, `/ladder` and `/ranking`: what is missing in the model, and how the error fell.

use crate::schema::{Field, Kind, Message, field};
use serde::Serialize;
use snug_campaign::words::remark::Remark;
use snug_campaign::{Diagnosis, DiagnosisSummary, Misfit};

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

/// A rung or a candidate with its place, counted from 1.
#[derive(Serialize)]
pub(crate) struct Placed<'a, T> {
    pub(crate) place: usize,
    #[serde(flatten)]
    pub(crate) entry: &'a T,
}

/// The table of `/ladder`.
pub(crate) const LADDER: Message = Message {
    name: "snug.Rung",
    about: "One model of the error ladder and what it leaves",
    fields: &[
        field(
            "place",
            Kind::Count,
            "",
            "Place on the ladder, the study's own model 1",
        ),
        field(
            "effects",
            Kind::List(&Kind::Text),
            "",
            "Effects in the model",
        ),
        field(
            "error_over_noise",
            Kind::Double,
            "",
            "Error over noise; 1 = nothing but noise",
        ),
        field(
            "heldout_error_over_noise",
            Kind::Double,
            "",
            "Error over noise, tightenings held out",
        ),
        field(
            "heldout_target_error_over_noise",
            Kind::Double,
            "",
            "Error over noise, target torques held out",
        ),
        field(
            "heldout_participant_error_over_noise",
            Kind::Double,
            "",
            "Error over noise, participants held out",
        ),
        field(
            "rms_fitted_output",
            Kind::Double,
            "the fitted output's",
            "Root mean square residual of the fitted output",
        ),
        field(
            "rms_displacement_rad",
            Kind::Double,
            "rad",
            "Root mean square residual of the displacement",
        ),
        field(
            "fit_percent_median",
            Kind::Double,
            "%",
            "Median fit of the displacement",
        ),
        field(
            "selected_fraction",
            Kind::Double,
            "",
            "Share of tightenings selected",
        ),
    ],
};

const PARAMETER: &[Field] = &[
    field("name", Kind::Text, "", "Name with unit suffix"),
    field("meaning", Kind::Text, "", "What it is, in a few words"),
    field("unit", Kind::Text, "", "Unit"),
    field("value", Kind::Double, "the parameter's", "Estimate"),
    field(
        "low",
        Kind::Double,
        "the parameter's",
        "Lower end of the 95 % interval",
    ),
    field(
        "high",
        Kind::Double,
        "the parameter's",
        "Upper end of the 95 % interval",
    ),
    field(
        "standard_error",
        Kind::Double,
        "the parameter's",
        "Standard error",
    ),
    field(
        "per_tightening",
        Kind::Flag,
        "",
        "Every tightening has its own",
    ),
    field(
        "spread",
        Kind::Double,
        "the parameter's",
        "Standard deviation between tightenings",
    ),
    field(
        "minimum",
        Kind::Double,
        "the parameter's",
        "Smallest plausible value",
    ),
    field(
        "maximum",
        Kind::Double,
        "the parameter's",
        "Largest plausible value",
    ),
];

/// The table of `/ranking`.
pub(crate) const RANKING: Message = Message {
    name: "snug.RankedEffect",
    about: "One candidate for what the model lacks",
    fields: &[
        field("place", Kind::Count, "", "Place in the ranking, the best 1"),
        field("effect", Kind::Text, "", "Effect"),
        field("kind", Kind::Text, "", "Kind of the effect"),
        field("unlisted", Kind::Flag, "", "In no catalogue"),
        field(
            "expression",
            Kind::Text,
            "",
            "Expression of a term that is in no catalogue",
        ),
        field(
            "parameters",
            Kind::List(&Kind::Object(PARAMETER)),
            "",
            "Its size",
        ),
        field("score", Kind::Double, "", "Score before any refit"),
        field(
            "p_family",
            Kind::Double,
            "",
            "How often chance alone does as well, over all candidates",
        ),
        field(
            "heldout_gain",
            Kind::Double,
            "",
            "Share of the misfit removed in held-out tightenings",
        ),
        field(
            "heldout_gain_error",
            Kind::Double,
            "",
            "Standard error of that share",
        ),
        field(
            "error_over_noise",
            Kind::Double,
            "",
            "Error over noise with it",
        ),
        field(
            "behind_first",
            Kind::Double,
            "",
            "Standard deviations behind the first",
        ),
        field("supported", Kind::Flag, "", "The data support it"),
        field(
            "twins",
            Kind::List(&Kind::Text),
            "",
            "Effects that these data cannot tell from it",
        ),
        field(
            "plausible",
            Kind::Flag,
            "",
            "Its size is physically plausible",
        ),
        field(
            "explanation",
            Kind::List(&Kind::Text),
            "",
            "What it is, how it shows, what to check",
        ),
    ],
};
