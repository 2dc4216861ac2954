//! The diagnosis in words: what is missing or was added, a term to try, the experiment that decides, why it stopped.

use super::{Render, Section};
use crate::figure::group_strip::group_strips;
use crate::words::effect_words::{sentence, sizes};
use crate::words::number::{fixed, percent, significant};
use maud::{Markup, html};
use snug_campaign::words::chance::{by_chance, share_with_error};
use snug_campaign::words::effect_name::{called, effect_name, unit_text};
use snug_campaign::words::program::program;
use snug_campaign::words::statement::grow;
use snug_campaign::words::{counted, joined};
use snug_campaign::{
    AddedEffect, CampaignResult, CorrectedEffect, Diagnosis, EffectParameter, RankedEffect,
    SizeComparison, Verdict,
};

/// What is missing in the model, in one sentence, and why.
pub const SECTION: Section = Section {
    anchor: "verdict",
    short_title: "Verdict",
    title: "Is something missing in the model?",
    render: Render::Diagnosed(render),
};

fn render(diagnosis: &Diagnosis, result: &CampaignResult) -> Option<Markup> {
    Some(html! {
        p { span.verdict.(diagnosis.verdict.name()) { (diagnosis.word()) } }
        p.lead { (sentence(&diagnosis.headline)) }
        @if !diagnosis.reasons.is_empty() {
            ul.reasons { @for reason in &diagnosis.reasons { li { (sentence(reason)) } } }
        }
        @if !diagnosis.added.is_empty() {
            h3 { "What the model has beyond mass, damper and spring" }
            div.effects { @for effect in &diagnosis.added { (added(effect, diagnosis, result)) } }
        }
        (missing(diagnosis, result))
        (unlisted(diagnosis))
        (experiment(diagnosis))
        (corrected(&diagnosis.corrected))
        (climb(diagnosis))
        p.note { (basis(diagnosis)) " verdict.json holds every number of this page's diagnosis." }
    })
}

fn added(effect: &AddedEffect, diagnosis: &Diagnosis, result: &CampaignResult) -> Markup {
    html! {
        div.effect {
            h4 { (called(&effect.effect, effect.expression.as_ref())) " " span.nature { (effect.kind) } }
            p.sizes { (sizes(&effect.parameters, result)) }
            (group_strips(&effect.parameters))
            (comparisons(&effect.comparisons))
            @if let Some(gain) = effect.heldout_gain {
                p { "It removes " strong { (fixed(100.0 * gain.min(1.0), 0)) "\u{a0}%" } " of the misfit in data that its size was not fitted to." }
            }
            @match effect.p_family {
                Some(p) => p { "How sure: " (by_chance(p)) "." },
                None => p { "The study's model already had it, so it was not put to the test here." },
            }
            @if let Some(needed) = effect.needed {
                p { "Without it, the squared error would " (grow(needed)) "." }
            }
            @if !effect.twins.is_empty() {
                p.attention { "These data cannot tell it from " strong { (diagnosis.names(&effect.twins)) } "." }
            }
            (implausible(&effect.parameters))
            @if !effect.explanation.is_empty() {
                ul { @for line in &effect.explanation { li { (sentence(line)) } } }
            }
        }
    }
}

/// Between whom its size differs, by the sizes that single tightenings ask for.
fn comparisons(all: &[SizeComparison]) -> Markup {
    let said =
        |one: &SizeComparison| format!("{} ({})", one.factor.plural(), by_chance(one.p_adjusted));
    let (differ, alike): (Vec<&SizeComparison>, Vec<&SizeComparison>) =
        (all.iter()).partition(|one| one.p_adjusted <= 0.05);
    let differ: Vec<String> = differ.into_iter().map(said).collect();
    let alike: Vec<String> = alike
        .into_iter()
        .map(|one| one.factor.plural().to_owned())
        .collect();
    html! {
        @if !all.is_empty() {
            p.note {
                "Its size, asked of every tightening by itself, "
                @if differ.is_empty() { "does not differ beyond chance between " (joined(&alike)) }
                @else {
                    "differs between " (joined(&differ))
                    @if !alike.is_empty() { ", not beyond chance between " (joined(&alike)) }
                }
                "."
            }
        }
    }
}

/// What to make of sizes that one would not expect.
fn implausible(parameters: &[EffectParameter]) -> Markup {
    html! {
        @for beyond in parameters.iter().filter_map(|one| one.size().beyond) {
            p.attention { "The size is " (beyond) ": something else that acts alike may hide behind it." }
        }
    }
}

/// The effect that the verdict names, while it is not yet in the model.
fn missing(diagnosis: &Diagnosis, result: &CampaignResult) -> Markup {
    let first = diagnosis
        .ranking
        .first()
        .filter(|_| diagnosis.verdict == Verdict::MissingEffect);
    html! {
        @if let Some(first) = first {
            h3 { @if first.twins.is_empty() { "What is missing" } @else { "What is missing: one of these, and these data cannot tell which" } }
            div.effects { @for one in named(diagnosis, first) {
                (candidate(one, result))
            } }
            p { @if diagnosis.added.iter().any(|one| one.effect == first.effect) {
                    "To give each group its own size and see the error before and after: " code { (program()) " improve" }
                } @else {
                    "To add it and see the error before and after: " code { (program()) " add " (first.effect) }
                }
                ", with the same " code { "--data" } " or " code { "--study" } " as now." }
        }
    }
}

/// An effect and what these data cannot tell from it.
fn named<'a>(
    diagnosis: &'a Diagnosis,
    first: &'a RankedEffect,
) -> impl Iterator<Item = &'a RankedEffect> {
    let is_twin = |one: &&RankedEffect| first.twins.contains(&one.effect);
    std::iter::once(first).chain(diagnosis.ranking.iter().filter(is_twin))
}

fn candidate(one: &RankedEffect, result: &CampaignResult) -> Markup {
    html! {
        div.effect {
            h4 { (effect_name(&one.effect)) " " span.nature { (one.kind) } }
            p.sizes { (sizes(&one.parameters, result)) }
            (group_strips(&one.parameters))
            p { "It removes " strong { (share_with_error(one.heldout_gain, one.heldout_gain_error)) }
                " of the misfit in data that its size was not fitted to." }
            p { "How sure: " (by_chance(one.p_family)) "." }
            (implausible(&one.parameters))
            @if !one.explanation.is_empty() {
                ul { @for line in &one.explanation { li { (sentence(line)) } } }
            }
        }
    }
}

fn unlisted(diagnosis: &Diagnosis) -> Markup {
    html! {
        @if let Some(term) = &diagnosis.unlisted {
            h3 { "The simplest term that describes what no effect of the catalogue explains" }
            p { (sentence(&term.statement)) }
            p { "To try it, paste this into the list " code { "model.custom" } " of the study file:" }
            pre tabindex="0" { code { (term.ron) } }
        }
    }
}

fn experiment(diagnosis: &Diagnosis) -> Markup {
    html! {
        @if let Some(experiment) = &diagnosis.experiment {
            h3 { "What would tell " (joined(&experiment.between)) " apart" }
            p { (sentence(&experiment.statement)) }
            p.note {
                "Conditions: " (experiment.conditions) ". "
                @match experiment.tightenings {
                    Some(count) => { "Tightenings needed: " (count) "." }
                    None => "None of the conditions that were tried separates them.",
                }
            }
        }
    }
}

fn corrected(corrected: &[CorrectedEffect]) -> Markup {
    html! {
        @if !corrected.is_empty() {
            h3 { "Taken out before the fit" }
            ul {
                @for effect in corrected {
                    li {
                        strong { (effect_name(&effect.effect)) } ": measured in the quiet part before the pulse, typically "
                        (significant(effect.size, 3)) "\u{a0}" (unit_text(&effect.unit)) ", beyond chance in "
                        (percent(effect.share)) " of the tightenings."
                    }
                }
            }
        }
    }
}

fn climb(diagnosis: &Diagnosis) -> Markup {
    html! {
        @if diagnosis.stopped.is_some() || !diagnosis.removals.is_empty() {
            h3 { "Why it stopped here" }
            @if let Some(stopped) = &diagnosis.stopped { p { (stopped) } }
            @if !diagnosis.removals.is_empty() {
                p { "Every added term was tried to be left out again:" }
                ul {
                    @for removal in &diagnosis.removals {
                        li {
                            strong { (effect_name(&removal.effect)) } " "
                            @if removal.removed { "was removed. " } @else { "stays. " }
                            (removal.statement)
                        }
                    }
                }
            }
        }
    }
}

/// What errors are compared with.
fn basis(diagnosis: &Diagnosis) -> String {
    let source = match diagnosis.noise.source.as_str() {
        "pre_roll" => "the noise measured in the quiet part before each pulse",
        "repeats" => "the differences between repeated tightenings",
        "declared" => "the noise that the study declares",
        "residual" => "what the model leaves, because no noise was measured",
        other => other,
    };
    let size = diagnosis
        .noise
        .acceleration_rad_per_s2
        .filter(|noise| noise.is_finite())
        .map_or_else(String::new, |noise| {
            format!(" (standard deviation {} rad/s²)", significant(noise, 3))
        });
    format!(
        "{} took part; model and measurement are compared in the {}, against {source}{size}.",
        counted(diagnosis.tightenings, "tightening"),
        diagnosis.compared_output
    )
}
