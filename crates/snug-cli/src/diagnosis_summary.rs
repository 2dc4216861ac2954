//! What a diagnosis came to, on one screen: the verdict, the ladder as a picture, the ranking, what to do next.

mod ladder;
mod ranking;
#[cfg(test)]
mod tests;

use crate::terminal;
use ladder::ladder;
use ranking::ranking;
use snug_campaign::words::chance::by_chance;
use snug_campaign::words::effect_name::called;
use snug_campaign::words::program::program;
use snug_campaign::words::size::sizes;
use snug_campaign::words::vocabulary::Vocabulary;
use snug_campaign::{Diagnosis, Location, RankedEffect, Verdict};
use std::fmt::Write as _;

/// Columns that a line may have; fewer on a terminal that has fewer.
const WIDTH: usize = 108;
/// What the proposed commands need to know.
pub struct Following<'a> {
    /// The options of the command that was run (`--data DIR`), to be repeated.
    pub options: &'a str,
    /// The study file among the results, which holds the model found.
    pub written: &'a str,
}

/// A diagnosis as it is printed on standard output.
pub fn of(diagnosis: &Diagnosis, following: &Following<'_>, vocabulary: Vocabulary) -> String {
    text(diagnosis, following, vocabulary, terminal::columns())
}

/// The text; a terminal, of so many columns, allows block characters and bold type.
fn text(
    diagnosis: &Diagnosis,
    following: &Following<'_>,
    vocabulary: Vocabulary,
    terminal: Option<usize>,
) -> String {
    let mut page = Page {
        text: String::new(),
        terminal: terminal.is_some(),
        width: terminal.map_or(WIDTH, |columns| columns.min(WIDTH)),
        vocabulary,
    };
    verdict(&mut page, diagnosis);
    missing(&mut page, diagnosis);
    ladder(&mut page, diagnosis);
    added(&mut page, diagnosis);
    ranking(&mut page, diagnosis);
    places(&mut page, diagnosis);
    certainty(&mut page, diagnosis);
    next(&mut page, diagnosis, following);
    page.text
}

struct Page {
    text: String,
    terminal: bool,
    width: usize,
    vocabulary: Vocabulary,
}

impl Page {
    fn line(&mut self, line: &str) {
        let line = line.replace('\u{a0}', " ");
        writeln!(self.text, "{}", line.trim_end()).expect("a string takes every write");
    }

    fn heading(&mut self, heading: &str) {
        let heading = self.vocabulary.says(heading);
        if self.terminal {
            self.line(&format!("\n\u{1b}[1m{heading}\u{1b}[0m"));
        } else {
            self.line(&format!("\n{heading}"));
        }
    }

    /// A paragraph behind `lead`, its further lines below its first.
    fn paragraph(&mut self, lead: &str, words: &str) {
        let indent = " ".repeat(lead.chars().count());
        let mut line = lead.to_owned();
        // A number and its percent sign stay on one line.
        let words = self.vocabulary.says(words).replace(" %", "\u{a0}%");
        for word in words.split([' ', '\n']).filter(|word| !word.is_empty()) {
            let used = line.chars().count();
            if used > indent.len() && used + 1 + word.chars().count() > self.width {
                self.line(&line);
                line.clone_from(&indent);
            }
            if line.chars().count() > indent.len() {
                line.push(' ');
            }
            line += word;
        }
        self.line(&line);
    }
}

fn verdict(page: &mut Page, diagnosis: &Diagnosis) {
    page.heading(&format!("Verdict: {}", diagnosis.word()));
    page.paragraph("  ", &diagnosis.headline.to_string());
    for reason in &diagnosis.reasons {
        page.paragraph("  - ", &reason.to_string());
    }
}

/// What the effect is that the verdict names, how it shows and what to check, while it is not yet in the model; the same of
/// its twins.
fn missing(page: &mut Page, diagnosis: &Diagnosis) {
    let Some(first) = not_yet_added(diagnosis) else {
        return;
    };
    let is_twin = |one: &&RankedEffect| first.twins.contains(&one.effect);
    let twins = diagnosis.ranking.iter().filter(is_twin);
    let explained = |one: &&RankedEffect| !one.explanation.is_empty();
    for one in std::iter::once(first).chain(twins).filter(explained) {
        let name = called(&one.effect, one.expression.as_ref());
        page.heading(&format!("What {name} is"));
        for sentence in &one.explanation {
            page.paragraph("  - ", sentence);
        }
    }
}

/// The effect or law that the verdict names, while it is not yet in the model.
fn not_yet_added(diagnosis: &Diagnosis) -> Option<&RankedEffect> {
    match diagnosis.verdict {
        Verdict::MissingEffect => diagnosis.ranking.first(),
        Verdict::UnlistedEffect => {
            let law = diagnosis.unlisted.as_ref()?;
            let is_it = |one: &&RankedEffect| one.expression.as_ref() == Some(&law.expression);
            diagnosis.ranking.iter().find(is_it)
        }
        Verdict::Adequate | Verdict::Undecided | Verdict::NotFitted => None,
    }
}

fn shortened(text: &str, columns: usize) -> String {
    if text.chars().count() <= columns {
        return text.to_owned();
    }
    let kept: String = text.chars().take(columns - 1).collect();
    kept + "…"
}

fn added(page: &mut Page, diagnosis: &Diagnosis) {
    if diagnosis.added.is_empty() {
        return;
    }
    page.heading("In the model now");
    for effect in &diagnosis.added {
        let name = called(&effect.effect, effect.expression.as_ref());
        page.paragraph("  ", &format!("{name}: {}", sizes(&effect.parameters)));
        let mut evidence = Vec::new();
        if let Some(gain) = effect.heldout_gain {
            evidence.push(format!(
                "removes {:.0} % of the misfit in unseen tightenings",
                100.0 * gain.clamp(0.0, 1.0)
            ));
        }
        if let Some(p) = effect.p_family {
            evidence.push(by_chance(p));
        }
        if !effect.twins.is_empty() {
            evidence.push(format!(
                "these data cannot tell it from {}",
                diagnosis.names(&effect.twins)
            ));
        }
        if !evidence.is_empty() {
            page.paragraph("    - ", &evidence.join("; "));
        }
        for sentence in &effect.explanation {
            page.paragraph("    - ", sentence);
        }
    }
}

fn places(page: &mut Page, diagnosis: &Diagnosis) {
    let remarks = |page: &mut Page, heading: &str, location: &Location| {
        if location.remarks.is_empty() {
            return;
        }
        page.heading(heading);
        for remark in &location.remarks {
            page.paragraph("  - ", &remark.to_string());
        }
    };
    match &diagnosis.final_location {
        Some(last) => {
            remarks(
                page,
                "Where the study's own model failed",
                &diagnosis.location,
            );
            remarks(page, "Where the model fails now", last);
        }
        None => remarks(page, "Where the model fails", &diagnosis.location),
    }
}

fn certainty(page: &mut Page, diagnosis: &Diagnosis) {
    let Some(control) = &diagnosis.control else {
        return;
    };
    page.heading("How far to trust this");
    let rate = control.false_alarms as f64 / control.campaigns.max(1) as f64;
    page.paragraph(
        "  ",
        &format!(
            "{} campaigns were simulated in which nothing is missing. In {} of them, {:.0} in 100, an effect was called \
             missing all the same; meant are {:.0} in 100 (95 % interval {:.0} to {:.0} in 100).",
            control.campaigns,
            control.false_alarms,
            100.0 * rate,
            100.0 * control.nominal_rate,
            100.0 * control.rate_low,
            100.0 * control.rate_high
        ),
    );
}

/// The law that is in no catalogue, ready for the study, or where its shape can be seen.
fn paste_the_law(page: &mut Page, diagnosis: &Diagnosis) {
    match &diagnosis.unlisted {
        Some(term) => {
            page.paragraph("  ", &term.statement);
            page.paragraph(
                "  ",
                "To keep it as a law of your own, paste this into the study's model.custom list:",
            );
            page.line(&format!("    {}", term.ron));
        }
        None => page.paragraph(
            "  ",
            "The report draws the missing force over time, displacement and velocity.",
        ),
    }
}

/// What to do with a rig that changes while it is measured.
const ALONE: &str = "Record again with a rig that stays as it is; or write into the study in which seconds of every recording it does, `preprocess: (stretch: (from_s: …, to_s: …))`, those in which an earlier state still rings left out, and ask again:";

fn next(page: &mut Page, diagnosis: &Diagnosis, following: &Following<'_>) {
    page.heading("What to do next");
    let command = |page: &mut Page, words: &str| {
        page.line(format!("    {} {words} {}", program(), following.options).trim_end());
    };
    if let Some(experiment) = &diagnosis.experiment {
        page.paragraph("  ", &experiment.statement);
    }
    if diagnosis.interrupted {
        page.paragraph("  ", "Go on from the model found so far:");
        page.line(&format!(
            "    {} improve --study {}",
            program(),
            following.written
        ));
        return;
    }
    let is_fitted = diagnosis.verdict != Verdict::NotFitted;
    if diagnosis.verb == "compare" && is_fitted && !diagnosis.changes() {
        page.paragraph("  ", "Ask which effect is missing; it changes nothing:");
        return command(page, "diagnose");
    }
    let climbed = is_fitted && matches!(diagnosis.verb.as_str(), "add" | "improve");
    match diagnosis.verdict {
        _ if diagnosis.changes() => {
            page.paragraph("  ", ALONE);
            command(page, &diagnosis.verb);
        }
        Verdict::MissingEffect => {
            let is_added = |name: &str| diagnosis.added.iter().any(|one| one.effect == name);
            let best = diagnosis.ranking.first();
            // What the model has already gets a size for each group by `improve` alone.
            if let Some(best) = best.filter(|best| !is_added(&best.effect)) {
                page.paragraph("  ", "Add it and see the error before and after:");
                command(page, &format!("add {}", best.effect));
            }
            page.paragraph("  ", "Or let Snug add what is justified, one after another:");
            command(page, "improve");
        }
        Verdict::UnlistedEffect => {
            paste_the_law(page, diagnosis);
            if !climbed {
                page.paragraph("  ", "Or let Snug add it and see the error before and after:");
                command(page, "improve");
            }
        }
        Verdict::Undecided if diagnosis.experiment.is_none() => {
            page.paragraph("  ", "The reasons above say what is lacking and how much more would decide.");
        }
        Verdict::Undecided => {}
        Verdict::NotFitted => {
            page.paragraph("  ", "Check what the reasons above name, in their order; then look again:");
            command(page, "compare");
        }
        Verdict::Adequate => page.paragraph(
            "  ",
            "Nothing needs to be added. report.html shows what was checked and how small a missing effect would have been seen.",
        ),
    }
    if climbed && !diagnosis.added.is_empty() {
        where_the_model_is(page, following);
    }
}

/// Where the study with the model found is, and how it is used.
fn where_the_model_is(page: &mut Page, following: &Following<'_>) {
    let where_it_is = format!(
        "The study with the model found is {}. Use it for this and further recordings:",
        following.written
    );
    page.paragraph("  ", &where_it_is);
    page.line(&format!(
        "    {} run --study {}",
        program(),
        following.written
    ));
}
