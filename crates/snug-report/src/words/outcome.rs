//! Why tightenings were rejected and how identifications ended, in words.

use snug_campaign::{FitStatus, Rejection};

/// Every reason, in the order in which tables list them.
pub const REJECTIONS: [Rejection; 9] = [
    Rejection::DataQuality,
    Rejection::NotIdentified,
    Rejection::AtConstraint,
    Rejection::MassNotPositive,
    Rejection::NotLightlyDamped,
    Rejection::GoesUp,
    Rejection::GoesDown,
    Rejection::PoorFit,
    Rejection::Validation,
];

/// A reason in a few words.
pub fn rejection_words(rejection: Rejection) -> &'static str {
    match rejection {
        Rejection::GoesUp => "displacement goes up",
        Rejection::GoesDown => "displacement goes down",
        Rejection::NotLightlyDamped => "not lightly damped",
        Rejection::PoorFit => "poor fit",
        Rejection::MassNotPositive => "mass not positive",
        Rejection::AtConstraint => "at a constraint",
        Rejection::NotIdentified => "not identified",
        Rejection::Validation => "kept for validation",
        Rejection::DataQuality => "data quality",
    }
}

/// What a reason means, in one sentence.
pub fn rejection_meaning(rejection: Rejection) -> &'static str {
    match rejection {
        Rejection::GoesUp => "The displacement rises and does not come back within the window.",
        Rejection::GoesDown => "The displacement runs to the wrong side: often a velocity offset.",
        Rejection::NotLightlyDamped => "The fitted system would not oscillate.",
        Rejection::PoorFit => "The model follows the measurement less well than the study asks.",
        Rejection::MassNotPositive => "The fitted hand–arm mass is zero or negative.",
        Rejection::AtConstraint => {
            "The best parameters lie on a limit, so the limit chose them and not the data."
        }
        Rejection::NotIdentified => {
            "No optimum was reached, or the data do not determine the parameters."
        }
        Rejection::Validation => {
            "Not fitted: simulated with the parameters of the others, to test them on unseen data."
        }
        Rejection::DataQuality => "The data themselves are faulty: see the findings.",
    }
}

/// Reasons in words, separated by commas; `selected` without any.
pub fn outcome_words(rejections: &[Rejection]) -> String {
    if rejections.is_empty() {
        return "selected".into();
    }
    rejections
        .iter()
        .map(|rejection| rejection_words(*rejection))
        .collect::<Vec<_>>()
        .join(", ")
}

/// Every way an identification ends, best first.
pub const STATUSES: [FitStatus; 6] = [
    FitStatus::Converged,
    FitStatus::ConvergedAtConstraint,
    FitStatus::Stalled,
    FitStatus::IterationLimit,
    FitStatus::NotIdentifiable,
    FitStatus::Failed,
];

/// What a status means, in one sentence.
pub fn status_meaning(status: FitStatus) -> &'static str {
    match status {
        FitStatus::Converged => "A best fit strictly inside all limits.",
        FitStatus::ConvergedAtConstraint => "The best fit lies on at least one limit.",
        FitStatus::IterationLimit => {
            "The iteration limit came first; the values are the best seen."
        }
        FitStatus::Stalled => {
            "No further decrease was possible before the optimality test held; the values are the best seen."
        }
        FitStatus::NotIdentifiable => "The data do not determine all free parameters.",
        FitStatus::Failed => "The residual could not be evaluated at the start.",
    }
}
